// The bound-and-split half of REYES: cuts a primitive into pieces small enough to dice, and drops what the
// camera cannot see. A piece is only a rectangle of the primitive's parameter square, so a frame's list of
// pieces is small.
#pragma once

#include "render/prims/primitive.h"
#include "render/state/camera.h"

#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

namespace render {

/// A piece that is ready to be diced.
struct GridTask {
  uint32_t primitive = 0; ///< index in the scene
  /// A bit for each of the primitives from there on: the whole of each of these is in the grid, one lattice
  /// above the other (join_tasks.h).
  uint64_t pieces = 1;
  UvRect rect;
  int nu = 2, nv = 2; ///< points of the lattice, of each piece
  Vec2 raster_min, raster_max;
  float zmin = 0, zmax = 0; ///< nearest and farthest camera z of its bound
  float step = 1;           ///< side of a micropolygon in pixels

  int count() const { return std::popcount(pieces); } ///< pieces
};

struct SplitSettings {
  const Camera* camera = nullptr;
  Vec2 raster_min{0.0f}, raster_max{0.0f}; ///< the area samples can lie in
  int grid_size = 256;                     ///< micropolygons in a grid, at most
  int eye_splits = 10;
  bool motion = true; ///< what moves is drawn moving
  /// Whether samples may lie in a rectangle of the raster; empty: anywhere. Pieces without are dropped,
  std::function<bool(Vec2 low, Vec2 high)> may_have_samples = {};
  /// unless their primitive is to be shaded all the same.
  std::function<bool(const Primitive&)> must_be_shaded = {};
};

/// Appends the visible pieces of scene primitive `index`, in an order that depends on nothing but the
/// arguments. What the camera does not see (Attribute "visibility" "camera" 0) has none.
void split_primitive(const Primitive& primitive, uint32_t index, const SplitSettings& settings,
                     std::vector<GridTask>& out);

} // namespace render
