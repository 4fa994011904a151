#include "render/photons/light_emission.h"

#include "render/hider/random.h"
#include "render/rays/hemisphere_pattern.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

using slvm::Global;

float brightness(Color c) {
  return std::max({c.x, c.y, c.z, 0.0f});
}

/// A number in [0, 1) of photon i, spread evenly over the photons: a stratum for each, and chance within.
float stratified(size_t i, size_t all, uint64_t hash) {
  return std::min((static_cast<float>(i) + upper_unit(hash)) / static_cast<float>(all), 0x1.fffffep-1f);
}

} // namespace

LightEmission::LightEmission(const slvm::Machine& machine, slvm::RendererServices& services,
                             const slvm::Instance& light, const SceneSphere& scene)
    : machine_(machine), services_(services), light_(light), scene_(scene) {
  if (light.emitter()) {
    kind_ = Kind::kSurface;
    reach_ = 0.01f * scene_.radius;
  } else {
    find_place();
  }
  if (kind_ == Kind::kNone) return;
  if (!check_fall_off())
    problem_ = kind_ != Kind::kDistant
                   ? "its light does not fall off by the square of the distance, as that of photons does"
                   : "its light changes with the distance, that of photons does not";
  find_distribution();
}

void LightEmission::run(const std::vector<Vec3>& points, std::vector<Vec3>& L, std::vector<Color>& Cl,
                        const Places* places) const {
  const size_t n = points.size();
  slvm::Grid grid(static_cast<int>(n), 1);
  grid.derivatives = false;
  float *Ps = grid.varying(Global::kPs), *Ns = grid.varying(Global::kNs);
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < n; ++i) {
      Ps[c * grid.pitch() + i] = points[i][static_cast<int>(c)];
      Ns[c * grid.pitch() + i] = c == 2 ? -1.0f : 0.0f;
    }
  if (places) {
    std::copy(places->x.begin(), places->x.end(), grid.varying(Global::ku));
    std::copy(places->y.begin(), places->y.end(), grid.varying(Global::kv));
  }
  slvm::ShadingContext context(machine_, services_);
  context.run(light_, grid);
  auto take = [&](Global g, std::vector<Vec3>& to) {
    const slvm::Planes& planes = grid.variable(g);
    to.assign(n, Vec3(0.0f));
    for (size_t i = 0; i < n && planes.data; ++i)
      for (size_t c = 0; c < 3; ++c)
        to[i][static_cast<int>(c)] = planes.get(c, i);
  };
  take(Global::kL, L);
  take(Global::kCl, Cl);
}

void LightEmission::find_normals(Places& places) const {
  slvm::Grid grid(static_cast<int>(places.x.size()), 1);
  light_.emitter()->place(places.x, places.y, light_.program(), grid);
  for (size_t i = 0; i < places.x.size(); ++i) {
    Vec3 P, N;
    for (size_t c = 0; c < 3; ++c) {
      P[static_cast<int>(c)] = grid.variable(Global::kP).get(c, i);
      N[static_cast<int>(c)] = grid.variable(Global::kN).get(c, i);
    }
    places.P.push_back(P);
    places.N.push_back(glm::dot(N, N) > 0 ? glm::normalize(N) : Vec3(0, 0, 1));
  }
}

namespace {

/// A direction whose z is along the normal.
Vec3 about(Vec3 normal, Vec3 d) {
  Vec3 x, y;
  basis_about(normal, x, y);
  return d.x * x + d.y * y + d.z * normal;
}

} // namespace

void LightEmission::look_from_place(float x, float y, float part, int each, std::vector<Color>& Cl) const {
  Places one{{x}, {y}, {}, {}};
  find_normals(one);
  std::vector<Vec3> points, L;
  for (int j = 0; j < kRows; j += each)
    for (int i = 0; i < kColumns; i += each) {
      const Vec3 d = direction_at(static_cast<float>(j) + 0.5f, static_cast<float>(i) + 0.5f);
      points.push_back(one.P[0] + part * reach_ * about(one.N[0], d));
    }
  const Places places{std::vector<float>(points.size(), x), std::vector<float>(points.size(), y), {}, {}};
  run(points, L, Cl, &places);
}

