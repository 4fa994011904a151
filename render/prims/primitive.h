// A surface in the scene: geometry, where it stands, what it looks like.
#pragma once

#include "render/prims/geometry.h"
#include "render/prims/patch_vars.h"
#include "render/prims/solid.h"
#include "render/state/attributes.h"

#include <memory>
#include <vector>

namespace render {

/// A value of something that moves; times are parts of the shutter time, from 0 to 1.
template <class T> struct TimedValue {
  float time;
  T value;
};
using MotionMatrices = std::vector<TimedValue<Matrix4>>;
using MotionShapes = std::vector<TimedValue<std::shared_ptr<const Geometry>>>;

/// What the patches of one request share.
struct PrimitiveState {
  std::shared_ptr<const Attributes> attributes;
  Matrix4 object_to_camera; ///< when the shutter opens
  Matrix4 camera_to_object;
  MotionMatrices motion;                    ///< object to camera from time 0 to 1; empty: it stands still
  bool mirrored = false;                    ///< object_to_camera changes handedness
  float displacement_bound = 0;             ///< farthest a displacement shader moves a point, in camera space
  std::shared_ptr<const SolidTree> solid;   ///< that the surface bounds a primitive of; null: none
  SolidTree::NodeIndex solid_primitive = 0; ///< which
  LevelPart level; ///< the samples that see it, where a level of detail goes over into another

  /// Of a box in object space, in camera space, displacement and motion included. Points go in straight
  /// lines: what holds all keys holds all that is between them.
  Box camera_bound(const Box& shape) const {
    Box box = transform_box(object_to_camera, shape);
    for (const auto& key : motion)
      box.add(transform_box(key.value, shape));
    box.grow(displacement_bound);
    return box;
  }
};

struct Primitive {
  std::shared_ptr<const PrimitiveState> state;
  std::shared_ptr<const Geometry> geometry; ///< when the shutter opens
  PatchVars vars;
  /// The part of the shaders' u and v that this surface is: patches of a mesh share one square.
  UvRect uv = {};
  MotionShapes deformation = {}; ///< from time 0 to 1; empty: it keeps its shape
  bool one_across = false;       ///< one micropolygon in u: hair

  const Attributes& attributes() const { return *state->attributes; }
  /// Box of a part in object space, at all times.
  Box bound(const UvRect& rect) const {
    Box shape = geometry->bound(rect);
    for (const auto& key : deformation)
      shape.add(key.value->bound(rect));
    return shape;
  }
  Box camera_bound(const UvRect& rect) const { return state->camera_bound(bound(rect)); }
};

} // namespace render
