// Where rays go and what their results come to; hemisphere_cast.cpp shoots them. Points are taken a few
// thousand rays at a time.
#include "render/rays/hemisphere_sampler.h"

#include "render/hider/random.h"
#include "render/rays/hemisphere_cache.h"
#include "render/rays/hemisphere_rays.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace render {

namespace {

constexpr size_t kRaysAtATime = 8192;
/// Blocks of cells whose distances differ by this factor, or whose light by this part of the whole, are
/// looked at again.
constexpr float kDistanceContrast = 1.5f, kLightContrast = 0.1f;

uint64_t mix(uint64_t a, uint64_t b) {
  return hash_of(static_cast<int64_t>(a), static_cast<int64_t>(b), kHemisphere);
}
uint64_t mix(uint64_t a, float b) {
  return mix(a, uint64_t{std::bit_cast<uint32_t>(b)});
}
uint64_t mix(uint64_t a, std::string_view text) {
  for (char c : text)
    a = (a ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return mix(a, text.size());
}

} // namespace

HemisphereSampler::HemisphereSampler(RayTracer& tracer, const slvm::ShadingState& state,
                                     const slvm::HemisphereQuery& query, bool interpolated)
    : tracer_(tracer), state_(state), query_(query), shooter_(tracer.shooter(state, query.rays)),
      pattern_(make_pattern(query.samples, query.min_samples)), interpolated_(interpolated),
      aim_(pattern_, query.cosine) {
  for (int b = 0, across = pattern_.sectors / pattern_.sector_block; b < pattern_.blocks(); ++b)
    for (int ring = 0; ring < pattern_.ring_block; ++ring)
      for (int sector = 0; sector < pattern_.sector_block; ++sector)
        by_block_.push_back(
            static_cast<uint32_t>((b / across * pattern_.ring_block + ring) * pattern_.sectors +
                                  b % across * pattern_.sector_block + sector));
  wants_light_ = query.radiance[0] && query.rays.shades;
  wants_map_ = !query.environment_map.empty() && (query.radiance[0] || query.environment_colour[0]);
  const slvm::RayFacts& f = state.grid.ray;
  uint64_t h = mix(query.rays.seed, f.label);
  for (float x : {query.samples, query.min_samples, query.falloff, f.depth, f.specular_depth, f.diffuse_depth,
                  f.most_specular_depth, f.most_diffuse_depth})
    h = mix(h, x);
  for (std::string_view text :
       {query.rays.label, query.rays.subset, query.environment_map, std::string_view(f.type)})
    h = mix(h, text);
  for (float x : query.to_environment.m)
    h = mix(h, wants_map_ ? x : 0.0f);
  for (bool flag : {query.cosine, query.falloff_is_power, query.radiance[0] != nullptr, interpolated,
                    wants_light_, query.environment_colour[0] != nullptr})
    h = mix(h, uint64_t{flag});
  const RayAttributes& a = shooter_.attributes;
  h = mix(mix(h, uint64_t(query.rays.sides) * 8 + uint64_t(query.rays.mode)), a.bias);
  h = mix(h, uint64_t(a.max_specular_depth) * 1001 + uint64_t(a.max_diffuse_depth) * 2 + a.sample_motion);
  call_ = h;
}

uint64_t HemisphereSampler::call_hash(const HemispherePoint& p) const {
  uint64_t h = mix(mix(mix(mix(call_, p.cone), p.max_distance), p.bias), p.base);
  if (p.base != 0 && !interpolated_) // else the element is a function of the place
    for (Vec3 side : {p.along_u, p.along_v})
      for (int c = 0; c < 3; ++c)
        h = mix(h, side[c]);
  return h;
}

/// Random numbers depend on the place, so that all grids see the same at a point they share.
uint64_t HemisphereSampler::seed_of(const HemispherePoint& p) const {
  return HemisphereCache::Key(p.P, p.N, mix(query_.rays.seed, uint64_t{1})).hash();
}

namespace {

/// What a ray stands for, as an angle.
float spread_of(const HemispherePattern& p) {
  return std::sqrt(2 * kPi / static_cast<float>(p.cells()));
}

} // namespace

/// Appends the rays that were aimed last, of the point with this number among those being sampled.
void HemisphereSampler::push_rays(Rays& rays, const HemispherePoint& p, size_t index) {
  const size_t count = aim_.size(), before = rays.size();
  auto append = [](std::vector<float>& to, const std::vector<float>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (size_t c = 0; c < 3; ++c) {
    append(rays.origin[c], aim_.origin[c]);
    append(rays.direction[c], aim_.direction[c]);
  }
  rays.max_distance.resize(before + count, p.max_distance);
  rays.bias.resize(before + count, p.bias);
  rays.point.resize(before + count, p.number);
  rays.index.resize(before + count, index);
  Cell* cells = &cells_[index * static_cast<size_t>(pattern_.cells())];
  for (size_t i = 0; i < count; ++i) {
    Cell& cell = cells[aim_.cell[i]];
    cell.direction = {aim_.direction[0][i], aim_.direction[1][i], aim_.direction[2][i]};
    cell.shot = true;
    rays.cell.push_back(&cell);
    rays.sample.push_back(static_cast<uint32_t>(aim_.cell[i]));
  }
  if (!needs_width()) return;
  const float spread = spread_of(pattern_);
  for (size_t i = before; i < before + count; ++i) {
    Vec3 x, y;
    basis_about(rays.cell[i]->direction, x, y);
    for (int c = 0; c < 3; ++c) {
      rays.direction_du[c].push_back(x[c] * spread);
      rays.direction_dv[c].push_back(y[c] * spread);
      rays.still[c].push_back(0);
    }
  }
}

void HemisphereSampler::first_rays(std::span<const HemispherePoint> points, Rays& rays) {
  const auto blocks = static_cast<size_t>(pattern_.blocks());
  chosen_.resize(points.size() * blocks);
  for (size_t i = 0; i < points.size(); ++i) {
    aim_.first(points[i], seed_of(points[i]));
    for (int cell : aim_.cell)
      chosen_[i * blocks + static_cast<size_t>(pattern_.block_of(cell))] = cell;
    push_rays(rays, points[i], i);
  }
}

bool HemisphereSampler::differs(const Cell& a, const Cell& b) const {
  if ((a.distance == kInfinity) != (b.distance == kInfinity)) return true;
  if (only_blocked()) return false;
  if (a.distance != kInfinity &&
      std::max(a.distance, b.distance) > kDistanceContrast * std::min(a.distance, b.distance))
    return true;
  for (int c = 0; c < 3; ++c)
    if (std::abs(a.light[c] - b.light[c]) > kLightContrast * std::max({a.light[c], b.light[c], 0.1f}))
      return true;
  return false;
}

/// The cells left in blocks that differ from one of the four beside them.
void HemisphereSampler::more_rays(std::span<const HemispherePoint> points, Rays& rays) {
  int across = pattern_.sectors / pattern_.sector_block, down = pattern_.rings / pattern_.ring_block;
  for (size_t i = 0; i < points.size(); ++i) {
    Cell* cells = &cells_[i * static_cast<size_t>(pattern_.cells())];
    const int* chosen = &chosen_[i * static_cast<size_t>(pattern_.blocks())];
    std::vector<uint8_t> wanted(static_cast<size_t>(pattern_.blocks()));
    for (int b = 0; b < pattern_.blocks(); ++b) {
      int row = b / across, column = b % across;
      const Cell& own = cells[chosen[b]];
      auto other = [&](int r, int c) {
        return r >= 0 && r < down && differs(own, cells[chosen[r * across + (c + across) % across]]);
      };
      wanted[static_cast<size_t>(b)] = other(row - 1, column) || other(row + 1, column) ||
                                       other(row, column - 1) || other(row, column + 1);
    }
    aim_.others(points[i], seed_of(points[i]), wanted, {chosen, wanted.size()});
    push_rays(rays, points[i], i);
  }
}

float HemisphereSampler::blocked_by(const HemispherePoint& p, float distance) const {
  if (!(distance < kInfinity)) return 0;
  if (query_.falloff == 0) return 1;
  if (!query_.falloff_is_power) return std::exp(-query_.falloff * distance);
  return p.max_distance < kInfinity
             ? std::pow(std::max(0.0f, (p.max_distance - distance) / p.max_distance), query_.falloff)
             : 1.0f;
}

/// f(cells of a block, by number; how many of them were shot: one or all) for all blocks.
template <class F> void HemisphereSampler::for_blocks(const Cell* cells, F&& f) const {
  const size_t size = by_block_.size() / static_cast<size_t>(pattern_.blocks());
  for (size_t first = 0; first < by_block_.size(); first += size) {
    const auto block = std::span(by_block_).subspan(first, size);
    int shot = 0;
    for (uint32_t cell : block)
      shot += cells[cell].shot;
    f(block, shot);
  }
}

void HemisphereSampler::finish(const HemispherePoint& p, Cell* cells, HemisphereSample& out) const {
  double sum[HemisphereSample::kValues] = {}, nearness = 0;
  auto add = [&](const Cell& cell, float weight) {
    sum[0] += weight * cell.blocked;
    for (int c = 0; c < 3 && needs_width(); ++c) {
      sum[1 + c] += weight * cell.light[c];
      sum[4 + c] += weight * cell.map[c];
    }
    for (int c = 0; c < 3 && cell.distance == kInfinity; ++c)
      sum[7 + c] += weight * cell.direction[c];
    // Behind the farthest distance there may be anything.
    float distance = std::min(cell.distance, p.max_distance);
    if (distance < kInfinity) nearness += weight / std::max(distance, 1e-20f);
  };
  for_blocks(cells, [&](std::span<const uint32_t> block, int shot) {
    // Cells that were left out are like the one of their block that was not.
    const float weight = static_cast<float>(block.size()) / static_cast<float>(shot);
    for (uint32_t cell : block)
      if (cells[cell].shot) add(cells[cell], weight);
  });
  const double count = pattern_.cells();
  for (size_t i = 0; i < HemisphereSample::kValues; ++i)
    out.value[i] = static_cast<float>(sum[i] / count);
  out.distance = nearness > 0 ? static_cast<float>(count / nearness) : kInfinity;
  if (!interpolated_ || !query_.cosine || p.cone > kPi / 2 + 1e-4f) return;
  for_blocks(cells, [&](std::span<const uint32_t> block, int shot) {
    if (shot == static_cast<int>(block.size())) return;
    const Cell seen =
        cells[*std::find_if(block.begin(), block.end(), [&](uint32_t c) { return cells[c].shot; })];
    for (uint32_t cell : block)
      if (!cells[cell].shot) cells[cell] = seen;
  });
  gradients(p, cells, out);
}

/// Ward and Heckbert 1992, equations for the rotation and the translation gradient, for means instead of
/// integrals; turns are about right-handed axes.
void HemisphereSampler::gradients(const HemispherePoint& p, const Cell* cells, HemisphereSample& out) const {
  const int M = pattern_.rings, N = pattern_.sectors;
  float reach = std::sin(std::min(p.cone, kPi / 2));
  Vec3 x, y;
  basis_about(p.N, x, y);
  // Light and map only where they are asked for.
  const size_t count = needs_width() ? HemisphereSample::kGradients : 1;
  auto value = [](const Cell& c, size_t i) {
    return i == 0 ? c.blocked : i < 4 ? c.light[static_cast<int>(i - 1)] : c.map[static_cast<int>(i - 4)];
  };
  auto sine = [&](float ring) { return reach * std::sqrt(ring / static_cast<float>(M)); };
  auto around = [&](float sector) {
    float a = 2 * kPi * sector / static_cast<float>(N);
    return x * std::cos(a) + y * std::sin(a);
  };
  const float norm = 1 / (kPi * reach * reach);
  auto move = [&](const Cell& cell, const Cell& other, Vec3 along, float factor) {
    float nearest = std::min(cell.distance, other.distance);
    if (!(nearest < kInfinity)) return;
    for (size_t i = 0; i < count; ++i)
      if (float change = value(cell, i) - value(other, i); change != 0)
        out.move[i] += along * (factor * norm / std::max(nearest, 1e-6f) * change);
  };
  struct Ring {
    float inner, width,
        turn; ///< of the ring's edge towards the axis; to the other one; by the cell's tangent
  };
  std::vector<Ring> rings;
  for (int j = 0; j < M; ++j) {
    float s = sine(static_cast<float>(j)), middle = sine(static_cast<float>(j) + 0.5f);
    float tangent = middle / std::sqrt(std::max(1 - middle * middle, 1e-4f));
    rings.push_back({2 * kPi / static_cast<float>(N) * s * (1 - s * s), sine(static_cast<float>(j + 1)) - s,
                     tangent / static_cast<float>(M * N)});
  }
  for (int k = 0; k < N; ++k) {
    Vec3 radial = around(static_cast<float>(k) + 0.5f);
    Vec3 turned = glm::cross(p.N, radial), at_edge = glm::cross(p.N, around(static_cast<float>(k)));
    for (int j = 0; j < M; ++j) {
      const Cell& cell = cells[j * N + k];
      const Ring& ring = rings[static_cast<size_t>(j)];
      if (j > 0) move(cell, cells[(j - 1) * N + k], radial, ring.inner);
      move(cell, cells[j * N + (k + N - 1) % N], at_edge, ring.width);
      for (size_t i = 0; i < count; ++i)
        out.turn[i] += turned * (ring.turn * value(cell, i));
    }
  }
}

HemisphereSampler::~HemisphereSampler() = default;

void HemisphereSampler::sample(std::span<const HemispherePoint> points, std::span<HemisphereSample> out) {
  auto cells = static_cast<size_t>(pattern_.cells());
  size_t at_a_time = std::max<size_t>(1, kRaysAtATime / cells);
  for (const HemispherePoint& p : points)
    tracer_.hemispheres_ += p.pass == 0;
  if (!rays_) rays_ = std::make_unique<Rays>();
  Rays& rays = *rays_;
  for (size_t first = 0; first < points.size();) {
    auto part = points.subspan(first, std::min(at_a_time, points.size() - first));
    if (interpolated_) { // a sample belongs to its place, whichever grid asks
      part = points.subspan(first, 1);
      shooter_.seed = mix(seed_of(part[0]), uint64_t{part[0].pass});
      shooter_.one_point = true;
    }
    cells_.assign(part.size() * cells, {});
    rays.clear();
    first_rays(part, rays);
    cast(part, rays);
    if (pattern_.blocks() < pattern_.cells()) {
      rays.clear();
      more_rays(part, rays);
      if (rays.size() > 0) cast(part, rays);
    }
    for (size_t i = 0; i < part.size(); ++i)
      finish(part[i], &cells_[i * cells], out[first + i]);
    first += part.size();
  }
}

} // namespace render
