#include "render/texture/tiff_file.h"

#include "render/texture/image_file.h"
#include "render/texture/shrink.h"
#include "slvm/support/tiff_open.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>

namespace render {

namespace {

using Messages = std::string;
using File = slvm::TiffFile;
using slvm::open_tiff;

const std::map<std::string, uint16_t>& compressions() {
  static const std::map<std::string, uint16_t> kNames = {{"", COMPRESSION_ADOBE_DEFLATE},
                                                         {"none", COMPRESSION_NONE},
                                                         {"zip", COMPRESSION_ADOBE_DEFLATE},
                                                         {"lzw", COMPRESSION_LZW},
                                                         {"packbits", COMPRESSION_PACKBITS}};
  return kNames;
}

void set_compression(TIFF* t, const ImageFile& image) {
  uint16_t way = compressions().at(image.compression);
  TIFFSetField(t, TIFFTAG_COMPRESSION, way);
  if (way == COMPRESSION_NONE || way == COMPRESSION_PACKBITS) return;
  TIFFSetField(t, TIFFTAG_PREDICTOR,
               image.type == PixelType::kFloat ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
  // Rendered noise hardly gets smaller by trying harder.
  if (way == COMPRESSION_ADOBE_DEFLATE) TIFFSetField(t, TIFFTAG_ZIPQUALITY, 1);
}

/// Colours and what is beside them: the fourth channel is alpha when it is called so.
void set_channels(TIFF* t, const ImageFile& image) {
  const auto& names = image.channels;
  const bool colored = names.size() >= 3 && names[0] == "R" && names[1] == "G" && names[2] == "B";
  TIFFSetField(t, TIFFTAG_SAMPLESPERPIXEL, static_cast<uint16_t>(names.size()));
  TIFFSetField(t, TIFFTAG_PHOTOMETRIC,
               colored || names.size() == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
  std::vector<uint16_t> others;
  for (size_t i = colored || names.size() == 3 ? 3 : 1; i < names.size(); ++i)
    others.push_back(names[i] == "A" ? EXTRASAMPLE_ASSOCALPHA : EXTRASAMPLE_UNSPECIFIED);
  if (!others.empty())
    TIFFSetField(t, TIFFTAG_EXTRASAMPLES, static_cast<uint16_t>(others.size()), others.data());
}

void set_matrix(TIFF* t, uint32_t tag, const std::array<float, 16>& matrix) {
  if (matrix != std::array<float, 16>{}) TIFFSetField(t, tag, matrix.data());
}

constexpr int kRows = 64; // of a strip

/// Of the whole image or of one of its levels.
void set_fields(TIFF* t, const ImageFile& image, ImageSize size) {
  TIFFSetField(t, TIFFTAG_IMAGEWIDTH, static_cast<uint32_t>(size.width));
  TIFFSetField(t, TIFFTAG_IMAGELENGTH, static_cast<uint32_t>(size.height));
  TIFFSetField(t, TIFFTAG_BITSPERSAMPLE, static_cast<uint16_t>(8 * bytes_of(image.type)));
  TIFFSetField(t, TIFFTAG_SAMPLEFORMAT,
               image.type == PixelType::kFloat ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(t, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(t, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  if (image.levels.empty()) {
    TIFFSetField(t, TIFFTAG_ROWSPERSTRIP, kRows);
  } else {
    TIFFSetField(t, TIFFTAG_TILEWIDTH, ImageFile::kTile);
    TIFFSetField(t, TIFFTAG_TILELENGTH, ImageFile::kTile);
  }
  set_channels(t, image);
  set_compression(t, image);
  TIFFSetField(t, TIFFTAG_SOFTWARE, "Anemone slrender");
  // How wide a pixel is against its height; readers want both numbers, in no unit.
  TIFFSetField(t, TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
  TIFFSetField(t, TIFFTAG_XRESOLUTION, 1.0);
  TIFFSetField(t, TIFFTAG_YRESOLUTION, static_cast<double>(image.pixel_aspect));
  if (image.x != 0 || image.y != 0) {
    TIFFSetField(t, TIFFTAG_XPOSITION, static_cast<double>(image.x));
    TIFFSetField(t, TIFFTAG_YPOSITION, static_cast<double>(image.y));
  }
  TIFFSetField(t, TIFFTAG_PIXAR_IMAGEFULLWIDTH, static_cast<uint32_t>(image.full_width));
  TIFFSetField(t, TIFFTAG_PIXAR_IMAGEFULLLENGTH, static_cast<uint32_t>(image.full_height));
  if (!image.texture_format.empty()) {
    TIFFSetField(t, TIFFTAG_PIXAR_TEXTUREFORMAT, image.texture_format.c_str());
    TIFFSetField(t, TIFFTAG_PIXAR_FOVCOT, static_cast<float>(image.width) / static_cast<float>(image.height));
  }
  if (!image.wraps.empty()) TIFFSetField(t, TIFFTAG_PIXAR_WRAPMODES, image.wraps.c_str());
  set_matrix(t, TIFFTAG_PIXAR_MATRIX_WORLDTOCAMERA, image.world_to_camera);
  set_matrix(t, TIFFTAG_PIXAR_MATRIX_WORLDTOSCREEN, image.world_to_screen);
}

bool write_strips(TIFF* t, const ImageFile& image) {
  const size_t row = static_cast<size_t>(image.width) * image.channels.size() * bytes_of(image.type);
  std::vector<std::byte> strip; // libtiff changes it
  for (int y = 0, i = 0; y < image.height; y += kRows, ++i) {
    const size_t from = static_cast<size_t>(y) * row;
    const size_t size = static_cast<size_t>(std::min(kRows, image.height - y)) * row;
    strip.assign(image.pixels.data() + from, image.pixels.data() + from + size);
    if (TIFFWriteEncodedStrip(t, static_cast<uint32_t>(i), strip.data(), static_cast<tmsize_t>(size)) < 0)
      return false;
  }
  return TIFFFlush(t) != 0;
}

/// The next picture of a file, in tiles, those at the sides filled up with zeros.
bool write_level(TIFF* t, const ImageFile& image, ImageSize size, const std::vector<std::byte>& pixels) {
  constexpr size_t kSide = ImageFile::kTile;
  set_fields(t, image, size);
  const size_t pixel = image.channels.size() * bytes_of(image.type), width = static_cast<size_t>(size.width),
               height = static_cast<size_t>(size.height);
  std::vector<std::byte> tile(kSide * kSide * pixel);
  for (size_t y0 = 0; y0 < height; y0 += kSide)
    for (size_t x0 = 0; x0 < width; x0 += kSide) {
      std::fill(tile.begin(), tile.end(), std::byte{}); // libtiff changed it
      for (size_t y = y0; y < std::min(height, y0 + kSide); ++y)
        std::memcpy(&tile[(y - y0) * kSide * pixel], &pixels[(y * width + x0) * pixel],
                    std::min(kSide, width - x0) * pixel);
      if (TIFFWriteTile(t, tile.data(), static_cast<uint32_t>(x0), static_cast<uint32_t>(y0), 0, 0) < 0)
        return false;
    }
  return TIFFWriteDirectory(t) != 0;
}

bool write_levels(TIFF* t, const ImageFile& image) {
  ImageSize size{image.width, image.height};
  if (!write_level(t, image, size, image.pixels)) return false;
  for (const std::vector<std::byte>& level : image.levels) {
    size = half_of(size);
    TIFFSetField(t, TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE);
    if (!write_level(t, image, size, level)) return false;
  }
  return true;
}

} // namespace

bool tiff_compresses(const std::string& name) {
  return compressions().count(name) > 0;
}

std::string write_tiff(const ImageFile& image) {
  Messages messages;
  File file = open_tiff(image.path, "w", messages);
  bool written = false;
  if (file && image.levels.empty()) {
    set_fields(file.get(), image, {image.width, image.height});
    written = write_strips(file.get(), image);
  } else if (file) {
    written = write_levels(file.get(), image);
  }
  file.reset();
  if (written && messages.empty()) return {};
  return messages.empty() ? "cannot be written" : messages;
}

} // namespace render
