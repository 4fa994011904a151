// Image files of every format that OpenImageIO writes.
#include "render/texture/image_file.h"

#include "render/oiio/functions.h"
#include "render/oiio/pixel_types.h"
#include "render/texture/shrink.h"

#include <OpenImageIO/imageio.h>

#include <cmath>

namespace render::oiio {

namespace {

void add_matrix(const char* name, const std::array<float, 16>& matrix, OIIO::ImageSpec& spec) {
  if (matrix != std::array<float, 16>{}) spec.attribute(name, OIIO::TypeMatrix, matrix.data());
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

OIIO::ImageSpec spec_of(const ImageFile& image) {
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
  add_matrix("worldtocamera", image.world_to_camera, spec);
  add_matrix("worldtoscreen", image.world_to_screen, spec);
  if (!image.texture_format.empty()) spec.attribute("textureformat", image.texture_format);
  if (!image.wraps.empty()) spec.attribute("wrapmodes", image.wraps);
  // Rendered noise hardly gets smaller by trying harder.
  spec.attribute("tiff:zipquality", 2);
  spec.attribute("png:compressionLevel", 2);
  for (const auto& [name, value] : image.attributes)
    add_attribute(name, value, spec);
  if (!image.compression.empty()) spec.attribute("compression", image.compression);
  return spec;
}

/// Each after the one before, in the same file.
bool write_levels(OIIO::ImageOutput& out, const ImageFile& image, OIIO::ImageSpec spec) {
  spec.tile_width = spec.tile_height = ImageFile::kTile;
  spec.attribute("openexr:levelmode", 1); // a mip-map
  if (!out.open(image.path, spec) || !out.write_image(spec.format, image.pixels.data())) return false;
  for (const std::vector<std::byte>& level : image.levels) {
    const ImageSize size = half_of({spec.width, spec.height});
    spec.full_width = spec.width = size.width;
    spec.full_height = spec.height = size.height;
    if (!out.open(image.path, spec, OIIO::ImageOutput::AppendMIPLevel) ||
        !out.write_image(spec.format, level.data()))
      return false;
  }
  return out.close();
}

} // namespace

bool knows_format(const std::string& name) {
  return OIIO::ImageOutput::create(name) != nullptr;
}

std::string write_image(const ImageFile& image) {
  const OIIO::ImageSpec spec = spec_of(image);
  auto out = OIIO::ImageOutput::create(image.format);
  if (!out) return OIIO::geterror();
  const bool written =
      image.levels.empty()
          ? out->open(image.path, spec) && out->write_image(spec.format, image.pixels.data()) && out->close()
          : write_levels(*out, image, spec);
  return written ? "" : out->geterror();
}

} // namespace render::oiio
