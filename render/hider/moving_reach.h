// Where micropolygons are while they move.
#pragma once

#include "render/hider/shaded_grid.h"
#include "render/state/math.h"

#include <vector>

namespace render {

/// Boxes around each of a row and all of its motion, as the camera's lens has not blurred it: a row at a
/// time, in vectors, for most micropolygons of a grid are not in the bucket.
class MovingReach {
public:
  /// Goes on with row j of the grid's micropolygons.
  void find_row(const ShadedGrid& grid, size_t j);
  Box box(size_t i) const {
    return {{low_[0][i], low_[1][i], low_[2][i]}, {high_[0][i], high_[1][i], high_[2][i]}};
  }
  /// Whether it may reach the pixels, without a lens.
  bool touches(size_t i, const PixelRect& pixels) const {
    constexpr float kSlack = 1e-2f; // pixels
    return high_[0][i] >= static_cast<float>(pixels.x0) - kSlack &&
           low_[0][i] <= static_cast<float>(pixels.x1) + kSlack &&
           high_[1][i] >= static_cast<float>(pixels.y0) - kSlack &&
           low_[1][i] <= static_cast<float>(pixels.y1) + kSlack;
  }

private:
  std::vector<float> low_[3], high_[3];
};

} // namespace render
