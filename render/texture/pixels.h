// Pixels in memory: the types that files store, and images of floats, which maps are made with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace render {

/// Integers mean 0 to 1.
enum class PixelType : uint8_t { kByte, kShort, kFloat };
/// Of one channel.
constexpr size_t bytes_of(PixelType type) {
  return type == PixelType::kByte ? 1 : type == PixelType::kShort ? 2 : 4;
}

/// Calls f with a value of the type.
template <class F> void with_type(PixelType type, F&& f) {
  switch (type) {
  case PixelType::kByte: f(uint8_t{}); break;
  case PixelType::kShort: f(uint16_t{}); break;
  case PixelType::kFloat: f(float{}); break;
  }
}

/// `stored`: at least as many numbers of the type as there are floats.
void to_floats(const std::byte* stored, PixelType type, std::span<float> out);
/// Rounded to the nearest; beyond what the type holds, that.
void from_floats(std::span<const float> numbers, PixelType type, std::byte* out);

struct FloatImage {
  int width = 0, height = 0;
  size_t channels = 0;
  std::vector<float> numbers; ///< row by row from the top, channels of a pixel side by side

  FloatImage() = default;
  FloatImage(int columns, int rows, size_t channel_count)
      : width(columns), height(rows), channels(channel_count),
        numbers(static_cast<size_t>(columns) * static_cast<size_t>(rows) * channel_count) {}
  size_t row_size() const { return static_cast<size_t>(width) * channels; }
  float* row(int y) { return numbers.data() + static_cast<size_t>(y) * row_size(); }
  const float* row(int y) const { return numbers.data() + static_cast<size_t>(y) * row_size(); }
};

} // namespace render
