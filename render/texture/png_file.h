// PNG files by libpng.
#pragma once

#include <string>

namespace render {

struct ImageFile;

/// Bytes or shorts, one to four channels. "" or why there is no whole file.
std::string write_png(const ImageFile&);

} // namespace render
