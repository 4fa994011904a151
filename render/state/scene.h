// What a world block leaves for rendering.
#pragma once

#include "render/prims/primitive_list.h"
#include "render/state/options.h"
#include "render/state/procedural.h"

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

/// What a procedural holds.
struct SceneContent {
  PrimitiveList primitives;
  std::vector<Procedural> procedurals;
  /// Spaces that CoordinateSystem named in it, to camera.
  std::map<std::string, Matrix4> spaces;
};

struct Scene {
  Options options;
  Matrix4 world_to_camera;
  /// Spaces named by CoordinateSystem, to camera.
  std::map<std::string, Matrix4> spaces;
  PrimitiveList primitives;
  std::vector<ObjectCopy> copies; ///< what rays may share; primitives may have changed since
  uint32_t solids = 0;            ///< so many CSG solids bound some of them
  /// Geometry that is made when the picture comes to it: Interpreter::make_content.
  std::vector<Procedural> procedurals;
};

} // namespace render
