// Measuring and evaluating lattices.
#include "render/rays/tessellate.h"

#include "render/prims/motion.h"

#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Segments of the lattice a primitive is measured by.
constexpr int kProbes = 4;
/// Distance between face and surface, in pixels at its place in the picture, at most; less, for the sake of
/// the bias, but not without end.
constexpr float kDeviation = 0.25f, kLeastDeviation = 1.0f / 32, kPartOfBias = 0.25f;
/// Of a displaced surface: the side of a face in micropolygons.
constexpr float kDisplacedStep = 2;
/// Faces the patches of one request have together, at most.
constexpr size_t kMostFaces = size_t{1} << 22;
/// Points a side of what displacement shaders run on at a time.
constexpr int kTile = 64;

/// The size of a pixel at a point of camera space: where the eye does not look, at the same distance.
float pixel_size(const Camera& camera, Vec3 p) {
  Vec2 centre = camera.project({0, 0, 1});
  float at_one = glm::distance(camera.unproject(centre, 1), camera.unproject(centre + Vec2(1, 0), 1));
  return camera.perspective() ? at_one * std::max(glm::length(p), camera.near_plane()) : at_one;
}

/// Lines of the probing lattice.
struct Extent {
  float bend = 0;   ///< second difference along a line, at most: over kProbes segments
  float length = 0; ///< of the longest line
  Box box;
  /// Takes in a line of points that are `stride` apart; the same from both ends, to the last bit.
  void add(const Vec3* P, int stride) {
    for (int i = 0; i <= kProbes; ++i) {
      const Vec3 here = P[i * stride];
      box.add(here);
      if (i == kProbes) continue;
      const Vec3 next = P[(i + 1) * stride];
      length = std::max(length, kProbes * glm::distance(here, next));
      if (i > 0) bend = std::max(bend, glm::length((P[(i - 1) * stride] + next) - 2.0f * here));
    }
  }
};

/// A power of two: edges of different rates still share points.
int power_of_two(float wanted) {
  int n = 1;
  while (n < kMostFacesASide && static_cast<float>(n) < wanted)
    n *= 2;
  return n;
}

void even_parameters(float from, float to, int points, std::vector<float>& out) {
  out.resize(static_cast<size_t>(points));
  for (int i = 0; i < points; ++i)
    out[static_cast<size_t>(i)] = from + (to - from) * static_cast<float>(i) / static_cast<float>(points - 1);
  out.back() = to;
}

/// How far the corners of a face are from lying in a plane.
float out_of_plane(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  Vec3 normal = glm::cross(d - a, c - b);
  float length = glm::length(normal);
  return length > 0 ? std::abs(glm::dot(a - b, normal)) / length : 0.0f;
}

/// Points of the whole lattice in camera space.
void surface_positions(const Primitive& p, int nu, int nv, std::vector<Vec3>& P) {
  std::vector<float> u, v;
  even_parameters(0, 1, nu, u);
  even_parameters(0, 1, nv, v);
  SurfaceLattice lattice;
  p.geometry->find_points({u, v}, lattice);
  P.resize(lattice.P.size());
  for (size_t k = 0; k < P.size(); ++k)
    P[k] = transform_point(p.state->object_to_camera, lattice.P[k]);
}

void displaced_positions(const Primitive& p, int nu, int nv, Displacer& displacer, std::vector<Vec3>& P) {
  P.resize(static_cast<size_t>(nu) * static_cast<size_t>(nv));
  std::vector<Vec3> tile;
  auto at = [](int i, int n) { return static_cast<float>(i) / static_cast<float>(n - 1); };
  for (int j0 = 0; j0 + 1 < nv; j0 += kTile)
    for (int i0 = 0; i0 + 1 < nu; i0 += kTile) {
      int i1 = std::min(i0 + kTile, nu - 1), j1 = std::min(j0 + kTile, nv - 1), width = i1 - i0 + 1;
      displacer.positions(p, {at(i0, nu), at(i1, nu), at(j0, nv), at(j1, nv)}, width, j1 - j0 + 1, tile);
      for (int j = j0; j <= j1; ++j)
        for (int i = i0; i <= i1; ++i)
          P[static_cast<size_t>(j * nu + i)] = tile[static_cast<size_t>((j - j0) * width + i - i0)];
    }
}

} // namespace

bool is_displaced_for_rays(const Primitive& p, const Displacer* displacer) {
  return displacer && p.attributes().rays.displacements && displacer->displaces(p);
}

