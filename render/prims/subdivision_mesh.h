// A mesh as the request SubdivisionMesh gives it.
#pragma once

#include <span>
#include <vector>

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

} // namespace render
