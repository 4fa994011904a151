#include "stdlib/subsurface/scatter_map.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>
#include <numeric>

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

slvm::Result<ScatterMap> ScatterMap::build(const PointCloud& cloud, std::shared_ptr<BlockPool> pool) {
  if (std::string problem = check(cloud); !problem.empty()) return slvm::Error{problem};
  if (cloud.size() > 0 && cloud.normal.empty()) return slvm::Error{"a scatter map needs normals"};
  if (cloud.size() > 0 && cloud.area.empty()) return slvm::Error{"a scatter map needs areas"};
  const Channel* face = pool ? cloud.find(kFaceChannel) : nullptr;
  std::vector<ScatterSample> samples;
  std::vector<float> faces;
  for (size_t i = 0; i < cloud.size(); ++i) {
    if (!(cloud.area[i] > 0)) continue;
    samples.push_back({cloud.position[i], normalize(cloud.normal[i]), cloud.area[i]});
    if (face) faces.push_back(face->values[i]);
  }
  if (face) return by_faces(std::move(samples), faces, std::move(pool));
  std::vector<Vec3> positions;
  for (const ScatterSample& s : samples)
    positions.push_back(s.position);
  ScatterMap map;
  map.octree_ = PointOctree(positions);
  for (uint32_t i : map.octree_.order()) {
    map.normal_.push_back(samples[i].normal);
    map.area_.push_back(samples[i].area);
  }
  return map;
}

ScatterMap ScatterMap::by_faces(std::vector<ScatterSample> samples, const std::vector<float>& faces,
                                std::shared_ptr<BlockPool> pool) {
  std::vector<uint32_t> order(samples.size()), starts;
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return faces[a] < faces[b]; });
  std::vector<ScatterSample> sorted;
  sorted.reserve(samples.size());
  for (uint32_t i : order) {
    if (sorted.empty() || faces[i] != faces[order[sorted.size() - 1]])
      starts.push_back(static_cast<uint32_t>(sorted.size()));
    sorted.push_back(samples[i]);
  }
  starts.push_back(static_cast<uint32_t>(sorted.size()));
  ScatterMap map;
  map.faces_ = std::make_shared<const FaceMap>(sorted, std::move(starts), std::move(pool));
  return map;
}

size_t ScatterMap::bytes() const {
  return octree_.bytes() + normal_.size() * (sizeof(Vec3) + sizeof(float)) + (faces_ ? faces_->bytes() : 0);
}

/// Of normals: where a pixel holds less than this part of a sample, the rest is of nothing.
constexpr float kShortest = 0.9f;

slvm::Result<PointCloud> cloud_of_scatter_images(size_t width, size_t height, std::span<const float> position,
                                                 std::span<const float> normal, std::span<const float> area,
                                                 std::span<const float> face) {
  const size_t pixels = width * height;
  if (position.size() != 3 * pixels || normal.size() != 3 * pixels || area.size() != pixels ||
      (!face.empty() && face.size() != pixels))
    return slvm::Error{
        fmt::format("the pictures of a scatter map must have the same size, {} x {}: positions and "
                    "normals with three channels, areas and faces with one",
                    width, height)};
  PointCloud cloud;
  if (!face.empty()) cloud.channels.push_back({ScatterMap::kFaceChannel, {}});
  for (size_t i = 0; i < pixels; ++i) {
    const Vec3 p{position[3 * i], position[3 * i + 1], position[3 * i + 2]};
    const Vec3 n{normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]};
    if (!(area[i] > 0) || !std::isfinite(area[i]) || !is_finite(p) || !is_finite(n)) continue;
    if (length2(n) < kShortest * kShortest) continue;
    if (!face.empty() && !std::isfinite(face[i])) continue;
    cloud.position.push_back(p);
    cloud.normal.push_back(n);
    cloud.area.push_back(area[i]);
    if (!face.empty()) cloud.channels[0].values.push_back(face[i]);
  }
  return cloud;
}

} // namespace subsurface
