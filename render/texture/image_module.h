// What OpenImageIO does for the renderer: a module, anemone_images.so, since that library and the two hundred
// below it take a fifth of a second and a hundred megabytes to load. It is loaded when it is first needed:
// for files other than TIFF and PNG.
#pragma once

#include <memory>
#include <string>

namespace render {

struct DepthImage;
struct ImageFile;
class TextureReader;

/// The functions of the module; unset when there is a `problem`. They return "" or why nothing was made.
struct ImageModule {
  std::string problem;
  std::unique_ptr<TextureReader> (*open_texture)(const std::string& path, std::string& problem) = nullptr;
  bool (*knows_format)(const std::string& name) = nullptr; ///< a format that can be written
  std::string (*write_image)(const ImageFile&) = nullptr;
  std::string (*read_depth)(const std::string& path, DepthImage&) = nullptr;
};

/// Loaded at the first call, from beside this program or from where it is installed.
const ImageModule& image_module();

} // namespace render
