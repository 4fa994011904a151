#include "render/texture/make_maps.h"

#include "render/texture/depth_image.h"
#include "render/texture/image_module.h"
#include "render/texture/tiff_file.h"

#include <filesystem>

namespace render {

namespace {

namespace fs = std::filesystem;

/// Lookups take the finest level only, so that no others are made.
std::string write_shadow(const DepthImage& depths, const std::string& shadow) {
  std::string why = write_depth_image(shadow, depths, "Shadow");
  return why.empty() ? why : "cannot make \"" + shadow + "\": " + why;
}

} // namespace

bool has_width(std::string_view filter) {
  return filter == "box" || filter == "triangle" || filter == "gaussian";
}

bool widens(std::string_view filter, float width) {
  return has_width(filter) && width > (filter == "box" ? 1.0f : 2.0f);
}

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
