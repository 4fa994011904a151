// What a world block leaves for rendering.
#pragma once

#include "render/prims/primitive.h"
#include "render/state/options.h"

#include <map>
#include <string>
#include <vector>

namespace render {

/// An instance of a recorded object: which primitives it made, and where they stand.
struct ObjectCopy {
  const void* object = nullptr; ///< tells objects apart
  size_t first = 0, count = 0;  ///< of Scene::primitives
  Matrix4 to_camera;
};

struct Scene {
  Options options;
  Matrix4 world_to_camera;
  /// Spaces named by CoordinateSystem, to camera.
  std::map<std::string, Matrix4> spaces;
  std::vector<Primitive> primitives;
  std::vector<ObjectCopy> copies; ///< what rays may share; primitives may have changed since
};

} // namespace render
