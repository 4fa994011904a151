#include "render/hider/moving_reach.h"

#include <algorithm>

namespace render {

namespace {

void add(const float* values, size_t count, float* __restrict low, float* __restrict high) {
  for (size_t k = 0; k < count; ++k) {
    low[k] = std::min(low[k], values[k]);
    high[k] = std::max(high[k], values[k]);
  }
}

} // namespace

void MovingReach::find_row(const ShadedGrid& grid, size_t j) {
  const auto nu = static_cast<size_t>(grid.nu);
  for (size_t c = 0; c < 3; ++c) {
    const float* first = grid.position.plane(c) + j * nu;
    low_[c].assign(first, first + nu);
    high_[c] = low_[c];
    float *low = low_[c].data(), *high = high_[c].data();
    add(first + nu, nu, low, high);
    for (const Vec3Planes& later : grid.later)
      for (size_t row : {j, j + 1})
        add(later.plane(c) + row * nu, nu, low, high);
    // From columns of points to micropolygons between two of them: what is read next is still that of points.
    for (size_t i = 0; i + 1 < nu; ++i) {
      low[i] = std::min(low[i], low[i + 1]);
      high[i] = std::max(high[i], high[i + 1]);
    }
  }
}

} // namespace render
