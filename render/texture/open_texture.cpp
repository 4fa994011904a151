#include "render/texture/open_texture.h"

#include "render/texture/image_module.h"
#include "render/texture/texture_png.h"
#include "render/texture/texture_tiff.h"

#include <filesystem>
#include <fstream>

namespace render {

namespace {

/// PRMan's format before it took TIFF, in either order of bytes. It is not public.
bool is_early_prman(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const int first = in.get(), second = in.get();
  return (first == 0xfa && second == 0xce) || (first == 0xce && second == 0xfa);
}

} // namespace

std::unique_ptr<TextureReader> open_texture(const std::string& file, std::string& problem) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    problem = "there is no such file";
    return nullptr;
  }
  if (auto reader = open_tiff_texture(file)) return reader;
  if (auto reader = open_png_texture(file)) return reader;
  if (is_early_prman(file)) {
    problem = "it is in PRMan's own format of before TIFF; make it anew of its image, by MakeTexture";
    return nullptr;
  }
  const ImageModule& module = image_module();
  if (!module.problem.empty()) {
    problem = module.problem;
    return nullptr;
  }
  return module.open_texture(file, problem);
}

} // namespace render