namespace {

/// What may be left out at the nearest point of a box.
float tolerance_in(const Box& box, const Camera& camera, const Attributes& attributes) {
  const float pixel = pixel_size(camera, glm::clamp(Vec3(0.0f), box.min, box.max));
  return std::max(std::min(kDeviation * pixel, kPartOfBias * attributes.rays.bias), kLeastDeviation * pixel);
}

/// Decides rates of lines and surfaces.
class RateRule {
public:
  RateRule(const Primitive& p, const Camera& camera, bool displaced)
      : attributes_(p.attributes()), camera_(camera), displaced_(displaced) {}

  int along(const Extent& e) const {
    if (displaced_) {
      const float pixel = pixel_size(camera_, glm::clamp(Vec3(0.0f), e.box.min, e.box.max));
      return power_of_two(e.length / (pixel * std::sqrt(attributes_.shading_rate) * kDisplacedStep));
    }
    // A chord leaves an arc by an eighth of the second difference; it falls with the square of their number.
    return power_of_two(kProbes * std::sqrt(e.bend / 8 / tolerance_in(e.box, camera_, attributes_)));
  }
  /// The two triangles of a twisted face leave it by a quarter of the twist, which falls with both numbers.
  int across_twist(float twist, const Box& box) const {
    return displaced_
               ? 1
               : power_of_two(kProbes * std::sqrt(twist / 4 / tolerance_in(box, camera_, attributes_)));
  }

private:
  const Attributes& attributes_;
  const Camera& camera_;
  bool displaced_;
};

/// What rounding bends of a straight line does not count: small faces far from the origin have much of it.
bool bends(const Primitive& p, const Extent& e) {
  return !p.geometry->ruled() && e.bend > 1e-5f * e.length;
}

/// Below it, a part of the lines' lengths, a twist of a face of the probing lattice is one of rounding.
constexpr float kLeastTwist = 1e-5f;

/// Of a bilinear patch, which is all in its corners: its lines are straight, and a part of it that is a
/// kProbes-th as long and wide is twisted by a kProbes-th of a kProbes-th.
FaceRate measure_ruled(const Primitive& p, const RateRule& rule) {
  std::vector<Vec3> P;
  surface_positions(p, 2, 2, P);
  Box box;
  for (Vec3 corner : P)
    box.add(corner);
  const float length = std::max(glm::distance(P[0], P[1]), glm::distance(P[2], P[3])) +
                       std::max(glm::distance(P[0], P[2]), glm::distance(P[1], P[3]));
  const float twist = out_of_plane(P[0], P[1], P[2], P[3]) / (kProbes * kProbes);
  const int twisted = twist >= kLeastTwist * length ? rule.across_twist(twist, box) : 1;
  return {twisted, twisted};
}

} // namespace

FaceRate measure_rate(const Primitive& p, const Camera& camera, bool displaced, bool alone) {
  const RateRule rule(p, camera, displaced);
  if (!displaced && p.geometry->ruled()) {
    FaceRate out = measure_ruled(p, rule);
    if (alone) out.sides = {out.u, out.u, out.v, out.v};
    return out;
  }
  constexpr int n = kProbes + 1;
  std::vector<Vec3> P;
  surface_positions(p, n, n, P);
  Extent u, v;
  float twist = 0; ///< of the faces of the probing lattice
  for (int j = 0; j < n; ++j) {
    u.add(&P[static_cast<size_t>(j * n)], 1);
    v.add(&P[static_cast<size_t>(j)], n);
  }
  for (int j = 0; j < kProbes; ++j)
    for (int k = j * n; k < j * n + kProbes; ++k)
      twist = std::max(twist, out_of_plane(P[k], P[k + 1], P[k + n], P[k + n + 1]));
  FaceRate out{rule.along(u), rule.along(v)};
  if (twist >= kLeastTwist * (u.length + v.length)) {
    const int twisted = rule.across_twist(twist, u.box);
    out.u = std::max(out.u, twisted);
    out.v = std::max(out.v, twisted);
  }
  // Closed surfaces must not fall together.
  const auto [fewest_u, fewest_v] = p.geometry->coarsest();
  if (bends(p, u)) out.u = std::max(out.u, std::min(fewest_u, kProbes));
  if (bends(p, v)) out.v = std::max(out.v, std::min(fewest_v, kProbes));
  if (alone) {
    out.sides = {out.u, out.u, out.v, out.v};
    return out;
  }
  // Nothing here may depend on which patch asks.
  const int fewest = std::min(std::max(fewest_u, fewest_v), kProbes);
  constexpr std::array<std::pair<int, int>, 4> kSides{{{0, 1}, {n * kProbes, 1}, {0, n}, {kProbes, n}}};
  for (size_t side = 0; side < 4; ++side) {
    Extent e;
    e.add(&P[static_cast<size_t>(kSides[side].first)], kSides[side].second);
    out.sides[side] = std::max(rule.along(e), bends(p, e) ? fewest : 1);
  }
  out.u = std::max({out.u, out.sides[0], out.sides[1]});
  out.v = std::max({out.v, out.sides[2], out.sides[3]});
  return out;
}

