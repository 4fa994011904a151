// What a world block leaves for rendering.
#pragma once

#include "render/prims/primitive.h"
#include "render/state/options.h"

#include <map>
#include <string>
#include <vector>

namespace render {

struct Scene {
  Options options;
  Matrix4 world_to_camera;
  /// Spaces named by CoordinateSystem, to camera.
  std::map<std::string, Matrix4> spaces;
  std::vector<Primitive> primitives;
  uint32_t solids = 0; ///< so many CSG solids bound some of them
};

} // namespace render
