// Image files of every format that OpenImageIO writes.
#include "render/texture/image_file.h"

#include "render/oiio/functions.h"

#include <OpenImageIO/imageio.h>

namespace render::oiio {

namespace {

OIIO::TypeDesc type_of(PixelType type) {
  if (type == PixelType::kByte) return OIIO::TypeDesc::UINT8;
  return type == PixelType::kShort ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

} // namespace

bool knows_format(const std::string& name) {
  return OIIO::ImageOutput::create(name) != nullptr;
}

std::string write_image(const ImageFile& image) {
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                       type_of(image.type));
  spec.x = image.x;
  spec.y = image.y;
  spec.full_width = image.full_width;
  spec.full_height = image.full_height;
  spec.channelnames = image.channels;
  spec.alpha_channel = image.channel("A");
  spec.z_channel = image.channel("Z");
  spec.attribute("Software", "Anemone slrender");
  spec.attribute("PixelAspectRatio", image.pixel_aspect);
  spec.attribute("worldtocamera", OIIO::TypeMatrix, image.world_to_camera.data());
  spec.attribute("worldtoscreen", OIIO::TypeMatrix, image.world_to_screen.data());
  // Rendered noise hardly gets smaller by trying harder.
  spec.attribute("tiff:zipquality", 2);
  spec.attribute("png:compressionLevel", 2);
  if (!image.compression.empty()) spec.attribute("compression", image.compression);
  auto out = OIIO::ImageOutput::create(image.format);
  if (!out) return OIIO::geterror();
  if (out->open(image.path, spec) && out->write_image(spec.format, image.pixels.data()) && out->close())
    return {};
  return out->geterror();
}

} // namespace render::oiio
