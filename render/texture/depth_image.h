// Depths as a camera saw them, from a z image or shadow map.
#pragma once

#include <string>
#include <vector>

namespace render {

struct DepthImage {
  int width = 0, height = 0;
  std::vector<float> depth; ///< camera z of the nearest surface, row by row from the top
  /// Of the world, by rows; empty when the file has none.
  std::vector<float> world_to_camera, world_to_screen;
};

/// Reads a TIFF file with one channel of floats. False: it is another kind of file, or none.
bool read_depth_tiff(const std::string& path, DepthImage& out);
/// "" or why there is none.
std::string read_depth_image(const std::string& path, DepthImage& out);
/// As a TIFF file of floats (OpenEXR if the name ends so), whole or not at all. `texture_format`: "Shadow"
/// for a shadow map, else empty. "" or what went wrong.
std::string write_depth_image(const std::string& path, const DepthImage& image,
                              const std::string& texture_format = {});

} // namespace render
