// Pixels of TIFF files, of all the ways they can lie there, for those who link libtiff. PUBLIC
#pragma once

#include <tiffio.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace slvm {

/// What the directory a file is at says of its pixels.
struct TiffLayout {
  uint32_t width = 0, height = 0;
  uint16_t channels = 1, bits = 1, kind = SAMPLEFORMAT_UINT, photometric = PHOTOMETRIC_MINISBLACK,
           planar = PLANARCONFIG_CONTIG;

  explicit TiffLayout(TIFF* t) {
    TIFFGetField(t, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(t, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetFieldDefaulted(t, TIFFTAG_SAMPLESPERPIXEL, &channels);
    TIFFGetFieldDefaulted(t, TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetFieldDefaulted(t, TIFFTAG_SAMPLEFORMAT, &kind);
    TIFFGetField(t, TIFFTAG_PHOTOMETRIC, &photometric);
    TIFFGetFieldDefaulted(t, TIFFTAG_PLANARCONFIG, &planar);
  }
  bool is_float() const { return kind == SAMPLEFORMAT_IEEEFP && bits == 32; }
  /// Numbers of whole bytes.
  size_t sample_bytes() const { return bits / 8u; }
  size_t pixel_bytes() const { return sample_bytes() * channels; }
  uint64_t bytes() const { return uint64_t{width} * height * pixel_bytes(); }
};

/// Reads one plane of pixels after the other, or all channels together.
class TiffPixels {
public:
  TiffPixels(TIFF* file, const TiffLayout& layout) : file_(file), layout_(layout) {}

  /// All of them into layout.bytes() bytes: rows from the top, channels of a pixel side by side, whether in
  /// strips or tiles, together or in planes. False: the file is damaged.
  bool read(std::span<std::byte> pixels) {
    const bool apart = layout_.planar == PLANARCONFIG_SEPARATE && layout_.channels > 1;
    const size_t bytes = apart ? layout_.sample_bytes() : layout_.pixel_bytes();
    for (uint16_t plane = 0; plane < (apart ? layout_.channels : 1); ++plane) {
      std::byte* first = pixels.data() + plane * layout_.sample_bytes();
      if (!(TIFFIsTiled(file_) ? read_tiles(first, plane, bytes) : read_strips(first, plane, bytes)))
        return false;
    }
    return true;
  }

private:
  /// Copies `count` pieces of `bytes`, one behind the other, to pixels.
  void spread(const std::byte* from, size_t count, size_t bytes, std::byte* to) const {
    const size_t step = layout_.pixel_bytes();
    if (bytes == step) {
      std::memcpy(to, from, count * bytes);
      return;
    }
    for (size_t i = 0; i < count; ++i, from += bytes, to += step)
      std::memcpy(to, from, bytes);
  }

  /// `to`: where the first piece goes. Whole strips: libtiff takes longer to decode them row by row.
  bool read_strips(std::byte* to, uint16_t plane, size_t bytes) {
    const size_t width = layout_.width, row = width * bytes;
    uint32_t rows = 0;
    TIFFGetFieldDefaulted(file_, TIFFTAG_ROWSPERSTRIP, &rows);
    std::vector<std::byte> strip(static_cast<size_t>(TIFFStripSize(file_)));
    if (rows == 0 || strip.size() < std::min(rows, layout_.height) * row) return false;
    for (uint32_t y = 0; y < layout_.height; y += std::min(rows, layout_.height - y)) {
      const size_t here = std::min(rows, layout_.height - y), size = here * row;
      const tmsize_t found = TIFFReadEncodedStrip(file_, TIFFComputeStrip(file_, y, plane), strip.data(),
                                                  static_cast<tmsize_t>(size));
      if (found < static_cast<tmsize_t>(size)) return false;
      spread(strip.data(), here * width, bytes, to);
      to += here * width * layout_.pixel_bytes();
    }
    return true;
  }

  bool read_tiles(std::byte* to, uint16_t plane, size_t bytes) {
    uint32_t width = 0, height = 0;
    TIFFGetField(file_, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(file_, TIFFTAG_TILELENGTH, &height);
    std::vector<std::byte> tile(static_cast<size_t>(TIFFTileSize(file_)));
    if (width == 0 || height == 0 || tile.size() < size_t{width} * height * bytes) return false;
    for (size_t y0 = 0; y0 < layout_.height; y0 += height)
      for (size_t x0 = 0; x0 < layout_.width; x0 += width) {
        if (TIFFReadTile(file_, tile.data(), static_cast<uint32_t>(x0), static_cast<uint32_t>(y0), 0, plane) <
            0)
          return false;
        const size_t columns = std::min<size_t>(width, layout_.width - x0);
        for (size_t row = 0; row < std::min<size_t>(height, layout_.height - y0); ++row)
          spread(&tile[row * width * bytes], columns, bytes,
                 to + ((y0 + row) * layout_.width + x0) * layout_.pixel_bytes());
      }
    return true;
  }

  TIFF* file_;
  const TiffLayout& layout_;
};

} // namespace slvm
