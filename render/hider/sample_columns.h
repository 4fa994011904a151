// The samples of a bucket sorted by their places in pixels, so that what lies side by side belongs to
// neighbouring pixels: filters treat whole vectors of these.
#pragma once

#include "render/hider/sample_pattern.h"
#include "render/state/math.h"

#include <cstddef>
#include <vector>

namespace render {

/// Serves one bucket after another. In sorted planes each row of samples is split into one row for each
/// column of the pixels' samples; kBlock numbers of any value go before and after each.
class SampleColumns {
public:
  /// Pixels in a row that are treated together. Blocks of them start at multiples of it in the frame.
  static constexpr int kBlock = 16;
  static constexpr int block_of(int x) { return x & -kBlock; }

  explicit SampleColumns(const SampleGridSize& size) : size_(size) {}
  /// Goes on with the samples of these pixels; what was sorted is forgotten.
  void begin(PixelRect covered);
  /// A plane of the samples in rows, sorted at the first call. Valid until begin().
  const float* sorted(const float* plane);

  /// Where in a sorted plane the first sample of a pixel of the frame is, and, counted from there, the one i
  /// columns and j rows beyond it, in this pixel or another; before it, if they are negative.
  std::ptrdiff_t place(int x, int y) const {
    return static_cast<std::ptrdiff_t>(y - covered_.y0) * size_.ysamples * row() + kBlock + x - covered_.x0;
  }
  std::ptrdiff_t offset(int i, int j) const;

private:
  /// From one row of samples to the next.
  std::ptrdiff_t row() const { return static_cast<std::ptrdiff_t>(size_.xsamples) * column(); }
  /// From one column of the pixels to the next.
  std::ptrdiff_t column() const { return covered_.width() + 2 * kBlock; }
  template <int kColumns> void sort(const float* from, float* to) const;

  struct Sorted {
    const float* from;
    std::vector<float> values;
  };

  SampleGridSize size_;
  PixelRect covered_{};
  std::vector<Sorted> planes_; ///< of which the first used_ are this bucket's
  size_t used_ = 0;
};

} // namespace render
