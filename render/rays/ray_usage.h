// How many rays a frame took, and what they hit.
#pragma once

#include <cstddef>

namespace render {

struct RayGeometryUsage {
  size_t bytes = 0;             ///< of faces and hierarchies, now
  size_t made = 0, dropped = 0; ///< items of neighbouring primitives
  size_t faces = 0;             ///< of all that were made
};

struct RayUsage {
  size_t rays = 0, shadow_rays = 0, hemisphere_rays = 0;
  size_t hemispheres = 0;               ///< points that hemisphere rays were shot for
  size_t hit_grids = 0, hit_points = 0; ///< shaded, neighbours for derivatives included
  RayGeometryUsage geometry;
  size_t all() const { return rays + shadow_rays + hemisphere_rays; }
};

} // namespace render
