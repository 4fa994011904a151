// Clouds and meshes of known shapes, for the subsurface tests.
#pragma once

#include "stdlib/subsurface/mesh.h"

namespace subsurface::test {

/// A square in the plane z = 0 with this side, centre at the origin: n by n points, each in the middle of its
/// cell.
PointCloud plate(size_t n, float side, Color irradiance);
/// Points of a sphere along a spiral, all with the same area; irradiance by the height, from 0 to 1.
PointCloud ball(size_t n, float radius);
/// A cube from -1 to 1, each face two triangles.
TriangleMesh cube();
/// A sphere of 2 n by n quadrilaterals.
TriangleMesh sphere(size_t n, float radius);
/// A rectangle of two triangles.
TriangleMesh rectangle(float width, float height);

} // namespace subsurface::test
