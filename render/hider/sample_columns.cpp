#include "render/hider/sample_columns.h"

#include <algorithm>

namespace render {

void SampleColumns::begin(PixelRect covered) {
  covered_ = covered;
  used_ = 0;
}

std::ptrdiff_t SampleColumns::offset(int i, int j) const {
  const int within = ((i % size_.xsamples) + size_.xsamples) % size_.xsamples;
  return j * row() + within * column() + (i - within) / size_.xsamples;
}

/// 0 columns: any number.
template <int kColumns> void SampleColumns::sort(const float* from, float* to) const {
  const int columns = kColumns > 0 ? kColumns : size_.xsamples, width = covered_.width();
  for (int j = 0; j < covered_.height() * size_.ysamples; ++j, from += width * columns)
    for (int i = 0; i < columns; ++i, to += column()) {
      float* out = to + kBlock;
      for (int x = 0; x < width; ++x)
        out[x] = from[x * columns + i];
    }
}

const float* SampleColumns::sorted(const float* plane) {
  const auto used = planes_.begin() + static_cast<std::ptrdiff_t>(used_);
  if (auto known = std::find_if(planes_.begin(), used, [&](const Sorted& s) { return s.from == plane; });
      known != used)
    return known->values.data();
  if (used_ == planes_.size()) planes_.emplace_back();
  Sorted& out = planes_[used_++];
  out.from = plane;
  out.values.resize(static_cast<size_t>(covered_.height() * size_.ysamples * row()));
  switch (size_.xsamples) {
  case 1: sort<1>(plane, out.values.data()); break;
  case 2: sort<2>(plane, out.values.data()); break;
  case 3: sort<3>(plane, out.values.data()); break;
  case 4: sort<4>(plane, out.values.data()); break;
  default: sort<0>(plane, out.values.data());
  }
  return out.values.data();
}

} // namespace render
