// A texture: an image and smaller ones of it, its levels, in memory as soon as somebody looks at them.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace render {

enum class TexelType : uint8_t { kByte, kShort, kFloat };
constexpr size_t texel_bytes(TexelType type) {
  return type == TexelType::kByte ? 1 : type == TexelType::kShort ? 2 : 4;
}

/// What is beyond the sides of a texture: nothing, the image again and again, or its outermost texels.
enum class TextureWrap : uint8_t { kBlack, kPeriodic, kClamp };

/// What a file says before its texels are read.
struct TextureHeader {
  struct Size {
    int width = 0, height = 0;
    bool operator==(const Size&) const = default;
  };
  std::vector<Size> levels; ///< those in the file: the largest first, each half of the one before
  int channels = 0;
  TexelType type = TexelType::kByte; ///< integers mean 0 to 1
  bool straight_alpha = false;       ///< colours are yet to be multiplied by the last channel
  TextureWrap swrap = TextureWrap::kBlack, twrap = TextureWrap::kBlack;
  std::string format;                                  ///< "Shadow", "LatLong Environment"...; often empty
  std::vector<float> world_to_camera, world_to_screen; ///< 16 numbers by rows, or empty
};
/// "periodic,clamp" as files say it; what is not known is black.
void set_wraps(const std::string& modes, TextureHeader& header);
/// Whether the next level after one of size `a` has size `b`.
bool halves(TextureHeader::Size a, TextureHeader::Size b);

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

  struct Level {
    int width = 0, height = 0;
    const std::byte* texels = nullptr; ///< as TextureReader::read gives them
  };
  const TextureHeader& header() const { return header_; }
  /// Down to a single texel; what the file does not have is made of the level before. Null texels: problem().
  Level level(size_t i) const;
  size_t levels() const { return levels_.size(); }
  std::string problem() const;

private:
  struct Stored {
    TextureHeader::Size size;
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
