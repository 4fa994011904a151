// The depth image of Hider "depthmask": a surface on its one side is left out of the picture.
#pragma once

#include "render/state/math.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace render {

struct DepthMask {
  int width = 0, height = 0;
  std::vector<float> depth; ///< camera z, row by row from the top; it covers the whole frame
  bool reverse = false;     ///< leave out what is behind it, instead of what is in front
  float bias = 0;           ///< added to its depths

  /// Whether a surface at depth z is left out at a place of the frame, from (0, 0) to (1, 1).
  bool hides(Vec2 at, float z) const {
    float limit = depth[texel(at.y, height) * static_cast<size_t>(width) + texel(at.x, width)] + bias;
    return reverse ? z > limit : z < limit;
  }
  /// Its least and its largest limit between two places.
  std::pair<float, float> limits(Vec2 from, Vec2 to) const {
    std::pair<float, float> out{kInfinity, -kInfinity};
    for (size_t j = texel(from.y, height); j <= texel(to.y, height); ++j)
      for (size_t i = texel(from.x, width); i <= texel(to.x, width); ++i) {
        const float limit = depth[j * static_cast<size_t>(width) + i] + bias;
        out = {std::min(out.first, limit), std::max(out.second, limit)};
      }
    return out;
  }

private:
  static size_t texel(float part, int size) {
    return static_cast<size_t>(std::clamp(static_cast<int>(part * static_cast<float>(size)), 0, size - 1));
  }
};

} // namespace render
