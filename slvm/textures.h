// What texture(), environment() and shadow() ask of a renderer: lookups in maps, for all points of a grid at
// once. PUBLIC, abstract: render/texture implements it; so can an embedder.
#pragma once

#include "slvm/support/matrix.h"
#include "slvm/value.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

/// The optional arguments that are the same at all points.
struct TextureOptions {
  std::string_view filter; ///< "box", "disk", "gaussian", "triangle", "catmull-rom"; empty: the map's default
  float samples = 0;       ///< 0: the default of the kind of map
  float fill = 0;          ///< the value of channels the map lacks
  float ignore_above = std::numeric_limits<float>::infinity(); ///< texels with greater values do not count
  bool between_levels = true; ///< interpolate between the two nearest levels of a mip-map
};

/// A lookup for many points. Each has a region over which the map is averaged: the parallelogram about
/// `centre` with sides `along_u` and `along_v`. Regions without extent take one point of the map.
struct TextureLookup {
  static constexpr size_t kMost = 3;

  std::string_view map; ///< as the shader names it; never empty
  uint32_t first_channel = 0;
  uint32_t channels = 1; ///< 1 or 3
  TextureOptions options;

  size_t points = 0;
  const uint64_t* mask = nullptr; ///< a bit a point, 64 a word: points that are off need no result
  /// texture: s and t, (0, 0) upper left. environment: directions of any length, in the axes of the map.
  /// shadow: points in "current" space. By component, then point.
  std::vector<float> centre[kMost], along_u[kMost], along_v[kMost];
  /// Enlarges the region by this part of the map (of a whole turn: environment). One number, or one a point.
  std::vector<float> sblur, tblur;
  /// shadow: added to the depth of the map before comparing. Empty: the renderer's default.
  std::vector<float> bias;
  Matrix4 current_to_world; ///< shadow maps know where their camera stood in the world

  float* result[kMost] = {}; ///< `points` floats a channel, to be filled in

  bool active(size_t point) const { return (mask[point / 64] >> (point % 64) & 1) != 0; }
  static float at(const std::vector<float>& values, size_t point) {
    return values.empty() ? 0.0f : values[values.size() == 1 ? 0 : point];
  }
};

/// The texels of one level of a mip-map.
struct TextureTexels {
  size_t width = 0, height = 0, channels = 0;
  std::vector<float> values; ///< rows from the top, channels of a texel together; integers are 0 to 1
};

/// Calls come from many threads at once. They return "" or why there is nothing to be seen (a missing file);
/// results are then 0.
class TextureServices {
public:
  virtual ~TextureServices() = default;

  virtual std::string texture(const TextureLookup&) = 0;
  /// Latitude-longitude maps: s = longitude / 2 PI, t = (PI / 2 - latitude) / PI, z up.
  virtual std::string environment(const TextureLookup&) = 0;
  /// The part of the region that lies in shadow, 0 to 1; 0 outside the map.
  virtual std::string shadow(const TextureLookup&) = 0;
  /// textureinfo(): "resolution" float[2], "type" string, "channels" float, "viewingmatrix" and
  /// "projectionmatrix" matrix, from "current" space. False: no such map or field.
  virtual bool info(std::string_view map, std::string_view field, const Matrix4& current_to_world,
                    Value& out) = 0;
  /// All of a map at once: level 0 is the largest, each other one half of the one before, down to one texel.
  virtual std::string texels(std::string_view map, size_t level, TextureTexels& out) {
    out = {};
    (void)map, (void)level;
    return "this program gives no whole maps";
  }
};

} // namespace slvm
