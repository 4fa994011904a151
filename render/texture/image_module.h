// What OpenImageIO does for the renderer: a module, anemone_images.so, since that library and the two hundred
// below it take a fifth of a second and a hundred megabytes to load. It is loaded when it is first needed:
// for textures, and for files other than TIFF and PNG.
#pragma once

#include "render/texture/make_maps.h"
#include "slvm/textures.h"

#include <memory>
#include <string>
#include <utility>

namespace render {

struct DepthImage;
struct ImageFile;

/// texture(), environment() and textureinfo() of files; `map` of a lookup is the name in messages.
class ImageLookups {
public:
  virtual ~ImageLookups() = default;

  /// "" or why nothing can be seen.
  virtual std::string texture(const std::string& file, const slvm::TextureLookup&) = 0;
  virtual std::string environment(const std::string& file, const slvm::TextureLookup&) = 0;
  /// slvm::TextureServices::info.
  virtual bool info(const std::string& file, std::string_view field, const slvm::Matrix4& current_to_world,
                    slvm::Value& out) = 0;
  /// Files read so far, and bytes their tiles take.
  virtual std::pair<long long, long long> usage() = 0;
};

/// The functions of the module; unset when there is a `problem`. They return "" or why nothing was made.
struct ImageModule {
  std::string problem;
  std::unique_ptr<ImageLookups> (*make_lookups)(float memory_megabytes) = nullptr;
  bool (*knows_format)(const std::string& name) = nullptr; ///< a format that can be written
  std::string (*write_image)(const ImageFile&) = nullptr;
  std::string (*read_depth)(const std::string& path, DepthImage&) = nullptr;
  std::string (*make_texture)(const std::string&, const std::string&, const MakeSettings&) = nullptr;
  std::string (*make_bump)(const std::string&, const std::string&, const MakeSettings&) = nullptr;
  std::string (*make_latlong)(const std::string&, const std::string&, const MakeSettings&) = nullptr;
  std::string (*make_cube_environment)(const std::array<std::string, 6>&, const std::string&, float,
                                       const MakeSettings&) = nullptr;
  std::string (*make_shadow)(const std::string&, const std::string&) = nullptr;
};

/// Loaded at the first call, from beside this program or from where it is installed.
const ImageModule& image_module();

} // namespace render
