// Which points of a grid can be left out when others are shaded.
#pragma once

#include <cstdint>

namespace render {

/// What shading a point of a grid needs besides the point.
enum class PointNeeds : uint8_t {
  kGrid,       ///< all of it: points are moved, what is written is for all of them, or they are counted
  kNeighbours, ///< one along u and one along v, for derivatives and the footprints of rays
  kNothing,
};

} // namespace render
