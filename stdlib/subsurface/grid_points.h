// Points from diced grids: one for each micropolygon, or fewer, each with the area it stands for (the
// course's 4.4).
#pragma once

#include "stdlib/subsurface/point_cloud.h"

namespace subsurface {

/// A grid of nu by nv points, row by row. Columns that are not known are empty.
struct GridView {
  size_t nu = 0, nv = 0;
  std::span<const Vec3> position;
  std::span<const Vec3> normal;
  std::span<const Color> irradiance, albedo;
};

/// Adds a point for each micropolygon that has an area: at its middle, on the surface that the corners'
/// normals tell of (below it shadows of the surface itself would reach the point), with the area of its two
/// triangles and the mean of its corners' values. Without normals in the grid those of the micropolygon: of
/// its diagonals, from the side from which u to v turns counterclockwise. A cloud must get the same columns
/// from all grids.
void append_grid(PointCloud& cloud, const GridView& grid);

/// `count` points for the whole surface, all with about the same area: the cloud is halved again and again,
/// across its longest side and by area, and of each part the point nearest to its centre is taken. Area,
/// irradiance, albedo and channels are the part's sum and means, so that totals of area and flux stay the
/// same. Points that are larger than a part are kept as they are, so that there may be fewer.
PointCloud thin(const PointCloud& cloud, size_t count);

} // namespace subsurface
