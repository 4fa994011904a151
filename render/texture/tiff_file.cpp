#include "render/texture/tiff_file.h"

#include "render/texture/image_file.h"
#include "slvm/support/tiff_open.h"

#include <algorithm>
#include <cstdio>
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

uint16_t bits(PixelType type) {
  return type == PixelType::kByte ? 8 : type == PixelType::kShort ? 16 : 32;
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

constexpr int kRows = 64; // of a strip

void set_fields(TIFF* t, const ImageFile& image) {
  TIFFSetField(t, TIFFTAG_IMAGEWIDTH, static_cast<uint32_t>(image.width));
  TIFFSetField(t, TIFFTAG_IMAGELENGTH, static_cast<uint32_t>(image.height));
  TIFFSetField(t, TIFFTAG_BITSPERSAMPLE, bits(image.type));
  TIFFSetField(t, TIFFTAG_SAMPLEFORMAT,
               image.type == PixelType::kFloat ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(t, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(t, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(t, TIFFTAG_ROWSPERSTRIP, kRows);
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
  if (!image.texture_format.empty())
    TIFFSetField(t, TIFFTAG_PIXAR_TEXTUREFORMAT, image.texture_format.c_str());
  TIFFSetField(t, TIFFTAG_PIXAR_MATRIX_WORLDTOCAMERA, image.world_to_camera.data());
  TIFFSetField(t, TIFFTAG_PIXAR_MATRIX_WORLDTOSCREEN, image.world_to_screen.data());
}

bool write_strips(TIFF* t, const ImageFile& image) {
  const size_t row = static_cast<size_t>(image.width) * image.channels.size() * bits(image.type) / 8;
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

} // namespace

bool tiff_compresses(const std::string& name) {
  return compressions().count(name) > 0;
}

std::string write_tiff(const ImageFile& image) {
  Messages messages;
  File file = open_tiff(image.path, "w", messages);
  bool written = false;
  if (file) {
    set_fields(file.get(), image);
    written = write_strips(file.get(), image);
  }
  file.reset();
  if (written && messages.empty()) return {};
  return messages.empty() ? "cannot be written" : messages;
}

} // namespace render
