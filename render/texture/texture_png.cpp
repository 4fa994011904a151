// Palettes become colours, few bits eight, and what is transparent by its colour gets an alpha channel.
#include "render/texture/texture_png.h"

#include <png.h>

#include <bit>
#include <cstdio>
#include <filesystem>

namespace render {

namespace {

constexpr png_uint_32 kLargestSide = 1 << 16;
/// No compression makes texels smaller than by this: a header that promises more is wrong.
constexpr uint64_t kMostCompressed = 2048;

/// libpng's message; back to where the reading began.
[[noreturn]] void fail(png_structp png, png_const_charp text) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = text;
  png_longjmp(png, 1);
}
void no_warning(png_structp, png_const_charp) {}

/// A file from its beginning.
class PngFile {
public:
  explicit PngFile(const std::string& path)
      : file_(std::fopen(path.c_str(), "rb")),
        png_(file_ ? png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, fail, no_warning) : nullptr),
        info_(png_ ? png_create_info_struct(png_) : nullptr) {}
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;
  ~PngFile() {
    png_destroy_read_struct(&png_, &info_, nullptr);
    if (file_) std::fclose(file_);
  }

  // Errors jump out of these: no object with a destructor may live in them.
  bool read_header() {
    png_byte signature[8];
    if (!info_ || std::fread(signature, 1, sizeof signature, file_) != sizeof signature ||
        png_sig_cmp(signature, 0, sizeof signature) != 0)
      return false;
    if (setjmp(png_jmpbuf(png_))) return false;
    png_init_io(png_, file_);
    png_set_sig_bytes(png_, sizeof signature);
    png_read_info(png_, info_);
    png_set_expand(png_);
    if (std::endian::native == std::endian::little) png_set_swap(png_); // big-endian in the file
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool read_rows(std::byte* texels) {
    if (setjmp(png_jmpbuf(png_))) return false;
    for (int pass = 0; pass < passes_; ++pass)
      for (png_uint_32 y = 0; y < height(); ++y)
        png_read_row(png_, reinterpret_cast<png_bytep>(texels + y * row_bytes()), nullptr);
    return true;
  }

  png_uint_32 width() const { return png_get_image_width(png_, info_); }
  png_uint_32 height() const { return png_get_image_height(png_, info_); }
  int channels() const { return png_get_channels(png_, info_); }
  int bits() const { return png_get_bit_depth(png_, info_); }
  size_t row_bytes() const { return png_get_rowbytes(png_, info_); }
  bool has_alpha() const { return channels() % 2 == 0; }
  bool has_gamma() const { return png_get_valid(png_, info_, PNG_INFO_gAMA) != 0; }
  const std::string& message() const { return message_; }

private:
  std::string message_; ///< libpng's; must stay where it is
  FILE* file_;
  png_structp png_;
  png_infop info_;
  int passes_ = 1;
};

class PngTexture : public TextureReader {
public:
  PngTexture(std::string path, const PngFile& file) : path_(std::move(path)) {
    header_.levels = {{static_cast<int>(file.width()), static_cast<int>(file.height())}};
    header_.channels = file.channels();
    header_.type = file.bits() == 16 ? PixelType::kShort : PixelType::kByte;
    header_.straight_alpha = file.has_alpha();
  }
  /// Anew each time: libpng goes through a file once.
  std::string read(size_t, std::span<std::byte> texels) override {
    PngFile file(path_);
    const bool same = file.read_header() && file.height() * file.row_bytes() == texels.size();
    if (same && file.read_rows(texels.data())) return {};
    return file.message().empty() ? "its texels cannot be read" : file.message();
  }

private:
  std::string path_;
};

} // namespace

std::unique_ptr<TextureReader> open_png_texture(const std::string& path) {
  PngFile file(path);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || !file.read_header()) return nullptr;
  if (file.width() > kLargestSide || file.height() > kLargestSide || (file.has_alpha() && file.has_gamma()) ||
      uint64_t{file.height()} * file.row_bytes() / kMostCompressed > size)
    return nullptr;
  return std::make_unique<PngTexture>(path, file);
}

} // namespace render
