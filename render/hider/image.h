// Finished pixels of one frame, as floats.
#pragma once

#include "render/state/camera.h"
#include "render/state/options.h"
#include "render/state/page_allocator.h"

#include <array>
#include <bitset>
#include <cassert>
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

/// Channels in order: Ci (3), Oi (3), alpha, z, then the AOVs.
struct Image {
  static constexpr int kCi = 0, kOi = 3, kAlpha = 6, kZ = 7, kAov = 8;
  /// z of a pixel nothing covers.
  static constexpr float kEmptyDepth = 1e30f;
  /// Of the standard channels, by number, those that somebody looks at. The others are not made.
  using StandardChannels = std::bitset<kAov>;
  static StandardChannels all() { return StandardChannels().set(); }

  PixelRect rect; ///< the crop window, in pixels of the frame
  int channels = kAov;
  /// A plane for each channel that is made, in order: rows of rect.
  std::vector<float, PageAllocator<float>> data;

  Image() = default;
  Image(PixelRect r, int aov_floats, const StandardChannels& made = all())
      : rect(r), channels(kAov + aov_floats), made_(made) {
    size_t planes = 0;
    for (size_t c = 0; c < kAov; ++c)
      if (made[c]) planes_[c] = planes++;
    aovs_ = planes;
    data.resize(plane_size() * (planes + static_cast<size_t>(aov_floats)));
  }

  bool has(int channel) const { return channel >= kAov || made_[static_cast<size_t>(channel)]; }
  /// The values of a channel from a pixel on, to the end of its row. Coordinates are those of the frame.
  float* row(int channel, int x, int y) { return data.data() + offset(channel, x, y); }
  const float* row(int channel, int x, int y) const { return data.data() + offset(channel, x, y); }
  float at(int channel, int x, int y) const { return *row(channel, x, y); }

private:
  size_t plane_size() const { return static_cast<size_t>(rect.width()) * static_cast<size_t>(rect.height()); }
  size_t offset(int channel, int x, int y) const {
    assert(has(channel));
    const auto c = static_cast<size_t>(channel);
    return (c < kAov ? planes_[c] : aovs_ + c - kAov) * plane_size() +
           static_cast<size_t>(y - rect.y0) * static_cast<size_t>(rect.width()) +
           static_cast<size_t>(x - rect.x0);
  }

  StandardChannels made_ = all();
  std::array<size_t, kAov> planes_{}; ///< of the standard channels
  size_t aovs_ = kAov;                ///< the plane of the first AOV
};

} // namespace render
