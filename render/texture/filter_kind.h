// Filters by the names that scenes use, and their weights along one axis: of pixels, and between the levels
// of maps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace render {

enum class FilterKind : uint8_t {
  kBox,
  kTriangle,
  kGaussian,
  kCatmullRom,
  kBSpline,
  kSinc,
  kMitchell,
  kDisk,
  kSeparableCatmullRom,
  kBlackmanHarris,
  kLanczos,
  kBessel,
  kFunction, ///< PixelFilter::function
};
/// By the name a scene uses: "box", "catmull-rom"...
std::optional<FilterKind> find_filter(std::string_view name);
/// All names, for messages.
std::string filter_names();

/// Whether the weight is a product of one of x and one of y.
bool is_separable(FilterKind kind);
/// The factor of one axis.
float axis_weight(FilterKind kind, float x, float width);
/// The cubic of Catmull and Rom, at a distance.
float catmull_rom(float r);

} // namespace render
