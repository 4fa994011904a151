// Points spread evenly over a mesh by repulsion: G. Turk, "Re-Tiling Polygonal Surfaces", 1992, which Jensen
// and Buhler 2002, 3 take their irradiance samples from. Distances and directions between points are those in
// the unfolded surface (unfold.h), so that points on both sides of a thin sheet do not see each other.
#pragma once

#include "stdlib/subsurface/unfold.h"

namespace subsurface {

struct RepulsionOptions {
  size_t points = 1000;
  int passes = 40;      ///< Turk's number; after 15 little changes any more
  uint64_t seed = 0;    ///< of the places at which points start
  unsigned threads = 0; ///< 0: all of the machine; the result does not depend on it
};

/// The points; fewer than asked for only if the mesh has no area. They start at random, evenly by area. In
/// each pass each is pushed by those nearer than r = 2 sqrt(area/points), the harder the nearer (by r -
/// distance), and goes that way over edges, or along borders.
std::vector<SurfacePoint> repel(const MeshPlane& plane, const RepulsionOptions& options);

/// As a cloud: positions, normals of the faces, and the same area for all (2002, 3).
PointCloud cloud_of(const MeshPlane& plane, std::span<const SurfacePoint> points);

/// How many samples a surface needs: area/(pi l_u^2), l_u the mean free path 1/sigma_t' (2002, 3). The paper
/// also speaks of some 300 samples within 10 l_u, which is pi times as many.
size_t sample_count(double area, double mean_free_path);

} // namespace subsurface
