#include "render/texture/depth_image.h"

#include "render/texture/image_module.h"
#include "render/texture/tiff_file.h"

namespace render {

std::string read_depth_image(const std::string& path, DepthImage& out) {
  if (read_depth_tiff(path, out)) return {};
  const ImageModule& module = image_module();
  return module.problem.empty() ? module.read_depth(path, out) : module.problem;
}

} // namespace render
