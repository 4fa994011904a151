#include "render/texture/texture_tiff.h"

#include "slvm/support/tiff_open.h"
#include "slvm/support/tiff_pixels.h"

#include <filesystem>

namespace render {

namespace {

constexpr uint32_t kLargestSide = 1 << 16;
/// No compression makes texels smaller than by this: a header that promises more is wrong.
constexpr uint64_t kMostCompressed = 2048;

using Layout = slvm::TiffLayout;

bool is_read(const Layout& l) {
  const bool numbers = l.is_float() || (l.kind == SAMPLEFORMAT_UINT && (l.bits == 8 || l.bits == 16));
  const bool plain = l.photometric == PHOTOMETRIC_MINISBLACK || l.photometric == PHOTOMETRIC_RGB;
  return numbers && plain && l.channels > 0 && l.width > 0 && l.height > 0 && l.width <= kLargestSide &&
         l.height <= kLargestSide;
}

bool alike(const Layout& a, const Layout& b) {
  return a.channels == b.channels && a.bits == b.bits && a.kind == b.kind && a.photometric == b.photometric &&
         a.planar == b.planar;
}

/// "" when there is none.
std::string text_field(TIFF* t, uint32_t tag) {
  const char* out = nullptr;
  return TIFFGetField(t, tag, &out) && out ? out : "";
}

/// One of Pixar's: 16 numbers, or none.
std::vector<float> matrix_field(TIFF* t, uint32_t tag) {
  const float* numbers = nullptr; // libtiff knows these tags to have 16
  if (!TIFFGetField(t, tag, &numbers) || !numbers) return {};
  return {numbers, numbers + 16};
}

class TiffTexture : public TextureReader {
public:
  explicit TiffTexture(std::unique_ptr<std::string> message, slvm::TiffFile file)
      : message_(std::move(message)), file_(std::move(file)) {}

  /// False: some other reader's.
  bool read_header(uint64_t file_size);
  std::string read(size_t level, std::span<std::byte> texels) override;

private:
  std::unique_ptr<std::string> message_; ///< libtiff's; must stay where it is
  slvm::TiffFile file_;
};

bool TiffTexture::read_header(uint64_t file_size) {
  TIFF* t = file_.get();
  const Layout first(t);
  if (!is_read(first) || first.bytes() / kMostCompressed > file_size) return false;
  header_.channels = first.channels;
  header_.type = first.is_float()  ? PixelType::kFloat
                 : first.bits == 8 ? PixelType::kByte
                                   : PixelType::kShort;
  header_.format = text_field(t, TIFFTAG_PIXAR_TEXTUREFORMAT);
  set_wraps(text_field(t, TIFFTAG_PIXAR_WRAPMODES), header_);
  header_.world_to_camera = matrix_field(t, TIFFTAG_PIXAR_MATRIX_WORLDTOCAMERA);
  header_.world_to_screen = matrix_field(t, TIFFTAG_PIXAR_MATRIX_WORLDTOSCREEN);
  uint16_t count = 0;
  const uint16_t* extra = nullptr;
  if (TIFFGetField(t, TIFFTAG_EXTRASAMPLES, &count, &extra) && count == 1)
    header_.straight_alpha = extra[0] == EXTRASAMPLE_UNASSALPHA && first.channels > 1;
  ImageSize size{static_cast<int>(first.width), static_cast<int>(first.height)};
  header_.levels.push_back(size);
  // Further pictures are levels as long as they are what levels would be.
  while (TIFFReadDirectory(t)) {
    const Layout next(t);
    size = {static_cast<int>(next.width), static_cast<int>(next.height)};
    if (!is_read(next) || !alike(next, first) || !halves(header_.levels.back(), size)) break;
    header_.levels.push_back(size);
  }
  message_->clear(); // what is wrong after the levels does not matter
  return true;
}

std::string TiffTexture::read(size_t level, std::span<std::byte> texels) {
  TIFF* t = file_.get();
  if (TIFFSetDirectory(t, static_cast<tdir_t>(level))) {
    const Layout layout(t);
    if (layout.bytes() == texels.size() && slvm::TiffPixels(t, layout).read(texels)) return {};
  }
  return message_->empty() ? "its texels cannot be read" : *message_;
}

} // namespace

std::unique_ptr<TextureReader> open_tiff_texture(const std::string& path) {
  auto message = std::make_unique<std::string>();
  slvm::TiffFile file = slvm::open_tiff(path, "r", *message);
  if (!file) return nullptr;
  auto reader = std::make_unique<TiffTexture>(std::move(message), std::move(file));
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || !reader->read_header(size)) return nullptr;
  return reader;
}

} // namespace render
