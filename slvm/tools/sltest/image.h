// Writing the values of a variable over a grid to a file. Row iv = 0 of the grid is the top row of the image.
//
// .pfm needs no library: floats, one or three channels. .csv and .txt hold a line for each point: iu, iv and
// the numbers, with nine digits, so that every float can be read back. All other formats go through
// OpenImageIO when this build has it (.png, .tif: values are clamped to [0, 1] and stored linearly, as 8 and
// 16 bits; .exr: as floats).
#pragma once

#include "slvm/support/result.h"
#include "slvm/tools/sltest/grid_data.h"

#include <string>

namespace slvm::sltest {

Result<bool> write_variable(const std::string& path, const Variable& variable, int nu, int nv);

/// How .exr files store numbers: as floats, or as halves, which take half the space.
enum class PixelSize : uint8_t { kFull, kSmall };

/// By the module sltest_images.so, where there is one. `pixels`: row by row, interleaved. The file is written
/// to a temporary name and renamed.
Result<bool> write_image(const std::string& path, const std::vector<float>& pixels, int nu, int nv,
                         int channels, PixelSize size = PixelSize::kFull);

struct Image {
  int nu = 0, nv = 0, channels = 0;
  std::vector<float> pixels;
  std::vector<float> rounded; ///< what becomes of other pixels in a file like this
};
/// Reads an image by the module; `others` are rounded as the file's pixels are.
Result<Image> read_image(const std::string& path, const std::vector<float>& others);

} // namespace slvm::sltest
