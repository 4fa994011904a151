// Image files of every format that OpenImageIO writes.
#include "render/texture/image_file.h"

#include "render/oiio/functions.h"

#include <OpenImageIO/imageio.h>

#include <cmath>

namespace render::oiio {

namespace {

OIIO::TypeDesc type_of(PixelType type) {
  if (type == PixelType::kByte) return OIIO::TypeDesc::UINT8;
  return type == PixelType::kShort ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

/// Whole numbers as such: formats want them so.
void add_attribute(const std::string& name, const slvm::Value& value, OIIO::ImageSpec& spec) {
  const bool whole = value.numbers.size() == 1 && value.numbers[0] == std::floor(value.numbers[0]) &&
                     std::abs(value.numbers[0]) < 1e9f;
  if (value.strings.size() == 1)
    spec.attribute(name, value.strings[0]);
  else if (whole && name != "XResolution" && name != "YResolution")
    spec.attribute(name, static_cast<int>(value.numbers[0]));
  else if (value.numbers.size() == 1)
    spec.attribute(name, value.numbers[0]);
  else if (!value.numbers.empty())
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, static_cast<int>(value.numbers.size())),
                   value.numbers.data());
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
  for (const auto& [name, value] : image.attributes)
    add_attribute(name, value, spec);
  if (!image.compression.empty()) spec.attribute("compression", image.compression);
  auto out = OIIO::ImageOutput::create(image.format);
  if (!out) return OIIO::geterror();
  if (out->open(image.path, spec) && out->write_image(spec.format, image.pixels.data()) && out->close())
    return {};
  return out->geterror();
}

} // namespace render::oiio
