// Watertight seams between the grids of one curved surface. Neighbouring grids are diced at different rates,
// so along a shared side one has points that the other has not, and between these the two would cut the curve
// differently. Both therefore agree on a coarse outline of the side, found from the curve alone, and every
// other point of the side is put on it.
//
// The outline: halve the side's parameter interval while it is longer than a quarter of the surface or its
// ends are more than kOutlineStep micropolygons apart in the image, or one of them is more than half of that
// from its middle. Grids have 2^n segments a side, so the outline's points are always among theirs.
#pragma once

#include "render/prims/geometry.h"
#include "render/state/camera.h"
#include "slvm/grid.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace render {

inline constexpr float kOutlineStep = 2;
/// The longest parameter interval between points of an outline: a full circle keeps four.
inline constexpr float kOutlineInterval = 0.25f;

/// For the sides v = v0, v = v1, u = u0, u = u1 of a grid: which points are on the outline.
struct GridOutline {
  std::array<std::vector<uint8_t>, 4> sides;
};

/// From a grid just diced (before displacement, which may differ from grid to grid). `step` is the side of a
/// micropolygon in pixels.
GridOutline find_outline(const slvm::Grid& grid, const UvRect& rect, const Camera& camera, float step);

/// Moves the points that are not on the outline onto it: one component of them, in raster space, u fastest.
void snap_to_outline(const GridOutline& outline, int nu, int nv, std::span<float> values);

} // namespace render
