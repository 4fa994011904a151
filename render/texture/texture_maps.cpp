#include "render/texture/texture_maps.h"

#include "render/texture/copy_values.h"
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
  constexpr size_t kBlock = ShadowRegions::kBlock;
  constexpr float kDefaultSamples = 16;
  ShadowRegions regions;
  regions.to_camera = l.current_to_world * map->world_to_camera;
  regions.to_screen = l.current_to_world * map->world_to_screen;
  regions.samples = static_cast<int>(
      std::clamp(l.options.samples > 0 ? l.options.samples : kDefaultSamples, 1.0f, 4096.0f));
  for (size_t first = 0; first < l.points; first += kBlock) {
    if ((l.mask[first / 64] >> first % 64 & 0xffff) == 0) continue;
    const size_t count = std::min(kBlock, l.points - first);
    for (size_t c = 0; c < 3; ++c) {
      copy_values(l.centre[c], first, count, regions.centre[c]);
      copy_values(l.along_u[c], first, count, regions.along_u[c]);
      copy_values(l.along_v[c], first, count, regions.along_v[c]);
    }
    copy_values(l.sblur, first, count, regions.sblur);
    copy_values(l.tblur, first, count, regions.tblur);
    copy_values(l.bias, first, count, regions.bias);
    for (size_t k = 0; k < count; ++k) {
      const uint32_t seed = static_cast<uint32_t>(first + k) * 0x9e3779b9u >> 8;
      regions.turn[k] = seed << 16;
      const float chance = static_cast<float>(seed * 0x85ebca6bu >> 8) * 0x1p-24f;
      if (l.bias.empty()) regions.bias[k] = settings_.shadow_bias + settings_.shadow_bias_spread * chance;
    }
    float shadowed[kBlock];
    map->shadowed(regions, shadowed);
    for (size_t c = 0; c < l.channels; ++c)
      for (size_t k = 0; k < count; ++k)
        if (l.active(first + k)) l.result[c][first + k] = shadowed[k];
  }
  return {};
}

} // namespace render
