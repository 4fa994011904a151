// Who shoots rays: the object whose shader runs, its limits, and what its rays' hits are told.
#pragma once

#include "render/hider/random.h"
#include "render/rays/ray_tracer.h"

namespace render {

struct RayTracer::Shooter {
  const slvm::ShadingState& state;
  const slvm::RayFacts& facts; ///< of the grid that shoots
  const RayAttributes& attributes;
  slvm::RayFacts next; ///< of the grids its rays hit
  bool may_shoot = true;
  float min_weight = 0;
  uint64_t seed = 0;      ///< of what is random
  bool one_point = false; ///< all rays are of one point, which the seed stands for

  uint32_t point(const slvm::RayBatch& batch, size_t ray) const {
    return batch.point ? batch.point[ray] : static_cast<uint32_t>(ray);
  }
  /// Which ray of those that share the seed it is.
  uint64_t number(const slvm::RayBatch& batch, size_t ray) const {
    return hash_of(one_point ? 0 : point(batch, ray), batch.sample ? batch.sample[ray] : 0, kRayTime);
  }

  /// The part of the picture a ray makes.
  Color weight(const float* const (&of_ray)[3], size_t ray, size_t point) const {
    Color out(1.0f);
    size_t samples = state.grid.samples();
    for (int c = 0; c < 3; ++c) {
      if (of_ray[c]) out[c] *= of_ray[c][ray];
      if (facts.weight[c]) out[c] *= facts.weight[c][point % samples];
    }
    return out;
  }
  bool too_light(Color weight) const { return std::max({weight.x, weight.y, weight.z}) < min_weight; }
};

} // namespace render
