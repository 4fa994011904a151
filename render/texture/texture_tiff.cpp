#include "render/texture/texture_tiff.h"

#include "render/texture/tiff_fields.h"
#include "slvm/support/tiff_open.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace render {

namespace {

constexpr uint32_t kLargestSide = 1 << 16;
/// No compression makes texels smaller than by this: a header that promises more is wrong.
constexpr uint64_t kMostCompressed = 2048;

/// What the directory the file is at says of texels.
struct Layout {
  uint32_t width = 0, height = 0;
  uint16_t channels = 1, depth = 1, kind = SAMPLEFORMAT_UINT, photometric = PHOTOMETRIC_MINISBLACK,
           planar = PLANARCONFIG_CONTIG;

  explicit Layout(TIFF* t) {
    TIFFGetField(t, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(t, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetFieldDefaulted(t, TIFFTAG_SAMPLESPERPIXEL, &channels);
    TIFFGetFieldDefaulted(t, TIFFTAG_BITSPERSAMPLE, &depth);
    TIFFGetFieldDefaulted(t, TIFFTAG_SAMPLEFORMAT, &kind);
    TIFFGetField(t, TIFFTAG_PHOTOMETRIC, &photometric);
    TIFFGetFieldDefaulted(t, TIFFTAG_PLANARCONFIG, &planar);
  }
  bool is_float() const { return kind == SAMPLEFORMAT_IEEEFP && depth == 32; }
  bool is_read() const {
    const bool numbers = is_float() || (kind == SAMPLEFORMAT_UINT && (depth == 8 || depth == 16));
    const bool plain = photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_RGB;
    return numbers && plain && channels > 0 && width > 0 && height > 0 && width <= kLargestSide &&
           height <= kLargestSide;
  }
  uint64_t bytes() const { return uint64_t{width} * height * channels * (depth / 8); }
  TexelType type() const {
    return is_float() ? TexelType::kFloat : depth == 8 ? TexelType::kByte : TexelType::kShort;
  }
  bool operator==(const Layout& o) const {
    return channels == o.channels && depth == o.depth && kind == o.kind && photometric == o.photometric &&
           planar == o.planar;
  }
};

class TiffTexture : public TextureReader {
public:
  explicit TiffTexture(std::unique_ptr<std::string> message, slvm::TiffFile file)
      : message_(std::move(message)), file_(std::move(file)) {}

  /// False: some other reader's.
  bool read_header(uint64_t file_size);
  std::string read(size_t level, std::span<std::byte> texels) override;

private:
  /// Where the texels of one level go.
  struct Target {
    std::span<std::byte> texels;
    size_t width, height, texel; ///< texel: bytes of all its channels
  };
  bool read_tiles(const Target& to, uint16_t plane, size_t offset, size_t bytes);
  bool read_rows(const Target& to, uint16_t plane, size_t offset, size_t bytes);

  std::unique_ptr<std::string> message_; ///< libtiff's; must stay where it is
  slvm::TiffFile file_;
};

bool TiffTexture::read_header(uint64_t file_size) {
  TIFF* t = file_.get();
  const Layout first(t);
  if (!first.is_read() || first.bytes() / kMostCompressed > file_size) return false;
  header_.channels = first.channels;
  header_.type = first.type();
  header_.format = text_field(t, TIFFTAG_PIXAR_TEXTUREFORMAT);
  set_wraps(text_field(t, TIFFTAG_PIXAR_WRAPMODES), header_);
  header_.world_to_camera = matrix_field(t, TIFFTAG_PIXAR_MATRIX_WORLDTOCAMERA);
  header_.world_to_screen = matrix_field(t, TIFFTAG_PIXAR_MATRIX_WORLDTOSCREEN);
  uint16_t count = 0;
  const uint16_t* extra = nullptr;
  if (TIFFGetField(t, TIFFTAG_EXTRASAMPLES, &count, &extra) && count == 1)
    header_.straight_alpha = extra[0] == EXTRASAMPLE_UNASSALPHA && first.channels > 1;
  TextureHeader::Size size{static_cast<int>(first.width), static_cast<int>(first.height)};
  header_.levels.push_back(size);
  // Further pictures are levels as long as they are what levels would be.
  while (TIFFReadDirectory(t)) {
    const Layout next(t);
    size = {static_cast<int>(next.width), static_cast<int>(next.height)};
    if (!next.is_read() || !(next == first) || !halves(header_.levels.back(), size)) break;
    header_.levels.push_back(size);
  }
  message_->clear(); // what is wrong after the levels does not matter
  return true;
}

std::string TiffTexture::read(size_t level, std::span<std::byte> texels) {
  TIFF* t = file_.get();
  auto failed = [&] { return message_->empty() ? std::string("its texels cannot be read") : *message_; };
  if (!TIFFSetDirectory(t, static_cast<tdir_t>(level))) return failed();
  const Layout layout(t);
  const size_t sample = layout.depth / 8, channels = layout.channels;
  const Target to{texels, layout.width, layout.height, sample * channels};
  const bool apart = layout.planar == PLANARCONFIG_SEPARATE && channels > 1;
  for (uint16_t plane = 0; plane < (apart ? channels : 1); ++plane) {
    const size_t offset = plane * sample, bytes = apart ? sample : to.texel;
    if (!(TIFFIsTiled(t) ? read_tiles(to, plane, offset, bytes) : read_rows(to, plane, offset, bytes)))
      return failed();
  }
  return {};
}

/// Copies `count` pieces of `bytes`, one behind the other, to texels one `step` from the next.
void spread(const std::byte* from, size_t count, size_t bytes, std::byte* to, size_t step) {
  if (bytes == step) {
    std::memcpy(to, from, count * bytes);
    return;
  }
  for (size_t i = 0; i < count; ++i, from += bytes, to += step)
    std::memcpy(to, from, bytes);
}

/// One plane: pieces of `bytes`, `offset` into each texel.
bool TiffTexture::read_rows(const Target& to, uint16_t plane, size_t offset, size_t bytes) {
  TIFF* t = file_.get();
  std::vector<std::byte> row(static_cast<size_t>(TIFFScanlineSize(t)));
  if (row.size() < to.width * bytes) return false;
  for (size_t y = 0; y < to.height; ++y) {
    if (TIFFReadScanline(t, row.data(), static_cast<uint32_t>(y), plane) < 0) return false;
    spread(row.data(), to.width, bytes, to.texels.data() + y * to.width * to.texel + offset, to.texel);
  }
  return true;
}

bool TiffTexture::read_tiles(const Target& to, uint16_t plane, size_t offset, size_t bytes) {
  TIFF* t = file_.get();
  uint32_t tile_width = 0, tile_height = 0;
  TIFFGetField(t, TIFFTAG_TILEWIDTH, &tile_width);
  TIFFGetField(t, TIFFTAG_TILELENGTH, &tile_height);
  std::vector<std::byte> tile(static_cast<size_t>(TIFFTileSize(t)));
  const size_t width = tile_width, height = tile_height;
  if (width == 0 || height == 0 || tile.size() < width * height * bytes) return false;
  for (size_t y = 0; y < to.height; y += height)
    for (size_t x = 0; x < to.width; x += width) {
      if (TIFFReadTile(t, tile.data(), static_cast<uint32_t>(x), static_cast<uint32_t>(y), 0, plane) < 0)
        return false;
      for (size_t row = 0; row < std::min(height, to.height - y); ++row)
        spread(tile.data() + row * width * bytes, std::min(width, to.width - x), bytes,
               to.texels.data() + ((y + row) * to.width + x) * to.texel + offset, to.texel);
    }
  return true;
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
