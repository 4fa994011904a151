// Primitives that move while the shutter is open. Times are parts of the shutter time, 0 to 1. Between the
// given times points go in straight lines.
#pragma once

#include "render/prims/primitive_list.h"

#include <vector>

namespace render {

/// Where `time` lies among the keys: between `first` and the next one, at `weight`.
struct KeyPlace {
  size_t first = 0;
  float weight = 0;
};
template <class T> KeyPlace find_key(const std::vector<TimedValue<T>>& keys, float time) {
  if (time <= keys.front().time) return {0, 0};
  for (size_t i = 0; i + 1 < keys.size(); ++i)
    if (time < keys[i + 1].time) return {i, (time - keys[i].time) / (keys[i + 1].time - keys[i].time)};
  return {keys.size() - 1, 0};
}

/// Before the first key and after the last one their values hold. There must be one.
Matrix4 matrix_at(const MotionMatrices& keys, float time);
/// A surface between two of the keys has their points blended.
std::shared_ptr<const Geometry> shape_at(const MotionShapes& keys, float time);

/// The keys as the shutter sees them: times 0 to 1, first and last included. Empty if nothing moves while it
/// is open.
MotionMatrices clip_to_shutter(const MotionMatrices& keys, float open, float close);
MotionShapes clip_to_shutter(const MotionShapes& keys, float open, float close);

/// Appends surfaces that go from shape to shape; all lists are of as many, and the states of the first count.
void add_deforming(std::vector<TimedValue<PrimitiveList>> shapes, float open, float close,
                   PrimitiveList& out);

/// The times from which the motion is drawn, 0 and 1 included; empty if the primitive stands still.
std::vector<float> motion_times(const Primitive&);
/// The primitive as it is at a time, standing still.
Primitive primitive_at(const Primitive&, float time);

} // namespace render
