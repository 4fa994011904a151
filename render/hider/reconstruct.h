// From composited samples to pixels.
#pragma once

#include "render/hider/image.h"
#include "render/hider/sample_pattern.h"
#include "render/hider/window_weights.h"
#include "render/state/options.h"

#include <algorithm>
#include <span>
#include <vector>

namespace render {

/// What a sample comes to: the first channels of an image. z: infinite where nothing is.
struct SampleResult {
  float channels[Image::kAov] = {0, 0, 0, 0, 0, 0, 0, kInfinity};

  Color Ci() const { return {channels[Image::kCi], channels[Image::kCi + 1], channels[Image::kCi + 2]}; }
  Color Oi() const { return {channels[Image::kOi], channels[Image::kOi + 1], channels[Image::kOi + 2]}; }
  void set_colours(const Color& C, const Color& O) {
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

/// Samples of a row, by number: from `begin` to before `end`.
struct SampleSpan {
  size_t begin = 0, end = 0;
  bool overlaps(size_t from, size_t to) const { return from < end && begin < to; }
  /// Becomes the shortest span that holds both.
  void add(const SampleSpan& s) {
    if (s.begin == s.end) return;
    *this = begin == end ? s : SampleSpan{std::min(begin, s.begin), std::max(end, s.end)};
  }
};

/// The finished samples of a bucket.
struct BucketSamples {
  PixelRect rect;    ///< the bucket's pixels
  PixelRect covered; ///< and those whose samples these are
  const SamplePattern& pattern;
  std::span<const SampleResult> results;
  std::span<const float> aov;
  std::span<const SampleSpan> filled; ///< for each row: outside there is nothing
};

/// Serves one bucket after another.
class Reconstructor {
public:
  Reconstructor(const ReconstructionSettings& settings, const SampleGridSize& size);
  /// Fills the image's pixels of the bucket.
  void run(const BucketSamples& samples, Image& image);

private:
  /// Values that go through one filter: where they are among those of a sample, and where in a pixel.
  struct Term {
    bool variable; ///< of `aov`, else of `results`
    size_t first, stride;
    int count, to;
    const float* in(const BucketSamples& s) const {
      return (variable ? s.aov.data() : s.results[0].channels) + first;
    }
  };
  struct Plan {
    PixelFilter filter;
    WindowWeights weights;
    std::vector<Term> terms;
  };
  void plan_aovs();
  /// `standard`: the image's first channels, too. That of z is written over later.
  template <bool standard> void filter(Plan& plan, const BucketSamples& samples, Image& image) const;
  template <bool standard>
  void plain_mean(const Plan& plan, const BucketSamples& samples, int x, int y, float* pixel) const;
  void set_depths(const BucketSamples& samples, Image& image) const;
  float depth(const BucketSamples& samples, int x, int y) const;
  void copy_samples(const BucketSamples& samples, Image& image) const;
  /// The number of the sample of column i and row j of a pixel.
  size_t sample(const BucketSamples& samples, int x, int y, int i, int j) const {
    int row = (y - samples.covered.y0) * size_.ysamples + j,
        column = (x - samples.covered.x0) * size_.xsamples + i;
    return static_cast<size_t>(row) * static_cast<size_t>(samples.pattern.width()) +
           static_cast<size_t>(column);
  }

  ReconstructionSettings settings_;
  SampleGridSize size_;
  std::vector<Plan> plans_; ///< the first is that of the standard channels
};

/// The image's pixels of `rect`, which are samples with "subpixel", where nothing is.
void clear(const ReconstructionSettings& settings, PixelRect rect, Image& image);

} // namespace render
