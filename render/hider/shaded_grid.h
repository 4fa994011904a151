// A shaded grid as the hider wants it: micropolygons in raster space with their colours.
#pragma once

#include "render/hider/image.h"
#include "render/prims/primitive.h"
#include "render/prims/stitch.h"
#include "render/shading/grid_shader.h"

#include <cstdint>
#include <span>
#include <vector>

namespace render {

struct ShadedGrid {
  int nu = 0, nv = 0;         ///< points
  std::vector<Vec3> position; ///< raster x and y, camera z
  std::vector<Color> Ci, Oi;
  std::vector<float> aov; ///< aov_floats a point
  int aov_floats = 0;
  std::vector<uint8_t> hidden; ///< for each micropolygon: not to be drawn
  bool matte = false;
  bool smooth = false;
  size_t bad_colours = 0; ///< points whose colour was not a finite number; they became black and opaque
};

/// From a grid that was displaced and shaded. Micropolygons that face away (Sides 1) or touch the eye plane
/// are hidden. Null outline: none is needed.
ShadedGrid make_shaded_grid(const Primitive& primitive, const slvm::Grid& grid, const Camera& camera,
                            const GridOutline* outline, std::span<const AovChannel> aovs, GridShader& shader);

} // namespace render
