// Texture, environment and shadow maps by OpenImageIO. Ordinary image files serve as well as tiled mip-maps,
// for which OpenImageIO makes levels as they are needed.
#pragma once

#include "slvm/textures.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace render {

class ShadowMap;

class TextureMaps : public slvm::TextureServices {
public:
  struct Settings {
    std::string search_path;   ///< folders, separated by colons
    float shadow_bias = 0.01f; ///< where the shader says none
    float memory_megabytes = 1024;
  };
  explicit TextureMaps(const Settings&);
  ~TextureMaps() override;

  std::string texture(const slvm::TextureLookup&) override;
  std::string environment(const slvm::TextureLookup&) override;
  std::string shadow(const slvm::TextureLookup&) override;
  bool info(std::string_view map, std::string_view field, const slvm::Matrix4& current_to_world,
            slvm::Value& out) override;

private:
  class System;
  System& system(); ///< made when it is first asked for
  /// The map, read once; null with the reason.
  std::shared_ptr<const ShadowMap> shadow_map(const std::string& name, std::string& problem);

  Settings settings_;
  std::once_flag system_made_;
  std::unique_ptr<System> system_;
  std::mutex shadows_mutex_;
  struct LoadedShadow {
    std::shared_ptr<const ShadowMap> map;
    std::string problem;
  };
  std::map<std::string, LoadedShadow, std::less<>> shadows_;
};

} // namespace render
