// Textures in all the formats of OpenImageIO.
#include "render/oiio/functions.h"
#include "render/oiio/pixel_types.h"
#include "render/oiio/spec_matrix.h"
#include "render/texture/texture_image.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>

namespace render::oiio {

namespace {

class Reader : public TextureReader {
public:
  explicit Reader(std::unique_ptr<OIIO::ImageInput> in) : in_(std::move(in)) {
    const OIIO::ImageSpec spec = in_->spec();
    header_.channels = spec.nchannels;
    header_.type = type_for(spec.format);
    header_.format = spec.get_string_attribute("textureformat");
    set_wraps(std::string(spec.get_string_attribute("wrapmodes")), header_);
    header_.world_to_camera = matrix(spec, "worldtocamera");
    header_.world_to_screen = matrix(spec, "worldtoscreen");
    ImageSize size{spec.width, spec.height};
    do {
      header_.levels.push_back(size);
      const OIIO::ImageSpec next = in_->spec_dimensions(0, static_cast<int>(header_.levels.size()));
      size = {next.width, next.height};
    } while (halves(header_.levels.back(), size));
    in_->geterror(); // that there is no further level is no mistake
  }

  std::string read(size_t level, std::span<std::byte> texels) override {
    if (in_->read_image(0, static_cast<int>(level), 0, header_.channels, type_of(header_.type),
                        texels.data()))
      return {};
    return in_->geterror();
  }

private:
  std::unique_ptr<OIIO::ImageInput> in_;
};

} // namespace

std::unique_ptr<TextureReader> open_texture(const std::string& path, std::string& problem) {
  auto in = OIIO::ImageInput::open(path);
  if (in && in->spec().width > 0 && in->spec().height > 0 && in->spec().nchannels > 0)
    return std::make_unique<Reader>(std::move(in));
  problem = in ? "it has no texels" : OIIO::geterror();
  std::replace(problem.begin(), problem.end(), '\n', ' ');
  while (problem.ends_with(' '))
    problem.pop_back();
  if (problem.empty()) problem = "it cannot be read";
  return nullptr;
}

} // namespace render::oiio
