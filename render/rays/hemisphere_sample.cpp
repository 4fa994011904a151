// Samples at other points than their own.
#include "render/rays/hemisphere_sample.h"

#include <algorithm>

namespace render {

HemisphereSample mean_of(std::span<const HemisphereSample> samples) {
  HemisphereSample out;
  float nearness = 0;
  const float part = 1 / static_cast<float>(samples.size());
  for (const HemisphereSample& s : samples) {
    for (size_t c = 0; c < HemisphereSample::kValues; ++c)
      out.value[c] += part * s.value[c];
    for (size_t c = 0; c < HemisphereSample::kGradients; ++c) {
      out.move[c] += part * s.move[c];
      out.turn[c] += part * s.turn[c];
    }
    nearness += part / s.distance;
  }
  out.distance = nearness > 0 ? 1 / nearness : kInfinity;
  return out;
}

float reach_of(const HemisphereSample& s) {
  float reach = s.distance;
  for (size_t c = 0; c < HemisphereSample::kGradients; ++c)
    if (float slope = glm::length(s.move[c]); slope > 0)
      reach = std::min(reach, std::max(s.value[c], c == 0 ? 0.2f : 0.05f) / slope);
  return reach;
}

HemisphereSample carried(const HemisphereSample& s, Vec3 way, Vec3 turn) {
  HemisphereSample out = s;
  for (size_t c = 0; c < HemisphereSample::kGradients; ++c) {
    float most = std::max(s.value[c], 0.05f), by = glm::dot(s.move[c], way) + glm::dot(s.turn[c], turn);
    out.value[c] = std::max(0.0f, s.value[c] + std::clamp(by, -most, most));
  }
  out.value[0] = std::min(out.value[0], 1.0f);
  return out;
}

} // namespace render
