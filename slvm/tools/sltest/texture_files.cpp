// Texture lookups for sltest: the renderer's, in a module of their own.
#include "render/texture/texture_maps.h"

#include <sstream>

/// Texture services that find files in these folders (separated by colons), to be deleted by the caller.
extern "C" slvm::TextureServices* sltest_make_textures(const char* search_path, float shadow_bias) {
  render::TextureMaps::Settings settings;
  std::istringstream folders(search_path);
  for (std::string folder; std::getline(folders, folder, ':');)
    settings.folders.push_back(folder);
  settings.shadow_bias = shadow_bias;
  return new render::TextureMaps(settings);
}
