// Texture, environment and shadow maps: files found by name. Ordinary image files serve as well as tiled
// mip-maps: levels are made as they are needed (texture_image.h).
#pragma once

#include "render/texture/texture_lookups.h"
#include "slvm/textures.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace render {

class ShadowMap;

class TextureMaps : public slvm::TextureServices {
public:
  struct Settings {
    std::vector<std::string> folders; ///< where maps are looked for
    float shadow_bias = 0.01f;        ///< where the shader says none
    float shadow_bias_spread = 0;     ///< by chance, up to so much is added to it at each lookup
    float memory_megabytes = 1024;
  };
  explicit TextureMaps(const Settings&);
  ~TextureMaps() override;

  std::string texture(const slvm::TextureLookup&) override;
  std::string environment(const slvm::TextureLookup&) override;
  std::string shadow(const slvm::TextureLookup&) override;
  bool info(std::string_view map, std::string_view field, const slvm::Matrix4& current_to_world,
            slvm::Value& out) override;
  std::string texels(std::string_view map, size_t level, slvm::TextureTexels& out) override;

  /// Maps that were missing, and the files found in their place (find_image.h).
  std::map<std::string, std::string> replaced();

  /// Files read so far, and memory their tiles take.
  struct Usage {
    long long files = 0, bytes = 0;
  };
  Usage usage();

private:
  /// The map, read once; null with the reason.
  std::shared_ptr<const ShadowMap> shadow_map(const std::string& name, std::string& problem);

  Settings settings_;
  TextureLookups lookups_;
  struct File {
    std::string path; ///< the map's name when there is none
    bool exists = false;
  };
  const File& file_of(std::string_view map);

  std::mutex files_mutex_;
  std::map<std::string, File, std::less<>> files_;
  std::map<std::string, std::string> replaced_;
  std::mutex shadows_mutex_;
  struct LoadedShadow {
    std::shared_ptr<const ShadowMap> map;
    std::string problem;
  };
  std::map<std::string, LoadedShadow, std::less<>> shadows_;
};

} // namespace render
