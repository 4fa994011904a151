// Rectangles of samples, by their columns and rows in a buffer.
#pragma once

#include "render/state/math.h"

#include <algorithm>
#include <cstddef>

namespace render {

/// Columns [i0, i1) and rows [j0, j1).
struct SampleWindow {
  size_t i0, i1, j0, j1;

  size_t count() const { return (i1 - i0) * (j1 - j0); }
};

/// The whole numbers from `from` to `to`, both included, that are below `size`.
inline void find_cells(float from, float to, int size, size_t& begin, size_t& end) {
  // What is clamped at 0 is cut off like floor(); what is no number is clamped, too.
  const auto limit = static_cast<float>(size);
  begin = static_cast<size_t>(static_cast<int>(std::min(limit, std::max(0.0f, from))));
  end = to < 0 ? 0 : static_cast<size_t>(static_cast<int>(std::min(limit, to + 1)));
}

/// The cells, in columns and rows, that the rectangle from `low` to `high` touches. False: none.
inline bool find_window(Vec2 low, Vec2 high, int columns, int rows, SampleWindow& window) {
  find_cells(low.x, high.x, columns, window.i0, window.i1);
  find_cells(low.y, high.y, rows, window.j0, window.j1);
  return window.i0 < window.i1 && window.j0 < window.j1;
}

} // namespace render
