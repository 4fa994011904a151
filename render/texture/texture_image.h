// A texture: an image and smaller ones of it, its levels, in memory as soon as somebody looks at them.
#pragma once

#include "render/texture/pixels.h"
#include "render/texture/shrink.h"
#include "render/texture/wrap.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace render {

/// What a file says before its texels are read.
struct TextureHeader {
  std::vector<ImageSize> levels; ///< those in the file: the largest first, each half of the one before
  int channels = 0;
  PixelType type = PixelType::kByte; ///< integers mean 0 to 1
  bool straight_alpha = false;       ///< colours are yet to be multiplied by the last channel
  TextureWrap swrap = TextureWrap::kBlack, twrap = TextureWrap::kBlack;
  std::string format;                                  ///< "Shadow", "LatLong Environment"...; often empty
  std::vector<float> world_to_camera, world_to_screen; ///< 16 numbers by rows, or empty
};
/// "periodic,clamp" as files say it; what is not known is black.
void set_wraps(const std::string& modes, TextureHeader& header);
/// Whether the next level after one of size `a` has size `b`.
bool halves(ImageSize a, ImageSize b);

/// A file of textures. Used by one thread at a time.
class TextureReader {
public:
  virtual ~TextureReader() = default;
  const TextureHeader& header() const { return header_; }
  /// Rows from the top, channels of a texel together. "" or what is wrong.
  virtual std::string read(size_t level, std::span<std::byte> texels) = 0;

protected:
  TextureHeader header_;
};

class TextureImage {
public:
  /// Bytes in memory are added to `memory` and taken off again in the end.
  TextureImage(std::unique_ptr<TextureReader> reader, std::atomic<long long>& memory);
  ~TextureImage();

  /// Behind the last texel there are so many more bytes that may be read: a word from each byte.
  static constexpr size_t kReadBeyond = 3;
  struct Level {
    int width = 0, height = 0;
    const std::byte* texels = nullptr; ///< as TextureReader::read gives them
  };
  const TextureHeader& header() const { return header_; }
  /// Down to a single texel; what the file does not have is made of the level before. Null texels: problem().
  Level level(size_t i) const;
  /// All of a level, integers as 0 to 1. False: problem().
  bool numbers(size_t i, FloatImage& out) const;
  size_t levels() const { return levels_.size(); }
  std::string problem() const;

private:
  struct Stored {
    ImageSize size;
    std::vector<std::byte> texels;
    std::atomic<const std::byte*> ready{nullptr};
  };
  void load(size_t i) const;

  TextureHeader header_;
  std::atomic<long long>& memory_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<TextureReader> reader_;
  mutable std::string problem_;
  mutable std::vector<Stored> levels_;
};

} // namespace render
