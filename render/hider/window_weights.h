// The weights that the filters of pixels give the samples around them, and means of samples by them: for
// blocks of pixels (sample_columns.h), one pixel a lane.
#pragma once

#include "render/hider/filter.h"
#include "render/hider/sample_columns.h"
#include "render/hider/sample_pattern.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace render {

/// The samples that a filter reaches, counted from the pixel's first; those before are negative. The pixel's
/// own samples are always among them.
struct FilterWindow {
  int i0, i1, j0, j1; ///< columns [i0, i1), rows [j0, j1)

  FilterWindow(const PixelFilter& filter, const SampleGridSize& size);
  size_t columns() const { return static_cast<size_t>(i1 - i0); }
  size_t rows() const { return static_cast<size_t>(j1 - j0); }
  size_t count() const { return columns() * rows(); }
};

class WindowWeights {
public:
  static constexpr size_t kBlock = SampleColumns::kBlock;
  /// Planes that are treated together.
  static constexpr size_t kPlanes = 4;

  WindowWeights(const PixelFilter& filter, const SampleGridSize& size);

  const FilterWindow& window() const { return window_; }
  /// For the block that starts at pixel x of the frame: of each sample of the window, row by row, the weights
  /// it has in the kBlock pixels; 0 beyond the filter's width. Their kBlock sums follow. Of a filter so
  /// narrow that it misses all samples of a pixel the plain mean of the pixel's own is left. Valid until the
  /// next call. Those of blocks in the same place of the pattern's tile are made once.
  const float* at(int x, int y, const SamplePattern& pattern);
  /// The weighted means of planes, a multiple of kPlanes, kBlock of each: the first pixel's samples are at
  /// planes[p] + offsets[k], k as in at(). The order of additions is always the same, for the weights, too:
  /// the mean of ones is 1.
  static void means(std::span<const float* const> planes, std::span<const std::ptrdiff_t> offsets,
                    const float* weights, float* out);

private:
  static constexpr size_t kSteps = 512;
  /// The factor of one axis of a separable filter, by distance, a last step for interpolation more: at most
  /// 1e-5 off for smooth filters.
  using AxisTable = std::array<float, kSteps + 2>;
  AxisTable axis_table(float width) const;
  void compute(int x, int y, const SamplePattern& pattern, float* out);
  void separable_weights(float* out) const;
  void add_sums(float* weights) const;

  PixelFilter filter_;
  SampleGridSize size_;
  FilterWindow window_;
  AxisTable x_{}, y_{};
  std::vector<float> at_x_, at_y_; ///< of the samples in the window, from the pixel's centre
  std::vector<float> weights_;     ///< of the blocks of a tile, or of one
  std::vector<uint8_t> known_;     ///< for each block of a tile; empty: the tile is too large to be kept
};

} // namespace render
