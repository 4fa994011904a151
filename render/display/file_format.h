// Formats of image files: which one a Display means, what its pixels are, what its parameters say to it.
#pragma once

#include "render/state/options.h"
#include "render/texture/image_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace render {

struct FileFormat {
  std::string plugin; ///< OpenImageIO's name
  std::string extension;
  bool known = true; ///< false: nobody here knows the type, and the format is that of "file"
};

/// The format of a Display type. Interactive types of other renderers become files.
FileFormat choose_format(const DisplayRequest&);

/// What a channel becomes: quantised integers or floats.
PixelType pixel_type(const Quantization&, const std::string& plugin);

/// The compressions a format has, in lower case, as told to users; empty: it has its own and no choice.
std::vector<std::string_view> compressions(const std::string& plugin);
/// Whether a name, in lower case, is one of them. That of JPEG says the quality: "jpeg:85".
bool is_compression(const std::string& plugin, std::string_view name);

std::string lower_case(std::string text);

/// "compression", "resolution", and whatever nobody here knows, for the format to read.
void add_parameters(const DisplayRequest&, ImageFile&);

} // namespace render
