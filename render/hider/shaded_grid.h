// A shaded grid as the hider wants it: micropolygons in raster space with their colours.
#pragma once

#include "render/hider/image.h"
#include "render/prims/primitive.h"
#include "render/prims/stitch.h"
#include "render/shading/grid_shader.h"
#include "render/state/vec3_planes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace render {

/// A rectangle of the raster.
struct RasterBounds {
  Vec2 min{kInfinity}, max{-kInfinity};

  void add(Vec2 p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  bool touches(const PixelRect& r) const {
    return max.x >= static_cast<float>(r.x0) && min.x <= static_cast<float>(r.x1) &&
           max.y >= static_cast<float>(r.y0) && min.y <= static_cast<float>(r.y1);
  }
};

struct ShadedGrid {
  int nu = 0, nv = 0;            ///< points
  Vec3Planes position;           ///< raster x and y, camera z; of a moving grid at times[0]
  std::vector<Vec3Planes> later; ///< and at the other times
  std::vector<float> times;      ///< of a moving grid: parts of the shutter time, from 0 to 1; else empty
  Vec3Planes Ci, Oi;             ///< Oi is not looked at where `opaque`
  std::vector<float> aov;        ///< aov_floats planes
  int aov_floats = 0;
  /// For each micropolygon. What faces away and must not be seen still bounds a solid.
  enum Visibility : uint8_t { kDrawn, kNotDrawn, kFacesAway };
  std::vector<uint8_t> hidden;
  /// Around each row of micropolygons at all times, where it is in focus; empty: unknown.
  std::vector<RasterBounds> rows;
  std::shared_ptr<const SolidTree> solid; ///< that the surface belongs to; null: none
  SolidTree::NodeIndex solid_primitive = 0;
  bool cut_near = false; ///< the solid's primitive reaches in front of the near plane
  bool matte = false;
  bool opaque = false; ///< all Oi are 1
  LevelPart level;     ///< the samples that see it
  bool smooth = false;
  uint64_t variables = 0; ///< a bit for each of the first 64 AOVs that this grid has a value for
  size_t bad_colours = 0; ///< points whose colour was not a finite number; they became black and opaque

  size_t points() const { return static_cast<size_t>(nu) * static_cast<size_t>(nv); }
  /// A point at a part of the shutter time.
  Vec3 at(size_t point, float time) const {
    if (times.empty()) return position[point];
    size_t key = 0;
    while (key + 2 < times.size() && time > times[key + 1])
      ++key;
    // Two times are 0 and 1.
    float weight = times.size() == 2 ? time : (time - times[key]) / (times[key + 1] - times[key]);
    const Vec3 a = key == 0 ? position[point] : later[key - 1][point], b = later[key][point];
    return a + (b - a) * weight;
  }
  Color opacity(size_t point) const { return opaque ? Color(1.0f) : Oi[point]; }
};

/// Where the micropolygons of a displaced grid are. Those that touch the eye plane are not drawn, nor those
/// that face away (Sides 1); of a solid these are kept, marked. Null outline: none is needed.
ShadedGrid make_grid_geometry(const Primitive& primitive, const slvm::Grid& grid, const Camera& camera,
                              const GridOutline* outline);

/// Adds what they look like, from a grid that was shaded. `points`: it holds these of them alone, and others
/// are not looked at; empty: all.
void add_looks(ShadedGrid& shaded, const Primitive& primitive, const slvm::Grid& grid,
               std::span<const uint32_t> points, std::span<const AovChannel> aovs, GridShader& shader);

/// Adds where the points are at a later time, from a grid that was displaced.
void add_positions(ShadedGrid& shaded, float time, const slvm::Grid& grid, const Camera& camera,
                   const GridOutline* outline);

} // namespace render
