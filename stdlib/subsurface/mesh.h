// Triangle meshes as surfaces to put points on: areas, normals, and which triangle lies beyond which edge.
#pragma once

#include "slvm/support/result.h"
#include "stdlib/subsurface/point_cloud.h"

#include <array>
#include <cstdint>

namespace subsurface {

/// Corners turn counterclockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;

  Vec3 corner(size_t triangle, int k) const { return vertices[triangles[triangle][static_cast<size_t>(k)]]; }
  /// Not of unit length: its length is twice the area.
  Vec3 wide_normal(size_t triangle) const;
  float area(size_t triangle) const { return 0.5f * length(wide_normal(triangle)); }
  double total_area() const;
};

/// Corner i of the triangles of a grid of nu by nv points, row by row, is point i: two triangles a
/// micropolygon. The seams of neighbouring grids are closed by weld().
void append_grid(TriangleMesh& mesh, size_t nu, size_t nv, std::span<const Vec3> points);
/// Makes one of vertices that are equal, and drops triangles without area and vertices without triangles.
void weld(TriangleMesh& mesh);

/// From the elements "vertex" and "face" of a PLY file; faces with more corners become fans. Fails on indices
/// that are out of range and on positions that are not finite.
slvm::Result<TriangleMesh> parse_mesh(std::span<const std::byte> bytes, const std::string& name);
slvm::Result<TriangleMesh> read_mesh(const std::string& path);
/// The same, binary, into a temporary file that is renamed.
slvm::Result<bool> write_mesh(const std::string& path, const TriangleMesh& mesh);

/// The triangles beyond the edges. Edge k goes from corner k to corner k+1. Where more than two triangles
/// meet, the first two are neighbours, the others have a border there.
class MeshTopology {
public:
  static constexpr uint32_t kNone = ~0u;

  explicit MeshTopology(const TriangleMesh& mesh);

  struct Side {
    uint32_t triangle = kNone;
    uint8_t edge = 0;     ///< of that triangle
    bool reversed = true; ///< it runs the other way there, as it does if both turn alike
  };
  const Side& across(uint32_t triangle, int edge) const {
    return sides_[triangle][static_cast<size_t>(edge)];
  }

private:
  std::vector<std::array<Side, 3>> sides_;
};

} // namespace subsurface
