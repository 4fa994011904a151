#include "render/hider/strata_samples.h"

#include <algorithm>

namespace render {

void StrataSamples::sort(const SamplePattern& pattern, const SampleField& of_all) {
  const size_t count = pattern.count(), size = count + SampleField::kPadding;
  pixels_ = count / static_cast<size_t>(pattern.strata());
  columns_ = static_cast<size_t>(pattern.columns());
  // The strata's numbers follow one another.
  numbers_.assign(pattern.of_stratum(0), pattern.of_stratum(0) + count);
  numbers_.resize(size);
  auto take = [&](const float* from, std::vector<float>& to) {
    to.resize(from ? size : 0);
    for (size_t k = 0; k < count && from; ++k)
      to[k] = from[numbers_[k]];
  };
  take(of_all.x, x_);
  take(of_all.y, y_);
  take(of_all.time, time_);
  take(of_all.lens_x, lens_x_);
  take(of_all.lens_y, lens_y_);
}

StratumField StrataSamples::of(int stratum) const {
  const size_t first = static_cast<size_t>(stratum) * pixels_;
  auto from = [&](const std::vector<float>& plane) { return plane.empty() ? nullptr : plane.data() + first; };
  StratumField out;
  out.x = from(x_);
  out.y = from(y_);
  out.width = columns_;
  out.time = from(time_);
  out.lens_x = from(lens_x_);
  out.lens_y = from(lens_y_);
  out.numbers = numbers_.data() + first;
  return out;
}

} // namespace render
