// What is beyond the sides of a texture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace render {

/// Nothing, the image again and again, or its outermost texels.
enum class TextureWrap : uint8_t { kBlack, kPeriodic, kClamp };

/// By its name in scenes and files: "black", "periodic", "clamp".
inline std::optional<TextureWrap> find_wrap(std::string_view name) {
  if (name == "black") return TextureWrap::kBlack;
  if (name == "periodic") return TextureWrap::kPeriodic;
  if (name == "clamp") return TextureWrap::kClamp;
  return {};
}
inline std::string name_of(TextureWrap wrap) {
  return wrap == TextureWrap::kPeriodic ? "periodic" : wrap == TextureWrap::kClamp ? "clamp" : "black";
}

/// The place of a texel within the image, or -1 for nothing.
inline int wrapped(int i, int size, TextureWrap wrap) {
  if (i >= 0 && i < size) return i;
  switch (wrap) {
  case TextureWrap::kPeriodic: i %= size; return i < 0 ? i + size : i;
  case TextureWrap::kClamp: return i < 0 ? 0 : size - 1;
  case TextureWrap::kBlack: return -1;
  }
  return -1;
}

} // namespace render
