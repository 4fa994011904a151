// The weights that a pixel's filter gives the samples around the pixel.
#pragma once

#include "render/hider/filter.h"
#include "render/hider/quad_hits.h"
#include "render/hider/sample_pattern.h"

#include <array>
#include <vector>

namespace render {

class WindowWeights {
public:
  explicit WindowWeights(const PixelFilter& filter);
  /// For a pixel with this centre, row after row; valid until the next call. 0 beyond the filter's width.
  const float* at(Vec2 centre, const SamplePattern& pattern, const SampleWindow& window);

private:
  static constexpr size_t kSteps = 512;
  /// The factor of one axis of a separable filter, by distance, a last step for interpolation more: at most
  /// 1e-5 off for smooth filters.
  using AxisTable = std::array<float, kSteps + 2>;
  AxisTable axis_table(float width) const;
  static void pack(const float* samples, size_t width, const SampleWindow& window, std::vector<float>& out);

  PixelFilter filter_;
  AxisTable x_{}, y_{};
  std::vector<float> at_x_, at_y_; ///< of the samples in the window
  std::vector<float> weights_;
};

} // namespace render
