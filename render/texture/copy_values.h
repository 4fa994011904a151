// From the points of a lookup to lanes.
#pragma once

#include "slvm/textures.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace render {

/// Some of the values, or the one for all points, in the first lanes.
inline void copy_values(const std::vector<float>& values, size_t first, size_t count, float* lanes) {
  if (values.size() > 1)
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first), count, lanes);
  else
    std::fill_n(lanes, count, slvm::TextureLookup::at(values, 0));
}

} // namespace render
