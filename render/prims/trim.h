// Trimmed NURBS. The trim curves are flattened to polygons of the parameter square; what is left of the
// square is cut into quadrilaterals, and each becomes a piece of the surface. Edges of the trimmed surface
// are thus edges of grids, as sharp and as antialiased as any silhouette.
#pragma once

#include "render/prims/nurbs.h"

namespace render {

/// A curve of the parameter plane, as TrimCurve gives it.
struct TrimCurve {
  int order = 2;
  std::vector<float> knots;
  float min = 0, max = 1;
  std::vector<glm::dvec3> points; ///< (uw, vw, w)
};
/// Curves that follow each other and close.
using TrimLoop = std::vector<TrimCurve>;

/// An area of the parameter plane: the inside of an odd number of loops.
struct TrimRegion {
  std::vector<TrimLoop> loops;
};

/// A quadrilateral of the parameter square.
using UvQuad = std::array<glm::dvec2, 4>;

/// What is left: corners at (0,0), (1,0), (0,1), (1,1) of each part, all of positive area. `low` and `high`
/// are the corner of the parameter square in the curves' own units. `outside`: the rest of the square
/// instead.
std::vector<UvQuad> trimmed_square(const TrimRegion& region, glm::dvec2 low, glm::dvec2 high, bool outside);

} // namespace render
