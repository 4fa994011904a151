#include "tests/fuzz/programs/scene_of_planes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace slvm::test {
namespace {

constexpr float kPlanes[] = {-3, 0, 2.5f};
constexpr float kBias = 1e-3f;

/// The nearest plane behind `after`, or infinity.
float nearest(const RayBatch& batch, size_t r, float after) {
  const float limit = batch.max_distance ? batch.max_distance[r] : std::numeric_limits<float>::infinity();
  const float z = batch.origin[2][r], slope = batch.direction[2][r];
  float best = std::numeric_limits<float>::infinity();
  for (float plane : kPlanes) {
    const float t = (plane - z) / slope;
    if (t > after && t > kBias && t <= limit && t < best) best = t;
  }
  return best;
}

void bring(const RayOutput& o, const RayBatch& batch, size_t r, float distance) {
  float p[3], value[3] = {0, 0, 1};
  for (size_t c = 0; c < 3; ++c)
    p[c] = batch.origin[c][r] + distance * batch.direction[c][r];
  if (o.name == "P")
    std::copy_n(p, 3, value);
  else if (o.name == "Ci")
    value[0] = 0.5f + 0.25f * p[2], value[1] = std::fabs(p[0]) < 2, value[2] = 0.125f * p[1];
  else if (o.name == "w")
    value[0] = p[0] - p[1];
  else if (o.name != "N")
    return;
  const auto count = static_cast<size_t>(components(o.type));
  if (o.elements || (count != 1 && count != 3) || (count == 1) != (o.name == "w")) return;
  for (size_t c = 0; c < count; ++c)
    o.data[c * o.pitch + r] = value[c];
  o.found[r] = 1;
}

} // namespace

void SceneOfPlanes::trace(const ShadingState&, const RayOptions& options, const RayBatch& batch,
                          std::span<const RayOutput> outputs, float* distance, RayCursor* cursors) {
  for (size_t r = 0; r < batch.count; ++r) {
    distance[r] = nearest(batch, r, cursors ? cursors[r].distance : -std::numeric_limits<float>::infinity());
    if (!(distance[r] < std::numeric_limits<float>::infinity())) continue;
    if (cursors) cursors[r].distance = distance[r];
    for (const RayOutput& o : outputs)
      if (options.shades || o.from == RayOutput::From::kPrimitive) bring(o, batch, r, distance[r]);
  }
}

void SceneOfPlanes::transmission(const ShadingState&, const RayOptions&, const RayBatch& batch,
                                 float* const (&through)[3]) {
  for (size_t r = 0; r < batch.count; ++r) {
    float left = 1, at = -std::numeric_limits<float>::infinity();
    for (size_t k = 0; k < std::size(kPlanes); ++k) {
      at = nearest(batch, r, at);
      if (at < std::numeric_limits<float>::infinity()) left *= 0.5f;
    }
    for (size_t c = 0; c < 3; ++c)
      through[c][r] = c == 2 ? 1.0f : left;
  }
}

std::string SceneOfPlanes::hemisphere(const ShadingState&, const HemisphereQuery& q) {
  for (size_t i = 0; i < q.points; ++i)
    if (q.mask[i / 64] >> (i % 64) & 1 && q.occlusion)
      q.occlusion[i] = 0.5f + 0.25f * q.normal[2][i] + 0.125f * q.position[0][i];
  return "";
}

} // namespace slvm::test
