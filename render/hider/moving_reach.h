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

private:
  std::vector<float> low_[3], high_[3];
};

} // namespace render
