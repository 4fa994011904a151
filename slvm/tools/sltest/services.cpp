#include "slvm/tools/sltest/services.h"

#include <filesystem>

namespace slvm::sltest {
namespace {

constexpr std::string_view kPrefix = "Ri:";

bool look_up(const std::map<std::string, Value, std::less<>>& values, std::string_view name, Value& out) {
  auto it = values.find(name);
  if (it == values.end() && name.starts_with(kPrefix)) it = values.find(name.substr(kPrefix.size()));
  if (it == values.end()) return false;
  out = it->second;
  return true;
}

/// From "camera" to "screen", for an orthographic view.
Matrix4 screen_matrix(const Scene& scene) {
  float near = 0, far = 1;
  Value clipping;
  if (look_up(scene.options, "Clipping", clipping) && clipping.numbers.size() == 2) {
    near = clipping.numbers[0];
    far = clipping.numbers[1];
  }
  Matrix4 m;
  m(2, 2) = 1 / (far - near);
  m(3, 2) = -near / (far - near);
  return m;
}

Matrix4 ndc_matrix(const Scene& scene) {
  Matrix4 window;
  window(0, 0) = 0.5f;
  window(1, 1) = -0.5f;
  window(3, 0) = window(3, 1) = 0.5f;
  return screen_matrix(scene) * window;
}

Matrix4 raster_matrix(const Scene& scene, const Grid& grid) {
  Matrix4 scale;
  scale(0, 0) = static_cast<float>(grid.nu());
  scale(1, 1) = static_cast<float>(grid.nv());
  return ndc_matrix(scene) * scale;
}

} // namespace

bool MemoryServices::current_to_space(const ShadingState& state, std::string_view space, Matrix4& m) {
  if (auto it = scene_.spaces.find(space); it != scene_.spaces.end()) return invert(it->second, m);
  m = Matrix4();
  if (space == "world" || space == "camera") return true;
  Matrix4 to_camera;
  if (auto it = scene_.spaces.find("camera"); it != scene_.spaces.end() && !invert(it->second, to_camera))
    return false;
  if (space == "screen")
    m = to_camera * screen_matrix(scene_);
  else if (space == "NDC")
    m = to_camera * ndc_matrix(scene_);
  else if (space == "raster")
    m = to_camera * raster_matrix(scene_, state.grid);
  else
    return false;
  return true;
}

bool MemoryServices::space_to_current(const ShadingState& state, std::string_view space, Matrix4& m) {
  if (auto it = scene_.spaces.find(space); it != scene_.spaces.end()) {
    m = it->second;
    return true;
  }
  Matrix4 back;
  return current_to_space(state, space, back) && invert(back, m);
}

bool MemoryServices::attribute(const ShadingState&, std::string_view name, Value& out) {
  return look_up(scene_.attributes, name, out);
}

bool MemoryServices::option(const ShadingState& state, std::string_view name, Value& out) {
  if (look_up(scene_.options, name, out)) return true;
  if (name.starts_with(kPrefix)) name.remove_prefix(kPrefix.size());
  if (name == "Format") {
    out = {
        Type::kFloat, 3, {static_cast<float>(state.grid.nu()), static_cast<float>(state.grid.nv()), 1}, {}};
  } else if (name == "Clipping") {
    out = {Type::kFloat, 2, {0, 1}, {}};
  } else {
    return ray_scene_ && ray_scene_->option(state, name, out);
  }
  return true;
}

bool MemoryServices::renderer_info(const ShadingState&, std::string_view name, Value& out) {
  if (name == "renderer")
    out = {Type::kString, 0, {}, {"sltest"}};
  else if (name == "version")
    out = {Type::kFloat, 4, {0, 1, 0, 0}, {}};
  else if (name == "versionstring")
    out = {Type::kString, 0, {}, {"0.1.0"}};
  else
    return false;
  return true;
}

namespace {

auto finder(std::vector<std::string> path) {
  return [folders = std::move(path)](std::string_view name) {
    namespace fs = std::filesystem;
    std::error_code ec;
    for (const std::string& folder : folders)
      if (fs::path file = fs::path(folder) / name; fs::is_regular_file(file, ec)) return file.string();
    return std::string(name);
  };
}

} // namespace

Clouds::Clouds(std::vector<std::string> path) : files(finder(path)), lookups(cache, finder(path)) {}

TextureServices* MemoryServices::textures() {
  constexpr float kBias = 0.01f;
  Value bias;
  bool given = look_up(scene_.options, "shadow:bias", bias) && bias.numbers.size() == 1;
  return scene_.textures ? scene_.textures->get(given ? bias.numbers[0] : kBias) : nullptr;
}

} // namespace slvm::sltest
