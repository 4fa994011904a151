// Rays of a HemisphereSampler between being aimed and being shot.
#pragma once

#include "render/rays/hemisphere_sampler.h"

#include <vector>

namespace render {

/// Rays on their way, as structures of arrays.
struct HemisphereSampler::Rays {
  std::vector<float> origin[3], direction[3], direction_du[3], direction_dv[3], still[3], max_distance, bias,
      distance, colours, weight[3];
  std::vector<uint32_t> point, sample;
  std::vector<size_t> cell;  ///< among those of all points being sampled
  std::vector<size_t> index; ///< of the point among those being sampled

  void clear() {
    for (auto* planes : {origin, direction, direction_du, direction_dv, still, weight})
      for (int c = 0; c < 3; ++c)
        planes[c].clear();
    max_distance.clear();
    bias.clear();
    point.clear();
    sample.clear();
    cell.clear();
    index.clear();
  }
  size_t size() const { return cell.size(); }
};

} // namespace render
