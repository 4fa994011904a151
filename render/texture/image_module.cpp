#include "render/texture/image_module.h"

#include "render/texture/texture_image.h"

#include <dlfcn.h>

#include <filesystem>

namespace render {

namespace {

ImageModule load() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  ImageModule module;
  module.problem = "without anemone_images.so (OpenImageIO) there are only TIFF and PNG files";
  for (const char* place : {"anemone_images.so", "../lib/anemone/anemone_images.so"}) {
    const fs::path file = folder / place;
    if (!fs::exists(file, error)) continue;
    // Never closed: the library behind it has threads of its own.
    void* handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    using Fill = void (*)(ImageModule*);
    auto fill = handle ? reinterpret_cast<Fill>(dlsym(handle, "anemone_image_module")) : nullptr;
    if (!fill) {
      const char* why = dlerror();
      module.problem = file.string() + " cannot be loaded: " + (why ? why : "unknown reason");
      continue;
    }
    module.problem.clear();
    fill(&module);
    break;
  }
  return module;
}

} // namespace

const ImageModule& image_module() {
  static const ImageModule kModule = load();
  return kModule;
}

} // namespace render
