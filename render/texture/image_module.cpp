#include "render/texture/image_module.h"

#include "render/texture/texture_image.h"
#include "slvm/support/own_module.h"

namespace render {

namespace {

ImageModule load() {
  ImageModule module;
  using Fill = void (*)(ImageModule*);
  void* found = slvm::find_in_module(
      "anemone_images", "anemone_image_module",
      "without anemone_images.so (OpenImageIO) there are only TIFF and PNG files", module.problem);
  if (found) reinterpret_cast<Fill>(found)(&module);
  return module;
}

} // namespace

const ImageModule& image_module() {
  static const ImageModule kModule = load();
  return kModule;
}

} // namespace render
