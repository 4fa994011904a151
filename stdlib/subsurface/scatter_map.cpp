#include "stdlib/subsurface/scatter_map.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace subsurface {

float scatter_transmission(float r, float D) {
  if (!(r < D)) return 0;
  const float y = std::max(r, 0.0f) / D;
  return (1 - y * y * (3 - 2 * y)) / (3 * D * D * std::numbers::pi_v<float> / 10);
}

float bounce_attenuation(Vec3 P, Vec3 Pi, Vec3 N, Vec3 Ni, float D) {
  const Vec3 L = (P - Pi) * (1 / D);
  return std::clamp(1 - (1 - dot(N, Ni)) * (1 - dot(N, L)) / 2, 0.0f, 1.0f);
}

slvm::Result<ScatterMap> ScatterMap::build(const PointCloud& cloud) {
  if (std::string problem = check(cloud); !problem.empty()) return slvm::Error{problem};
  if (cloud.size() > 0 && cloud.normal.empty()) return slvm::Error{"a scatter map needs normals"};
  if (cloud.size() > 0 && cloud.area.empty()) return slvm::Error{"a scatter map needs areas"};
  std::vector<uint32_t> kept;
  std::vector<Vec3> positions;
  for (size_t i = 0; i < cloud.size(); ++i)
    if (cloud.area[i] > 0) {
      kept.push_back(static_cast<uint32_t>(i));
      positions.push_back(cloud.position[i]);
    }
  ScatterMap map;
  map.octree_ = PointOctree(positions);
  for (uint32_t i : map.octree_.order()) {
    map.normal_.push_back(normalize(cloud.normal[kept[i]]));
    map.area_.push_back(cloud.area[kept[i]]);
  }
  return map;
}

/// Of normals: where a pixel holds less than this part of a sample, the rest is of nothing.
constexpr float kShortest = 0.9f;

slvm::Result<PointCloud> cloud_of_scatter_images(size_t width, size_t height, std::span<const float> position,
                                                 std::span<const float> normal, std::span<const float> area) {
  const size_t pixels = width * height;
  if (position.size() != 3 * pixels || normal.size() != 3 * pixels || area.size() != pixels)
    return slvm::Error{
        fmt::format("the pictures of a scatter map must have the same size, {} x {}: positions and "
                    "normals with three channels, areas with one",
                    width, height)};
  PointCloud cloud;
  for (size_t i = 0; i < pixels; ++i) {
    const Vec3 p{position[3 * i], position[3 * i + 1], position[3 * i + 2]};
    const Vec3 n{normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]};
    if (!(area[i] > 0) || !std::isfinite(area[i]) || !is_finite(p) || !is_finite(n)) continue;
    if (length2(n) < kShortest * kShortest) continue;
    cloud.position.push_back(p);
    cloud.normal.push_back(n);
    cloud.area.push_back(area[i]);
  }
  return cloud;
}

} // namespace subsurface
