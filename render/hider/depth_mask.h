// The depth image of Hider "depthmask": a surface on its one side is left out of the picture.
#pragma once

#include "render/state/math.h"

#include <cstddef>
#include <vector>

namespace render {

struct DepthMask {
  int width = 0, height = 0;
  std::vector<float> depth; ///< camera z, row by row from the top; it covers the whole frame
  bool reverse = false;     ///< leave out what is behind it, instead of what is in front
  float bias = 0;           ///< added to its depths

  /// Whether a surface at depth z is left out at a place of the frame, from (0, 0) to (1, 1).
  bool hides(Vec2 at, float z) const {
    auto texel = [](float part, int size) {
      return static_cast<size_t>(std::clamp(static_cast<int>(part * static_cast<float>(size)), 0, size - 1));
    };
    float limit = depth[texel(at.y, height) * static_cast<size_t>(width) + texel(at.x, width)] + bias;
    return reverse ? z > limit : z < limit;
  }
};

} // namespace render
