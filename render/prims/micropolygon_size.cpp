// Shading rates of what moves and of what is out of focus.
#include "render/prims/micropolygon_size.h"

#include "render/prims/motion.h"

#include <array>
#include <cmath>

namespace render {

namespace {

constexpr size_t kProbes = 3; ///< a side
using Probes = std::array<Vec2, kProbes * kProbes>;

/// Where points of the primitive are in the image at a time. False: some are behind the eye.
bool probe(const Primitive& p, const Camera& camera, float time, Probes& out) {
  const float at[kProbes] = {0, 0.5f, 1};
  std::shared_ptr<const Geometry> shape = p.deformation.empty() ? p.geometry : shape_at(p.deformation, time);
  Matrix4 m = p.state->motion.empty() ? p.state->object_to_camera : matrix_at(p.state->motion, time);
  SurfaceLattice lattice;
  shape->find_points({at, at}, lattice);
  for (size_t k = 0; k < out.size(); ++k) {
    Vec3 q = transform_point(m, lattice.P[k]);
    if (camera.perspective() && !(q.z >= camera.near_plane())) return false;
    out[k] = camera.project(q);
  }
  return true;
}

/// The shortest way a point of the primitive goes in the image, in pixels.
float shortest_path(const Primitive& primitive, const Camera& camera) {
  std::vector<float> times = motion_times(primitive);
  Probes before, now;
  if (times.empty() || !probe(primitive, camera, times[0], before)) return 0;
  std::array<float, kProbes * kProbes> length{};
  for (size_t t = 1; t < times.size(); ++t) {
    if (!probe(primitive, camera, times[t], now)) return 0;
    for (size_t k = 0; k < now.size(); ++k)
      length[k] += glm::distance(before[k], now[k]);
    before = now;
  }
  return *std::min_element(length.begin(), length.end());
}

/// Diameter in pixels of the smallest circle of confusion of the primitive's points.
float smallest_confusion(const Primitive& primitive, const Camera& camera) {
  Box box = primitive.camera_bound({});
  float nearest = std::max(box.min.z, camera.near_plane()), farthest = std::max(box.max.z, nearest);
  if ((camera.defocus(nearest) < 0) != (camera.defocus(farthest) < 0)) return 0; // part of it is in focus
  Vec2 a = camera.blur(nearest, nearest), b = camera.blur(farthest, farthest);
  return 2 * std::min({a.x, a.y, b.x, b.y});
}

} // namespace

float micropolygon_side(const Primitive& primitive, const Camera& camera, bool motion) {
  constexpr float kPixels = 16;
  const Dicing& dicing = primitive.attributes().dicing;
  float coarser = 0;
  if (motion && dicing.motion_factor > 0)
    coarser = dicing.motion_factor * shortest_path(primitive, camera) / kPixels;
  if (camera.has_lens() && dicing.focus_factor > 0)
    coarser = std::max(coarser, dicing.focus_factor * smallest_confusion(primitive, camera) / kPixels);
  float area = primitive.attributes().shading_rate;
  constexpr float kMost = 0x1p16f;
  if (coarser >= 2) area *= std::exp2(std::floor(std::log2(std::min(coarser, kMost))));
  return std::max(std::sqrt(area), dicing.shortest);
}

} // namespace render
