// Depth images in TIFF files, and in others by the image module.
#include "render/texture/depth_image.h"

#include "render/texture/image_file.h"
#include "render/texture/image_module.h"
#include "render/texture/texture_tiff.h"
#include "slvm/support/whole_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace render {

bool read_depth_tiff(const std::string& path, DepthImage& out) {
  const auto reader = open_tiff_texture(path);
  if (!reader) return false;
  const TextureHeader& header = reader->header();
  if (header.channels != 1 || header.type != PixelType::kFloat) return false;
  out.width = header.levels[0].width;
  out.height = header.levels[0].height;
  out.depth.assign(static_cast<size_t>(out.width) * static_cast<size_t>(out.height), 0.0f);
  out.world_to_camera = header.world_to_camera;
  out.world_to_screen = header.world_to_screen;
  return reader->read(0, std::as_writable_bytes(std::span(out.depth))).empty();
}

std::string read_depth_image(const std::string& path, DepthImage& out) {
  if (read_depth_tiff(path, out)) return {};
  const ImageModule& module = image_module();
  return module.problem.empty() ? module.read_depth(path, out) : module.problem;
}

std::string write_depth_image(const std::string& path, const DepthImage& image,
                              const std::string& texture_format) {
  slvm::WholeFile whole(path);
  ImageFile file;
  file.path = whole.temporary();
  file.format = std::filesystem::path(path).extension() == ".exr" ? "openexr" : "tiff";
  file.texture_format = texture_format;
  file.type = PixelType::kFloat;
  file.width = file.full_width = image.width;
  file.height = file.full_height = image.height;
  file.channels = {"Z"};
  if (image.world_to_camera.size() == 16)
    std::copy_n(image.world_to_camera.begin(), 16, file.world_to_camera.begin());
  if (image.world_to_screen.size() == 16)
    std::copy_n(image.world_to_screen.begin(), 16, file.world_to_screen.begin());
  file.pixels.resize(image.depth.size() * sizeof(float));
  std::memcpy(file.pixels.data(), image.depth.data(), file.pixels.size());
  std::string why = write_image_file(file);
  return why.empty() ? whole.commit() : why;
}

} // namespace render
