// Pictures and shadow maps as TIFF files. Matrices and the size of the whole frame are
// in the tags that Pixar registered for them.
#pragma once

#include <string>

namespace render {

struct ImageFile;

/// Whether write_tiff() knows the compression: "", "none", "zip", "lzw" or "packbits".
bool tiff_compresses(const std::string& name);
/// "" or why there is no whole file.
std::string write_tiff(const ImageFile&);

} // namespace render
