#include "render/texture/image_module.h"

#include "render/texture/texture_image.h"
#include "slvm/support/own_module.h"

namespace render {

const ImageModule& image_module() {
  static const ImageModule kModule = slvm::load_module<ImageModule>(
      "anemone_images", "anemone_image_module",
      "without anemone_images.so (OpenImageIO) there are only TIFF and PNG files");
  return kModule;
}

} // namespace render
