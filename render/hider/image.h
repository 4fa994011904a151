// Finished pixels of one frame, as floats.
#pragma once

#include "render/state/camera.h"
#include "render/state/options.h"
#include "render/state/page_allocator.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace render {

/// (gain c)^(1/gamma), negative lobes of the filter kept (RISpec 3.2, 4.2.2).
inline float exposed(float c, float gain, float gamma) {
  float v = gain * c;
  return gamma == 1 ? v : std::copysign(std::pow(std::abs(v), 1 / gamma), v);
}

/// What a Display asks for besides the standard channels: a shader variable, seen on the nearest surface, or
/// the composited picture once more, with a filter or an exposure of its own.
struct AovChannel {
  enum class Source : uint8_t { kVariable, kColor, kOpacity, kAlpha, kDepth };

  std::string name;
  int components = 3;
  int first = 0; ///< its first float among the AOV floats of a pixel
  Source source = Source::kVariable;
  std::optional<PixelFilter> filter; ///< none: the frame's
  /// Gain and gamma, of colours and variables. Opacity and alpha have it, too, to tell to which picture they
  /// belong.
  std::array<float, 2> exposure{1, 1};
};

/// Channels of a pixel in order: Ci (3), Oi (3), alpha, z, then the AOVs.
struct Image {
  static constexpr int kCi = 0, kOi = 3, kAlpha = 6, kZ = 7, kAov = 8;
  /// z of a pixel nothing covers.
  static constexpr float kEmptyDepth = 1e30f;

  PixelRect rect; ///< the crop window, in pixels of the frame
  int channels = kAov;
  std::vector<float, PageAllocator<float>> data;

  Image() = default;
  Image(PixelRect r, int aov_floats)
      : rect(r), channels(kAov + aov_floats),
        data(static_cast<size_t>(r.width()) * static_cast<size_t>(r.height()) *
             static_cast<size_t>(channels)) {}
  /// Coordinates are those of the frame.
  float* pixel(int x, int y) { return data.data() + offset(x, y); }
  const float* pixel(int x, int y) const { return data.data() + offset(x, y); }

private:
  size_t offset(int x, int y) const {
    return (static_cast<size_t>(y - rect.y0) * static_cast<size_t>(rect.width()) +
            static_cast<size_t>(x - rect.x0)) *
           static_cast<size_t>(channels);
  }
};

} // namespace render