/// From where points in the scene are lit. Ever more of them are looked at, as cones may be narrow.
void LightEmission::find_place() {
  constexpr size_t kEnough = 4;
  std::vector<Vec3> lit, L;
  for (int n = 8; n <= 64 && lit.size() < kEnough; n *= 2) {
    lit.clear();
    L.clear();
    for (int k = 0; k < n; ++k)
      look_at_layer(n, k, lit, L);
  }
  if (lit.empty()) return; // an ambient light, or one that shines elsewhere
  float apart = 0, turned = 0, longest = 0;
  for (size_t i = 0; i < lit.size(); ++i) {
    apart = std::max(apart, glm::distance(lit[i] - L[i], lit[0] - L[0]));
    turned = std::max(turned, glm::distance(L[i], L[0]));
    longest = std::max(longest, glm::length(L[i]));
  }
  if (!(longest > 0)) return;
  const float small = 1e-3f * scene_.radius;
  if (apart < small) {
    kind_ = Kind::kPoint;
    from_ = lit[0] - L[0];
    reach_ = 0.01f * scene_.radius;
  } else if (turned < 1e-4f * longest) {
    kind_ = Kind::kDistant;
    from_ = glm::normalize(L[0]);
  } else {
    problem_ = "it stands neither at a point nor far away: it sends no photons";
  }
}

/// Layer k of a lattice of n * n * n points round the scene: those that are lit, and from where.
void LightEmission::look_at_layer(int n, int k, std::vector<Vec3>& lit, std::vector<Vec3>& from) const {
  std::vector<Vec3> points, L;
  std::vector<Color> Cl;
  // None of them in a plane or on an axis that scenes like to have things in.
  auto at = [&](int i, float shift) {
    return (2 * (static_cast<float>(i) + shift) / static_cast<float>(n) - 1) * scene_.radius;
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      points.push_back(scene_.centre + Vec3(at(i, 0.41f), at(j, 0.57f), at(k, 0.46f)));
  run(points, L, Cl);
  for (size_t i = 0; i < points.size(); ++i)
    if (brightness(Cl[i]) > 0 && glm::dot(L[i], L[i]) > 0) {
      lit.push_back(points[i]);
      from.push_back(L[i]);
    }
}

Vec3 LightEmission::direction_at(float row, float column) const {
  const float z = 1 - 2 * row / kRows, r = std::sqrt(std::max(0.0f, 1 - z * z)),
              a = 2 * kPi * column / kColumns;
  return {r * std::cos(a), r * std::sin(a), z};
}

Vec3 LightEmission::on_disc(float x, float y) const {
  Vec3 u, v;
  basis_about(from_, u, v);
  const float r = scene_.radius * std::sqrt(x), a = 2 * kPi * y;
  return scene_.centre + r * (std::cos(a) * u + std::sin(a) * v) - 1.01f * scene_.radius * from_;
}

bool LightEmission::check_fall_off() {
  std::vector<Vec3> points, L;
  std::vector<Color> near, far;
  constexpr int kEach = 4; // of rows and columns
  auto look = [&](float part, std::vector<Color>& out) {
    if (kind_ == Kind::kSurface) return look_from_place(0.5f, 0.5f, part, kEach, out);
    points.clear();
    for (int j = 0; j < kRows; j += kEach)
      for (int i = 0; i < kColumns; i += kEach) {
        const float row = static_cast<float>(j) + 0.5f, column = static_cast<float>(i) + 0.5f;
        points.push_back(kind_ == Kind::kPoint
                             ? from_ + part * reach_ * direction_at(row, column)
                             : on_disc(row / kRows, column / kColumns) + part * 0.5f * scene_.radius * from_);
      }
    run(points, L, out);
  };
  look(1, near);
  look(2, far);
  double first = 0, second = 0;
  for (size_t i = 0; i < near.size(); ++i) {
    first += static_cast<double>(brightness(near[i]));
    second += static_cast<double>(brightness(far[i]));
  }
  return std::abs((kind_ != Kind::kDistant ? 4 : 1) * second - first) <= 0.02 * first;
}

/// Of an area light the mean over its surface: what single places send is weighed by it.
std::vector<Color> LightEmission::lattice_colours() const {
  std::vector<Vec3> points, L;
  std::vector<Color> Cl;
  if (kind_ == Kind::kSurface) {
    constexpr int kSide = 5;
    std::vector<Color> sum(kRows * kColumns, Color(0));
    for (int k = 0; k < kSide * kSide; ++k) {
      auto middle = [](int i) { return (static_cast<float>(i) + 0.5f) / kSide; };
      look_from_place(middle(k % kSide), middle(k / kSide), 1, 1, Cl);
      for (size_t i = 0; i < sum.size(); ++i)
        sum[i] += glm::max(Cl[i], Color(0)) / static_cast<float>(kSide * kSide);
    }
    return sum;
  }
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const float row = static_cast<float>(j) + 0.5f, column = static_cast<float>(i) + 0.5f;
      points.push_back(kind_ == Kind::kPoint ? from_ + reach_ * direction_at(row, column)
                                             : on_disc(row / kRows, column / kColumns));
    }
  run(points, L, Cl);
  return Cl;
}

