#include "render/texture/png_file.h"

#include "render/texture/image_file.h"

#include <png.h>

#include <algorithm>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>

namespace render {

namespace {

struct Close {
  void operator()(FILE* f) const { std::fclose(f); }
};

/// libpng's message; back to where the writing began.
[[noreturn]] void fail(png_structp png, png_const_charp text) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = text;
  png_longjmp(png, 1);
}
void no_warning(png_structp, png_const_charp) {}

int color_type(size_t channels) {
  constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                            PNG_COLOR_TYPE_RGB_ALPHA};
  return kTypes[channels - 1];
}

/// PNG has colours that alpha did not scale; ours are scaled by it.
template <class T> void unscale(std::vector<std::byte>& pixels, size_t channels) {
  constexpr float kOne = static_cast<float>(static_cast<T>(~T(0)));
  auto* p = reinterpret_cast<T*>(pixels.data());
  for (auto* end = p + pixels.size() / sizeof(T); p != end; p += channels) {
    const float alpha = static_cast<float>(p[channels - 1]);
    if (alpha == 0 || alpha == kOne) continue;
    for (size_t c = 0; c + 1 < channels; ++c)
      p[c] = static_cast<T>(std::min(static_cast<float>(p[c]) * kOne / alpha, kOne) + 0.5f);
  }
}

std::vector<std::byte> png_pixels(const ImageFile& image) {
  std::vector<std::byte> pixels = image.pixels;
  const size_t channels = image.channels.size();
  if (channels == 2 || channels == 4) {
    if (image.type == PixelType::kByte) unscale<uint8_t>(pixels, channels);
    if (image.type == PixelType::kShort) unscale<uint16_t>(pixels, channels);
  }
  return pixels;
}

/// No object with a destructor may live here: errors jump out of it.
bool write_rows(png_structp png, png_infop info, FILE* file, const ImageFile& image, std::byte* pixels) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_init_io(png, file);
  const bool wide = image.type == PixelType::kShort;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
               wide ? 16 : 8, color_type(image.channels.size()), PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 2); // rendered noise hardly gets smaller by trying harder
  if (image.x != 0 || image.y != 0) png_set_oFFs(png, info, image.x, image.y, PNG_OFFSET_PIXEL);
  if (image.pixel_aspect != 1)
    png_set_pHYs(png, info, 1000000, static_cast<png_uint_32>(1e6f * image.pixel_aspect),
                 PNG_RESOLUTION_UNKNOWN);
  char key[] = "Software", maker[] = "Anemone slrender";
  png_text text{};
  text.compression = PNG_TEXT_COMPRESSION_NONE;
  text.key = key;
  text.text = maker;
  png_set_text(png, info, &text, 1);
  png_write_info(png, info);
  if (wide) png_set_swap(png); // big-endian in the file
  const size_t row = static_cast<size_t>(image.width) * image.channels.size() * (wide ? 2 : 1);
  for (int y = 0; y < image.height; ++y)
    png_write_row(png, reinterpret_cast<png_const_bytep>(pixels + static_cast<size_t>(y) * row));
  png_write_end(png, nullptr);
  return true;
}

} // namespace

std::string write_png(const ImageFile& image) {
  const size_t channels = image.channels.size();
  if (channels < 1 || channels > 4) return "PNG has one to four channels, not " + std::to_string(channels);
  std::unique_ptr<FILE, Close> file(std::fopen(image.path.c_str(), "wb"));
  if (!file) return std::strerror(errno);
  std::string problem;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &problem, fail, no_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  bool written = false;
  if (info) {
    std::vector<std::byte> pixels = png_pixels(image);
    written = write_rows(png, info, file.get(), image, pixels.data());
  }
  png_destroy_write_struct(&png, &info);
  if (std::fclose(file.release()) != 0 && problem.empty()) problem = std::strerror(errno);
  if (written && problem.empty()) return {};
  return problem.empty() ? "cannot be written" : problem;
}

} // namespace render
