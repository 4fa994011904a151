// Polygons become bilinear patches: a convex quadrilateral is one; any other convex polygon with n corners
// becomes n, each from a corner to the middles of its two sides and the centre. On such a patch everything
// that is linear over a triangle stays exactly linear. Concave polygons and those with holes are cut into
// triangles first. Each patch has u and v of its own, from 0 to 1.
#pragma once

#include "render/prims/primitive.h"
#include "render/state/declaration.h"

#include <span>

namespace render {

/// One face: indices into the vertices, and where it stands in per-face and per-corner data.
struct PolygonFace {
  std::span<const int> vertices;
  size_t index = 0;        ///< of the face
  size_t first_corner = 0; ///< of its first corner among all corners
  /// Vertices of the outline and of each hole; empty: there are no holes.
  std::span<const int> loops = {};
};

/// Appends the patches of one face; each loop has three or more vertices. `P` holds the vertex positions.
/// Without s, t or st among `vars`, st is the object-space x and y (RISpec 3.2, 5.1).
void add_polygon(const PolygonFace& face, std::span<const Vec3> P, std::span<const TypedParam> vars,
                 const std::shared_ptr<const PrimitiveState>& state, std::vector<Primitive>& out);

} // namespace render
