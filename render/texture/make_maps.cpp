#include "render/texture/make_maps.h"

#include "render/texture/depth_image.h"
#include "render/texture/image_file.h"
#include "render/texture/image_module.h"
#include "render/texture/tiff_file.h"
#include "slvm/support/whole_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace render {

namespace {

namespace fs = std::filesystem;

/// A shadow map of a depth image in a TIFF file: the same numbers, called a shadow map. Lookups take the
/// finest level only, so that no others are made.
std::string write_shadow(const DepthImage& depths, const std::string& shadow) {
  slvm::WholeFile whole(shadow);
  ImageFile file;
  file.path = whole.temporary();
  file.format = "tiff";
  file.texture_format = "Shadow";
  file.type = PixelType::kFloat;
  file.width = file.full_width = depths.width;
  file.height = file.full_height = depths.height;
  file.channels = {"Z"};
  std::copy_n(depths.world_to_camera.begin(), 16, file.world_to_camera.begin());
  std::copy_n(depths.world_to_screen.begin(), 16, file.world_to_screen.begin());
  file.pixels.resize(depths.depth.size() * sizeof(float));
  std::memcpy(file.pixels.data(), depths.depth.data(), file.pixels.size());
  std::string why = write_tiff(file);
  if (why.empty()) why = whole.commit();
  return why.empty() ? why : "cannot make \"" + shadow + "\": " + why;
}

} // namespace

std::string make_texture(const std::string& image, const std::string& texture, const MakeSettings& settings) {
  const ImageModule& module = image_module();
  return module.problem.empty() ? module.make_texture(image, texture, settings) : module.problem;
}

std::string make_bump(const std::string& image, const std::string& bump, const MakeSettings& settings) {
  const ImageModule& module = image_module();
  return module.problem.empty() ? module.make_bump(image, bump, settings) : module.problem;
}

std::string make_latlong(const std::string& image, const std::string& texture, const MakeSettings& settings) {
  const ImageModule& module = image_module();
  return module.problem.empty() ? module.make_latlong(image, texture, settings) : module.problem;
}

std::string make_cube_environment(const std::array<std::string, 6>& faces, const std::string& texture,
                                  float fov, const MakeSettings& settings) {
  const ImageModule& module = image_module();
  return module.problem.empty() ? module.make_cube_environment(faces, texture, fov, settings)
                                : module.problem;
}

std::string make_shadow(const std::string& depths, const std::string& shadow) {
  DepthImage image;
  if (fs::path(shadow).extension() != ".exr" && read_depth_tiff(depths, image) &&
      image.world_to_camera.size() == 16 && image.world_to_screen.size() == 16)
    return write_shadow(image, shadow);
  const ImageModule& module = image_module();
  return module.problem.empty() ? module.make_shadow(depths, shadow) : module.problem;
}

} // namespace render
