// An image on its way to a file, and the ways there: TIFF and PNG by the libraries of these formats, the
// others by OpenImageIO's module (image_module.h), which takes longer to load than most frames to render.
#pragma once

#include "render/texture/pixels.h"
#include "slvm/value.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace render {

struct ImageFile {
  std::string path;
  std::string format;      ///< "tiff", "png", or a name that OpenImageIO knows
  std::string compression; ///< a name of the format's; empty: its usual one
  PixelType type = PixelType::kByte;
  int width = 0, height = 0;
  int x = 0, y = 0;                    ///< of the upper left pixel in the whole frame
  int full_width = 0, full_height = 0; ///< of the whole frame
  std::vector<std::string> channels;   ///< "R", "G", "B", "A", "Z" and names of variables
  float pixel_aspect = 1;
  std::array<float, 16> world_to_camera{}, world_to_screen{}; ///< by rows; zeros: none
  std::map<std::string, slvm::Value> attributes;              ///< others, by OpenImageIO's names
  std::vector<std::byte> pixels; ///< of `type`, channels of a pixel side by side, row by row from the top
  /// Of maps: "Shadow", "Plain Texture", "LatLong Environment", and what is beyond the sides,
  /// "periodic,clamp".
  std::string texture_format, wraps;
  std::vector<std::vector<std::byte>>
      levels; ///< of a mip-map, in tiles: those after `pixels`, each half as large

  static constexpr int kTile = 64; ///< side of a tile of a mip-map

  int channel(const std::string& name) const; ///< its place, or -1
};

/// "" or why there is no whole file.
std::string write_image_file(const ImageFile&);

} // namespace render
