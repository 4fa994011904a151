// From composited samples to pixels.
#pragma once

#include "render/hider/image.h"
#include "render/hider/sample_columns.h"
#include "render/hider/sample_pattern.h"
#include "render/hider/window_weights.h"
#include "render/state/options.h"

#include <algorithm>
#include <span>
#include <vector>

namespace render {

struct ReconstructionSettings {
  PixelFilter filter;
  DepthFilter depth_filter = DepthFilter::kMin;
  bool subpixel = false; ///< no filter: the image has a pixel for each sample
  std::vector<AovChannel> aovs;
  Image::StandardChannels shown = Image::all();

  size_t aov_floats() const;
  /// The channels of the image that get depths.
  std::vector<size_t> depth_channels() const;
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
  /// For each channel of an image the plane of the samples' values, SamplePattern::kPadding longer than there
  /// are samples; several channels may share one. z: infinite where nothing is.
  std::span<const float* const> planes;
  std::span<const SampleSpan> filled; ///< for each row: outside there is nothing
};

/// Serves one bucket after another.
class Reconstructor {
public:
  Reconstructor(const ReconstructionSettings& settings, const SampleGridSize& size);
  /// Fills the image's pixels of the bucket.
  void run(const BucketSamples& samples, Image& image);

private:
  /// A plane that goes through a filter, and the channel of the image that gets it.
  struct Term {
    size_t plane, channel;
  };
  struct Plan {
    PixelFilter filter;
    WindowWeights weights;
    std::vector<Term> terms;
  };
  /// Pixels of a row that are in the same block.
  struct Run {
    int x0, x1, y;
    int block() const { return SampleColumns::block_of(x0); }
  };
  template <class F> static void for_runs(const PixelRect& rect, F&& f);
  void plan_aovs();
  void filter(Plan& plan, const BucketSamples& samples, Image& image);
  static void set(Image& image, const Run& run, size_t channel, const float* values);
  void set_depths(const BucketSamples& samples, Image& image);
  void find_depths(const float* z, float* out) const;
  void copy_samples(const BucketSamples& samples, Image& image) const;

  ReconstructionSettings settings_;
  SampleGridSize size_;
  SampleColumns columns_;
  std::vector<Plan> plans_;             ///< the first is that of the standard channels
  std::vector<size_t> depths_;          ///< the channels that get depths
  std::vector<const float*> sources_;   ///< the sorted planes of a plan, each once; filled up to kPlanes
  std::vector<const float*> at_;        ///< the same, at the place of a block
  std::vector<size_t> source_of_;       ///< for each term
  std::vector<std::ptrdiff_t> offsets_; ///< of the samples of a window, or of a pixel
  std::vector<float> means_;            ///< for each source, of a block
};

/// The image's pixels of `rect`, which are samples with "subpixel", where nothing is: zeros, as they are from
/// the start, and depths.
void clear(const ReconstructionSettings& settings, PixelRect rect, Image& image);

} // namespace render
