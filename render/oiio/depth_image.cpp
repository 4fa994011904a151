// Depth images by OpenImageIO.
#include "render/texture/depth_image.h"
#include "render/oiio/functions.h"
#include "render/oiio/spec_matrix.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>

namespace render::oiio {

std::string read_depth(const std::string& path, DepthImage& out) {
  auto in = OIIO::ImageInput::open(path);
  if (!in) return OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  out.world_to_camera = matrix(spec, "worldtocamera");
  out.world_to_screen = matrix(spec, "worldtoscreen");
  out.width = spec.width;
  out.height = spec.height;
  out.depth.resize(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height));
  int channel = std::max(spec.z_channel, 0);
  if (!in->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, out.depth.data()))
    return in->geterror();
  return {};
}

} // namespace render::oiio