void LightEmission::find_distribution() {
  const std::vector<Color> Cl = lattice_colours();
  const float whole =
      kind_ != Kind::kDistant ? 4 * kPi * reach_ * reach_ : kPi * scene_.radius * scene_.radius;
  const float cell = whole / (kRows * kColumns);
  for (const Color& c : Cl)
    power_ += glm::max(c, Color(0)) * cell;
  // Each cell gets its own share and something of its neighbours': its middle may be dark, though it is not.
  double sum = 0;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      float most = 0;
      for (int v = std::max(0, j - 1); v <= std::min(kRows - 1, j + 1); ++v)
        for (int u = i - 1; u <= i + 1; ++u)
          most =
              std::max(most, brightness(Cl[static_cast<size_t>(v * kColumns + (u + kColumns) % kColumns)]));
      const float own = brightness(Cl[static_cast<size_t>(j * kColumns + i)]);
      cumulated_.push_back(sum += static_cast<double>(0.75f * own + 0.25f * most));
    }
}

EmittedPhotons LightEmission::emit(size_t first, size_t count, size_t all, uint64_t seed) const {
  EmittedPhotons out;
  Places places; // of area lights
  std::vector<Vec3> points, L;
  std::vector<Color> Cl;
  std::vector<float> share; // of the whole lattice, to that of the photon
  const double sum = cumulated_.empty() ? 0 : cumulated_.back();
  for (size_t i = first; i < first + count; ++i) {
    const uint64_t hash = hash_of(static_cast<int64_t>(i), static_cast<int64_t>(seed), kPhotonOrigin),
                   more = hash_of(static_cast<int64_t>(hash), 1, kPhotonOrigin);
    const double at = sum * static_cast<double>(stratified(i, all, hash));
    const auto it = std::upper_bound(cumulated_.begin(), cumulated_.end(), at);
    const auto k = static_cast<size_t>(std::min<std::ptrdiff_t>(
        it - cumulated_.begin(), static_cast<std::ptrdiff_t>(cumulated_.size()) - 1));
    const double own = cumulated_[k] - (k ? cumulated_[k - 1] : 0);
    const float row = static_cast<float>(k / kColumns) + upper_unit(more),
                column = static_cast<float>(k % kColumns) + lower_unit(more);
    share.push_back(static_cast<float>(sum / (own * static_cast<double>(cumulated_.size()))));
    if (kind_ == Kind::kSurface) {
      const uint64_t where = hash_of(static_cast<int64_t>(hash), 2, kPhotonOrigin);
      places.x.push_back(upper_unit(where));
      places.y.push_back(lower_unit(where));
      out.direction.push_back(direction_at(row, column));
    } else if (kind_ == Kind::kPoint) {
      out.direction.push_back(direction_at(row, column));
      out.origin.push_back(from_);
      points.push_back(from_ + reach_ * out.direction.back());
    } else {
      out.direction.push_back(from_);
      out.origin.push_back(on_disc(row / kRows, column / kColumns));
      points.push_back(out.origin.back());
    }
  }
  if (kind_ == Kind::kSurface && !places.x.empty()) {
    find_normals(places);
    const float off = 1e-2f * reach_; // the surface itself is not in their way
    for (size_t i = 0; i < places.P.size(); ++i) {
      out.direction[i] = about(places.N[i], out.direction[i]);
      out.origin.push_back(places.P[i] + off * out.direction[i]);
      points.push_back(places.P[i] + reach_ * out.direction[i]);
    }
  }
  if (points.empty()) return out;
  run(points, L, Cl, kind_ == Kind::kSurface ? &places : nullptr);
  const float whole =
      kind_ != Kind::kDistant ? 4 * kPi * reach_ * reach_ : kPi * scene_.radius * scene_.radius;
  for (size_t i = 0; i < points.size(); ++i)
    out.power.push_back(glm::max(Cl[i], Color(0)) * (whole * share[i] / static_cast<float>(all)));
  return out;
}

} // namespace render
