// Measuring and evaluating lattices.
#include "render/rays/tessellate.h"

#include "render/prims/motion.h"

#include <cmath>

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

struct Extent {
  float bend = 0;   ///< second difference along the side, at most: over kProbes segments
  float length = 0; ///< of the longest line
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
  p.geometry->evaluate({u, v}, lattice);
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

FaceRate measure_rate(const Primitive& p, const Camera& camera, bool displaced) {
  constexpr int n = kProbes + 1;
  std::vector<Vec3> P;
  surface_positions(p, n, n, P);
  Box box;
  Extent u, v;
  auto measure = [&](Extent& e, int k, int stride, int at) {
    if (at > 0 && at < kProbes)
      e.bend = std::max(e.bend, glm::length(P[k - stride] - 2.0f * P[k] + P[k + stride]));
    if (at < kProbes) e.length = std::max(e.length, kProbes * glm::distance(P[k], P[k + stride]));
  };
  Vec3 nearest(kInfinity);
  float twist = 0; ///< of the faces of the probing lattice
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      int k = j * n + i;
      box.add(P[k]);
      measure(u, k, 1, i);
      measure(v, k, n, j);
      if (i < kProbes && j < kProbes)
        twist = std::max(twist, out_of_plane(P[k], P[k + 1], P[k + n], P[k + n + 1]));
    }
  nearest = glm::clamp(Vec3(0.0f), box.min, box.max);
  float pixel = pixel_size(camera, nearest);
  const Attributes& a = p.attributes();
  if (displaced) {
    float step = pixel * std::sqrt(a.shading_rate) * kDisplacedStep;
    return {power_of_two(u.length / step), power_of_two(v.length / step)};
  }
  float tolerance =
      std::max(std::min(kDeviation * pixel, kPartOfBias * a.rays.bias), kLeastDeviation * pixel);
  // A chord leaves an arc by an eighth of the second difference; it falls with the square of their number.
  // The two triangles of a twisted face leave it by a quarter of the twist, which falls with both numbers.
  auto segments = [&](float bend) { return kProbes * std::sqrt(bend / 8 / tolerance); };
  float twisted = kProbes * std::sqrt(twist / 4 / tolerance);
  bool flat = twist < 1e-5f * (u.length + v.length);
  auto rate = [&](const Extent& e) {
    return power_of_two(std::max(segments(e.bend), flat ? 0.0f : twisted));
  };
  FaceRate out{rate(u), rate(v)};
  // Closed surfaces must not fall together.
  auto fewest = p.geometry->coarsest();
  if (u.bend > 1e-5f * u.length) out.u = std::max(out.u, std::min(fewest[0], kProbes));
  if (v.bend > 1e-5f * v.length) out.v = std::max(out.v, std::min(fewest[1], kProbes));
  return out;
}

void even_out(std::span<FaceRate> rates) {
  if (rates.size() < 2) return;
  int most = 1;
  for (const FaceRate& r : rates)
    most = std::max({most, r.u, r.v});
  while (most > 1 && rates.size() * static_cast<size_t>(most) * static_cast<size_t>(most) > kMostFaces)
    most /= 2;
  for (FaceRate& r : rates)
    r = {most, most};
}

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
