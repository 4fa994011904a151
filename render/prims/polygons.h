// Polygons become bilinear patches: a triangle is one whose last side, v = 1, is a point; a convex
// quadrilateral is one; any other convex polygon with n corners becomes n, each from a corner to the middles
// of its two sides and the centre. Everything that is linear over a triangle stays exactly linear. Concave
// polygons and those with holes are cut into triangles first. Each patch has u and v of its own, from 0 to 1.
#pragma once

#include "render/prims/primitive_list.h"
#include "render/state/declaration.h"

#include <span>

namespace render {

/// The faces of one request, by numbers of vertices.
struct PolygonFaces {
  std::vector<int> vertices;      ///< of all loops of all faces, one after another
  std::vector<int> loops;         ///< how many of them each loop has: three or more
  std::vector<int> loops_of_face; ///< the outline and the holes of each face; empty: every loop is a face
  /// The first side of a triangle is its shortest, for the sake of thin ones; not of one shape of several
  /// that are to have the same parameters.
  bool one_of_several = false;
};

/// The patches of all faces. `P` holds the vertex positions. Sizes of the variables: one value for
/// each face, vertex, or corner of a face. Without s, t or st among them, st is the object-space x and y
/// (RISpec 3.2, 5.1). All patches share what is given here.
std::shared_ptr<const Pieces> make_polygons(PolygonFaces faces, std::vector<Vec3> P,
                                            std::vector<TypedParam> vars);

} // namespace render