float fineness_in(const Box& box, const Camera& camera, const Attributes& attributes) {
  return 1 / tolerance_in(box, camera, attributes);
}

FaceRate finer_of(const FaceRate& a, const FaceRate& b) {
  FaceRate out{std::max(a.u, b.u), std::max(a.v, b.v)};
  for (size_t side = 0; side < 4; ++side)
    out.sides[side] = std::max(a.sides[side], b.sides[side]);
  return out;
}

void limit_faces(std::span<FaceRate> rates) {
  auto count = [&] {
    return std::accumulate(rates.begin(), rates.end(), size_t{0},
                           [](size_t sum, const FaceRate& r) { return sum + r.faces(); });
  };
  for (size_t faces = count(); faces > std::max(kMostFaces, rates.size()); faces = count())
    for (FaceRate& r : rates) {
      for (int* pieces : {&r.u, &r.v, &r.sides[0], &r.sides[1], &r.sides[2], &r.sides[3]})
        *pieces = std::max(*pieces / 2, 1);
    }
}

namespace {

/// Puts the points of each side on its straight pieces.
void straighten_sides(const FaceRate& rate, std::vector<Vec3>& P) {
  const size_t nu = static_cast<size_t>(rate.u) + 1, last = nu * static_cast<size_t>(rate.v);
  const struct {
    size_t first, stride;
    int segments;
  } sides[4] = {{0, 1, rate.u}, {last, 1, rate.u}, {0, nu, rate.v}, {nu - 1, nu, rate.v}};
  for (size_t side = 0; side < 4; ++side) {
    const auto [first, stride, segments] = sides[side];
    const auto step = static_cast<size_t>(segments / rate.sides[side]);
    for (size_t i = 0; i < static_cast<size_t>(segments); ++i) {
      const size_t off = i % step;
      if (off == 0) continue;
      const Vec3 a = P[first + (i - off) * stride], b = P[first + (i - off + step) * stride];
      P[first + i * stride] = a + (b - a) * (static_cast<float>(off) / static_cast<float>(step));
    }
  }
}

} // namespace

void tessellate(const Primitive& p, FaceRate rate, Displacer* displacer, std::span<const float> times,
                const Matrix4* to_item, std::vector<QuadMesh>& parts) {
  int nu = rate.u + 1, nv = rate.v + 1;
  QuadMesh& mesh = parts.emplace_back();
  mesh.times = times.size();
  std::vector<Vec3> P;
  for (float time : times) {
    Primitive there = times.size() > 1 ? primitive_at(p, time) : p;
    if (is_displaced_for_rays(p, displacer))
      displaced_positions(there, nu, nv, *displacer, P);
    else
      surface_positions(there, nu, nv, P);
    straighten_sides(rate, P);
    for (Vec3& q : P) {
      if (!std::isfinite(q.x + q.y + q.z)) q = Vec3(0.0f);
      if (to_item) q = transform_point(*to_item, q);
    }
    mesh.points.insert(mesh.points.end(), P.begin(), P.end());
  }
  auto width = static_cast<uint32_t>(nu);
  for (uint32_t j = 0; j + 1 < static_cast<uint32_t>(nv); ++j)
    for (uint32_t i = 0; i + 1 < width; ++i) {
      uint32_t k = j * width + i;
      mesh.faces.push_back({k, k + 1, k + width + 1, k + width});
    }
}

QuadMesh joined(std::span<const QuadMesh> parts, size_t times) {
  QuadMesh out;
  out.times = times;
  for (size_t t = 0; t < times; ++t) {
    uint32_t first = 0;
    for (const QuadMesh& part : parts) {
      auto count = static_cast<std::ptrdiff_t>(part.points.size() / times);
      auto from = part.points.begin() + static_cast<std::ptrdiff_t>(t) * count;
      out.points.insert(out.points.end(), from, from + count);
      if (t == 0)
        for (std::array<uint32_t, 4> face : part.faces) {
          for (uint32_t& corner : face)
            corner += first;
          out.faces.push_back(face);
        }
      first += static_cast<uint32_t>(count);
    }
  }
  return out;
}

} // namespace render
