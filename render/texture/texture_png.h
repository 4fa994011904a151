// Textures in PNG files.
#pragma once

#include "render/texture/texture_image.h"

#include <memory>
#include <string>

namespace render {

/// Null: not a PNG file, or one with transparency and a gamma of its own, which is not read here.
std::unique_ptr<TextureReader> open_png_texture(const std::string& path);

} // namespace render
