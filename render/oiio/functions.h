// The functions of the module anemone_images.so, as render/texture/image_module.h describes them. Nothing
// else of the renderer uses OpenImageIO.
#pragma once

#include "render/texture/image_module.h"

namespace render::oiio {

std::unique_ptr<TextureReader> open_texture(const std::string& path, std::string& problem);
bool knows_format(const std::string& name);
std::string write_image(const ImageFile&);
std::string read_depth(const std::string& path, DepthImage&);

} // namespace render::oiio
