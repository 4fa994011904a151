// Faces and curves that cannot be drawn: a mesh of a million faces is not lost for one of them. What is left
// is a request as if they had never been in it.
#pragma once

#include "render/prims/curves.h"
#include "render/prims/polygons.h"

#include <span>
#include <string>
#include <vector>

namespace render {

/// What was left out, for a message.
struct LeftOut {
  size_t count = 0, all = 0;
  size_t first = 0;      ///< number of the first of them, from 0
  std::string first_why; ///< "it has 2 vertices"
};

/// Takes faces with fewer than three vertices in a loop, with vertices that do not exist or with points that
/// are not finite out of the lists and of the variables. The numbers in `tagged_faces`, if any, go on meaning
/// the same faces.
LeftOut leave_out_bad_faces(PolygonFaces& faces, std::span<const Vec3> P, std::vector<TypedParam>& vars,
                            std::vector<int>* tagged_faces = nullptr);

/// The same for curves with fewer points than their kind needs.
LeftOut leave_out_bad_curves(const CurveLayout& layout, std::vector<int>& points_of_curve,
                             std::vector<Vec3>& P, std::vector<TypedParam>& vars);

} // namespace render
