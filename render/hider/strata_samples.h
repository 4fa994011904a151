// The samples of a bucket stratum by stratum of time and lens, for vectors of them to lie side by side.
#pragma once

#include "render/hider/quad_hits.h"
#include "render/hider/sample_pattern.h"

#include <vector>

namespace render {

class StrataSamples {
public:
  /// Of all the samples that the pattern covers now; `of_all` has their places, times and lenses.
  void sort(const SamplePattern& pattern, const SampleField& of_all);
  /// Those of one stratum; limit and focus are left to the caller. Valid until sort().
  StratumField of(int stratum) const;

private:
  std::vector<uint32_t> numbers_;
  std::vector<float> x_, y_, time_, lens_x_, lens_y_; ///< stratum by stratum
  size_t pixels_ = 0, columns_ = 0;
};

} // namespace render
