// Texture lookups for sltest: the renderer's, in the module that holds OpenImageIO.
#include "render/texture/texture_maps.h"

/// Texture services that find files in these folders (separated by colons), to be deleted by the caller.
extern "C" slvm::TextureServices* sltest_make_textures(const char* search_path, float shadow_bias) {
  render::TextureMaps::Settings settings;
  settings.search_path = search_path;
  settings.shadow_bias = shadow_bias;
  return new render::TextureMaps(settings);
}
