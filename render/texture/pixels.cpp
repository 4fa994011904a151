#include "render/texture/pixels.h"

#include <cstring>
#include <limits>

namespace render {

void to_floats(const std::byte* stored, PixelType type, std::span<float> out) {
  with_type(type, [&](auto t) {
    using T = decltype(t);
    constexpr float kOne =
        std::is_same_v<T, float> ? 1.0f : static_cast<float>(std::numeric_limits<T>::max());
    for (size_t i = 0; i < out.size(); ++i) {
      T value;
      std::memcpy(&value, stored + i * sizeof(T), sizeof(T));
      out[i] = static_cast<float>(value) / kOne;
    }
  });
}

void from_floats(std::span<const float> numbers, PixelType type, std::byte* out) {
  with_type(type, [&](auto t) {
    using T = decltype(t);
    if constexpr (std::is_same_v<T, float>) {
      std::memcpy(out, numbers.data(), numbers.size_bytes());
    } else {
      constexpr auto kOne = static_cast<float>(std::numeric_limits<T>::max());
      for (size_t i = 0; i < numbers.size(); ++i) {
        const float x = numbers[i], above = x > 0 ? x : 0.0f; // 0: also what is no number
        const float bounded = above < 1 ? above : 1.0f;
        const auto value = static_cast<T>(static_cast<int>(bounded * kOne + 0.5f));
        std::memcpy(out + i * sizeof(T), &value, sizeof(T));
      }
    }
  });
}

} // namespace render
