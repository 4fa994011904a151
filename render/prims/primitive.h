// A surface in the scene: geometry, where it stands, what it looks like.
#pragma once

#include "render/prims/geometry.h"
#include "render/prims/primvar.h"
#include "render/state/attributes.h"

#include <memory>
#include <vector>

namespace render {

/// What the patches of one request share.
struct PrimitiveState {
  std::shared_ptr<const Attributes> attributes;
  Matrix4 object_to_camera;
  Matrix4 camera_to_object;
  bool mirrored = false;        ///< object_to_camera changes handedness
  float displacement_bound = 0; ///< farthest a displacement shader moves a point, in camera space
};

struct Primitive {
  std::shared_ptr<const PrimitiveState> state;
  std::shared_ptr<const Geometry> geometry;
  std::vector<PatchVar> vars;
  /// The part of the shaders' u and v that this surface is: patches of a mesh share one square.
  UvRect uv = {};

  const Attributes& attributes() const { return *state->attributes; }
  /// Box of a part in camera space, displacement included.
  Box camera_bound(const UvRect& rect) const {
    Box box = transform_box(state->object_to_camera, geometry->bound(rect));
    box.grow(state->displacement_bound);
    return box;
  }
};

} // namespace render
