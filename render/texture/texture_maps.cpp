#include "render/texture/texture_maps.h"

#include "render/texture/depth_image.h"
#include "render/texture/find_image.h"
#include "render/texture/shadow_map.h"

#include <algorithm>

namespace render {

using slvm::TextureLookup;

namespace {

constexpr const char* kNoFile = "no such file in the texture search path";

} // namespace

TextureMaps::TextureMaps(const Settings& settings)
    : settings_(settings), lookups_(settings.memory_megabytes) {}
TextureMaps::~TextureMaps() = default;

const TextureMaps::File& TextureMaps::file_of(std::string_view map) {
  std::lock_guard lock(files_mutex_);
  auto it = files_.find(map);
  if (it != files_.end()) return it->second;
  File file;
  if (auto found = find_image(map, settings_.folders)) {
    file = {*found, true};
    // The same name in a folder of the path is no replacement.
    if (*found != map && !found->ends_with("/" + std::string(map))) replaced_[std::string(map)] = *found;
  } else {
    file = {std::string(map), false};
  }
  return files_.emplace(std::string(map), std::move(file)).first->second;
}

std::map<std::string, std::string> TextureMaps::replaced() {
  std::lock_guard lock(files_mutex_);
  return replaced_;
}

TextureMaps::Usage TextureMaps::usage() {
  auto [files, bytes] = lookups_.usage();
  return {files, bytes};
}

std::string TextureMaps::texture(const TextureLookup& l) {
  const File& file = file_of(l.map);
  if (!file.exists) return kNoFile;
  return lookups_.texture(file.path, l);
}

std::string TextureMaps::environment(const TextureLookup& l) {
  const File& file = file_of(l.map);
  if (!file.exists) return kNoFile;
  return lookups_.environment(file.path, l);
}

bool TextureMaps::info(std::string_view map, std::string_view field, const slvm::Matrix4& current_to_world,
                       slvm::Value& out) {
  const File& file = file_of(map);
  if (!file.exists) return false;
  return lookups_.info(file.path, field, current_to_world, out);
}

std::string TextureMaps::texels(std::string_view map, size_t level, slvm::TextureTexels& out) {
  const File& file = file_of(map);
  if (!file.exists) return kNoFile;
  return lookups_.texels(file.path, level, out);
}

namespace {

std::shared_ptr<const ShadowMap> read_shadow_map(const std::string& path, std::string& problem) {
  DepthImage image;
  problem = read_depth_image(path, image);
  if (!problem.empty()) return nullptr;
  if (image.world_to_camera.empty() || image.world_to_screen.empty()) {
    problem = "is no shadow map: it lacks the matrices worldtocamera and worldtoscreen";
    return nullptr;
  }
  auto map = std::make_shared<ShadowMap>();
  std::copy_n(image.world_to_camera.begin(), 16, map->world_to_camera.m.begin());
  std::copy_n(image.world_to_screen.begin(), 16, map->world_to_screen.m.begin());
  map->width = image.width;
  map->height = image.height;
  map->depth = std::move(image.depth);
  return map;
}

} // namespace

std::shared_ptr<const ShadowMap> TextureMaps::shadow_map(const std::string& name, std::string& problem) {
  std::lock_guard lock(shadows_mutex_);
  auto [it, is_new] = shadows_.try_emplace(name);
  if (is_new) {
    const File& file = file_of(name);
    if (file.exists)
      it->second.map = read_shadow_map(file.path, it->second.problem);
    else
      it->second.problem = kNoFile;
  }
  problem = it->second.problem;
  return it->second.map;
}

std::string TextureMaps::shadow(const TextureLookup& l) {
  std::string problem;
  std::shared_ptr<const ShadowMap> map = shadow_map(std::string(l.map), problem);
  if (!map) return problem;
  constexpr float kDefaultSamples = 16;
  for (size_t i = 0; i < l.points; ++i) {
    if (!l.active(i)) continue;
    ShadowMap::Region r{};
    auto world = slvm::transform_point(l.current_to_world, {l.centre[0][i], l.centre[1][i], l.centre[2][i]});
    auto u = slvm::transform_vector(l.current_to_world, {l.along_u[0][i], l.along_u[1][i], l.along_u[2][i]});
    auto v = slvm::transform_vector(l.current_to_world, {l.along_v[0][i], l.along_v[1][i], l.along_v[2][i]});
    std::copy(world.begin(), world.end(), r.centre);
    std::copy(u.begin(), u.end(), r.along_u);
    std::copy(v.begin(), v.end(), r.along_v);
    r.sblur = TextureLookup::at(l.sblur, i);
    r.tblur = TextureLookup::at(l.tblur, i);
    r.samples = static_cast<int>(
        std::clamp(l.options.samples > 0 ? l.options.samples : kDefaultSamples, 1.0f, 4096.0f));
    r.seed = static_cast<uint32_t>(i) * 0x9e3779b9u >> 8;
    float chance = static_cast<float>(r.seed * 0x85ebca6bu >> 8) * 0x1p-24f;
    r.bias = l.bias.empty() ? settings_.shadow_bias + settings_.shadow_bias_spread * chance
                            : TextureLookup::at(l.bias, i);
    float shadowed = map->shadowed(r);
    for (size_t c = 0; c < l.channels; ++c)
      l.result[c][i] = shadowed;
  }
  return {};
}

} // namespace render
