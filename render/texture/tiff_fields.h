// Fields of TIFF directories that several readers want. For those who link libtiff.
#pragma once

#include <tiffio.h>

#include <string>
#include <vector>

namespace render {

/// "" when there is none.
inline std::string text_field(TIFF* t, uint32_t tag) {
  const char* out = nullptr;
  return TIFFGetField(t, tag, &out) && out ? out : "";
}

/// One of Pixar's: 16 numbers, or none.
inline std::vector<float> matrix_field(TIFF* t, uint32_t tag) {
  const float* numbers = nullptr; // libtiff knows these tags to have 16
  if (!TIFFGetField(t, tag, &numbers) || !numbers) return {};
  return {numbers, numbers + 16};
}

} // namespace render
