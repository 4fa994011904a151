// The colour spaces ctransform knows, by name.
#pragma once

#include "slvm/kernels/strings.h"

namespace slvm {

enum class ColorSpace : uint8_t { kRgb, kHsv, kHsl, kYiq, kXyz, kXyy };

/// By name in any case; rgb when unknown.
constexpr ColorSpace color_space(std::string_view name) {
  constexpr std::string_view kNames[] = {"rgb", "hsv", "hsl", "yiq", "xyz", "xyy"};
  for (size_t i = 0; i < std::size(kNames); ++i)
    if (same_letters(name, kNames[i])) return static_cast<ColorSpace>(i);
  return ColorSpace::kRgb;
}
inline ColorSpace color_space(const Operand& name, const KernelContext& context) {
  return color_space(string_operand(name, context));
}

} // namespace slvm
