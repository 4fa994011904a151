// Textures in TIFF files: plain pictures, and the tiled files with levels that txmake and its relatives
// write.
#pragma once

#include "render/texture/texture_image.h"

#include <memory>
#include <string>

namespace render {

/// Null: not a TIFF file, or of a kind that is not read here (few bits, palettes, YCbCr, half floats).
std::unique_ptr<TextureReader> open_tiff_texture(const std::string& path);

} // namespace render
