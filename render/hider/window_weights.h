// The weights that a pixel's filter gives the samples around the pixel, and means of samples by them.
#pragma once

#include "render/hider/filter.h"
#include "render/hider/sample_pattern.h"

#include <array>
#include <span>
#include <vector>

namespace render {

/// The samples that a filter reaches, counted from the pixel's first; those before are negative.
struct FilterWindow {
  int i0, i1, j0, j1; ///< columns [i0, i1), rows [j0, j1)

  FilterWindow(const PixelFilter& filter, const SampleGridSize& size);
  /// A row's weights come in whole vectors, filled up with 0.
  static constexpr size_t kLanes = 4;
  size_t columns() const { return static_cast<size_t>(i1 - i0); }
  size_t rows() const { return static_cast<size_t>(j1 - j0); }
  size_t stride() const { return (columns() + kLanes - 1) / kLanes * kLanes; }
};

class WindowWeights {
public:
  WindowWeights(const PixelFilter& filter, const SampleGridSize& size);

  const FilterWindow& window() const { return window_; }
  /// For a pixel of the frame, window().rows() times window().stride(); 0 beyond the filter's width; their
  /// sum follows. Valid until the next call. Those of pixels in the same place of the pattern's tile are made
  /// once.
  const float* at(int x, int y, const SamplePattern& pattern);
  /// The weighted means of planes of samples, of which the window's first has the number `first`, for the
  /// pixel of these weights. The order of additions is always the same, for the weights, too: the mean of
  /// ones is 1. The number of planes is a multiple of kLanes; those that fill it up may be any, once more.
  void means(std::span<const float* const> planes, size_t first, size_t width, const float* weights,
             float* out) const;
  bool missed_all(const float* weights) const { return weights[sum_at()] == 0; }

private:
  static constexpr size_t kSteps = 512;
  /// The factor of one axis of a separable filter, by distance, a last step for interpolation more: at most
  /// 1e-5 off for smooth filters.
  using AxisTable = std::array<float, kSteps + 2>;
  AxisTable axis_table(float width) const;
  size_t sum_at() const { return window_.rows() * window_.stride(); }
  void compute(int x, int y, const SamplePattern& pattern, float* out);
  void separable_weights(size_t count);

  PixelFilter filter_;
  SampleGridSize size_;
  FilterWindow window_;
  AxisTable x_{}, y_{};
  std::vector<float> at_x_, at_y_; ///< of the samples in the window, from the pixel's centre
  std::vector<float> scratch_;
  std::vector<float> weights_; ///< of the pixels of a tile, or of one
  std::vector<uint8_t> known_; ///< for each pixel of a tile; empty: the tile is too large to be kept
};

} // namespace render
