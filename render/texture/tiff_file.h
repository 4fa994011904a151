// TIFF files by libtiff: pictures, depth images and shadow maps. Matrices and the size of the whole frame are
// in the tags that Pixar registered for them.
#pragma once

#include <string>

namespace render {

struct DepthImage;
struct ImageFile;

/// Whether write_tiff() knows the compression: "", "none", "zip", "lzw" or "packbits".
bool tiff_compresses(const std::string& name);
/// "" or why there is no whole file.
std::string write_tiff(const ImageFile&);

/// Reads a TIFF file with one channel of floats. False: it is another kind of file, or none.
bool read_depth_tiff(const std::string& path, DepthImage& out);

} // namespace render
