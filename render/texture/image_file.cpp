#include "render/texture/image_file.h"

#include "render/texture/image_module.h"
#include "render/texture/png_file.h"
#include "render/texture/tiff_file.h"

#include <algorithm>

namespace render {

int ImageFile::channel(const std::string& name) const {
  auto it = std::find(channels.begin(), channels.end(), name);
  return it == channels.end() ? -1 : static_cast<int>(it - channels.begin());
}

std::string write_image_file(const ImageFile& image) {
  const bool plain = image.attributes.empty();
  if (plain && image.format == "tiff" && tiff_compresses(image.compression)) return write_tiff(image);
  if (plain && image.format == "png" && image.compression.empty()) return write_png(image);
  const ImageModule& module = image_module();
  return module.problem.empty() ? module.write_image(image) : module.problem;
}

} // namespace render
