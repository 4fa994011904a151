// From composited samples to pixels.
#pragma once

#include "render/hider/image.h"
#include "render/hider/sample_pattern.h"
#include "render/state/options.h"

#include <span>
#include <vector>

namespace render {

/// What a sample comes to: the first channels of an image. z: infinite where nothing is.
struct SampleResult {
  float channels[Image::kAov] = {0, 0, 0, 0, 0, 0, 0, kInfinity};

  void set_colours(Color C, Color O) {
    for (int c = 0; c < 3; ++c) {
      channels[Image::kCi + c] = C[c];
      channels[Image::kOi + c] = O[c];
    }
    channels[Image::kAlpha] = (O.x + O.y + O.z) / 3;
  }
};

struct ReconstructionSettings {
  PixelFilter filter;
  DepthFilter depth_filter = DepthFilter::kMin;
  bool subpixel = false; ///< no filter: the image has a pixel for each sample
  std::vector<AovChannel> aovs;

  size_t aov_floats() const;
  /// Pixels around a bucket whose samples its filters reach.
  int xmargin() const;
  int ymargin() const;
};

/// Fills the image's pixels of `rect`. `pattern`, `results` and `aov` belong to the samples of `covered`.
void reconstruct(const ReconstructionSettings& settings, const SampleGridSize& size, PixelRect rect,
                 PixelRect covered, const SamplePattern& pattern, std::span<const SampleResult> results,
                 std::span<const float> aov, Image& image);

} // namespace render
