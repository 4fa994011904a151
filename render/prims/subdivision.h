// Subdivision surfaces by OpenSubdiv (Bfr): every face, or every quarter of one, becomes a primitive that
// evaluates the limit surface. Regular faces are bicubic patches, the same as everywhere else.
#pragma once

#include "render/prims/primitive_list.h"
#include "render/state/declaration.h"
#include "slvm/support/result.h"

#include <span>

namespace render {

struct SubdivisionMesh {
  bool bilinear = false; ///< only split, not smoothed
  bool loop = false;     ///< Loop's scheme for triangles
  std::span<const int> nvertices, vertices;
  std::vector<int> holes;
  std::vector<int> crease_pairs; ///< two vertices an edge
  std::vector<float> crease_sharpness;
  std::vector<int> corners;
  std::vector<float> corner_sharpness;
  int boundary = 0;             ///< 0 none, 1 edges and corners, 2 edges only
  int facevarying_boundary = 0; ///< 0 linear, 1 edges and corners, 2 edges only, 3 sharp boundaries
  bool propagate_corners = false;
  bool chaikin = false;
  bool smooth_triangles = false; ///< catmull-clark: other weights for what becomes of triangles
};

/// The surfaces. Variables as for PointsPolygons; their vertex numbers are in range. The error says
/// what is wrong with the mesh.
slvm::Result<std::shared_ptr<const Pieces>>
make_subdivision(const SubdivisionMesh& mesh, std::span<const Vec3> P, std::span<const TypedParam> vars);

} // namespace render
