// A surface laid flat: from one triangle, its neighbours are turned about their common edges into its plane.
// In that plane the shortest way between near points is a straight line, whatever the surface does in space.
#pragma once

#include "stdlib/subsurface/mesh.h"

namespace subsurface {

struct Vec2 {
  float x = 0, y = 0;
};
inline Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vec2 operator*(Vec2 a, float s) {
  return {a.x * s, a.y * s};
}
inline float dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
inline float cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// A triangle in some plane.
struct FlatTriangle {
  uint32_t triangle = 0;
  std::array<Vec2, 3> corner;
};

/// A place on a mesh: x, y in the triangle's own plane (MeshPlane::own()).
struct SurfacePoint {
  uint32_t triangle = 0;
  Vec2 at;
};

/// A mesh made ready to be unfolded. Not changed afterwards. The mesh must live as long.
class MeshPlane {
public:
  explicit MeshPlane(const TriangleMesh& mesh);

  const TriangleMesh& mesh() const { return mesh_; }
  /// The triangle in its own plane: corner 0 at the origin, corner 1 on the positive x axis, corner 2 above
  /// it.
  FlatTriangle own(uint32_t triangle) const;
  /// The neighbour beyond an edge, laid into the plane of `flat`; false at a border.
  bool across(const FlatTriangle& flat, int edge, FlatTriangle& out) const;
  /// Where a place of the plane in which `flat` lies is in the triangle's own plane, and back.
  Vec2 to_own(const FlatTriangle& flat, Vec2 p) const;
  Vec2 from_own(const FlatTriangle& flat, Vec2 p) const;

  /// In space.
  Vec3 position(const SurfacePoint& point) const;
  /// Weights of the three corners; they sum to 1, and none is negative.
  std::array<float, 3> weights(const SurfacePoint& point) const;
  /// The place at the end of a straight way over the surface from `from` (in the triangle's own plane). At
  /// borders ways turn along them.
  SurfacePoint walk(SurfacePoint from, Vec2 way) const;

private:
  /// The same place, inside its triangle in spite of rounding.
  SurfacePoint settle(SurfacePoint point) const;

  const TriangleMesh& mesh_;
  MeshTopology topology_;
  struct Shape {
    float base = 0; ///< corner 1 is at (base, 0)
    Vec2 top;       ///< corner 2
  };
  std::vector<Shape> shapes_;
};

} // namespace subsurface
