// Textures of every kind of file.
#pragma once

#include "render/texture/texture_image.h"

#include <memory>
#include <string>

namespace render {

/// TIFF and PNG by the libraries of these formats, others by the image module. Null with the reason.
std::unique_ptr<TextureReader> open_texture(const std::string& file, std::string& problem);

} // namespace render
