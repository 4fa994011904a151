// What a lookup in a map covers, and its optional arguments, whoever asks: a shader (textures.cpp) or a
// plug-in (plugin_lookups.cpp).
#pragma once

#include "slvm/textures.h"

namespace slvm {

enum class MapKind : uint8_t { kTexture, kEnvironment, kShadow };

/// Asks the renderer (null: there is none). "" or why nothing is to be seen.
std::string look_up(TextureServices* textures, MapKind kind, const TextureLookup& lookup);

/// The region of a point from four corners, by component. They come row by row, as those of a patch, or in
/// turn: the order in which they enclose more is meant. The region's vectors hold the point already.
void set_region(TextureLookup& lookup, size_t point, size_t dimensions, const float (&corners)[4][3]);

/// "width" and its relatives, factors of regions: one number, or one a point; empty: 1.
struct LookupWidths {
  std::vector<float> s, t;
};
void scale_region(TextureLookup& lookup, size_t dimensions, const LookupWidths& widths);

/// An optional argument with numbers, one or one a point. False: lookups have none of this name.
bool set_lookup_option(TextureLookup& lookup, LookupWidths& widths, std::string_view token,
                       std::vector<float> values);

} // namespace slvm
