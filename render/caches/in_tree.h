// Points of the renderer as those of the octree that finds them.
#pragma once

#include "render/state/math.h"
#include "stdlib/subsurface/octree.h"

namespace render {

inline subsurface::Vec3 in_tree(Vec3 p) {
  return {p.x, p.y, p.z};
}

} // namespace render
