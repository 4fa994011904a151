// Separable filters, as many samples at a time as the processor has lanes: gaussians by their formula, the
// others from tables.
#include "render/hider/window_weights.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/hider/window_weights.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/targets.h"

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

namespace render {
#ifndef RENDER_HIDER_AXIS_
#define RENDER_HIDER_AXIS_
/// One axis: what turns distances from the pixel's centre into places in the table of weights or, of
/// gaussians, into parts of the filter's half width.
struct Axis {
  const float* table;
  float scale, last; ///< last: place beyond which weights are 0
};
#endif
} // namespace render

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<float> kWide;
using V = hn::Vec<decltype(kWide)>;

HWY_INLINE V place_on(const Axis& axis, V at) {
  return hn::Mul(hn::Abs(at), hn::Set(kWide, axis.scale));
}

HWY_INLINE V weight_on(const Axis& axis, V at) {
  constexpr hn::RebindToSigned<decltype(kWide)> kIndices;
  V place = place_on(axis, at), last = hn::Set(kWide, axis.last);
  auto i = hn::ConvertTo(kIndices, hn::Min(place, last));
  V below = hn::GatherIndex(kWide, axis.table, i), above = hn::GatherIndex(kWide, axis.table + 1, i);
  V weight = hn::Add(below, hn::Mul(hn::Sub(above, below), hn::Sub(place, hn::ConvertTo(kWide, i))));
  return hn::IfThenElseZero(hn::Le(place, last), weight);
}

/// For `count` samples. Reads and writes up to a vector beyond the last.
void separable(const Axis& x, const Axis& y, const float* at_x, const float* at_y, size_t count, float* out) {
  for (size_t k = 0; k < count; k += hn::Lanes(kWide))
    hn::StoreU(hn::Mul(weight_on(x, hn::LoadU(kWide, at_x + k)), weight_on(y, hn::LoadU(kWide, at_y + k))),
               kWide, out + k);
}

/// The same of e^(-2 (x^2 + y^2)).
void gaussian(const Axis& x, const Axis& y, const float* at_x, const float* at_y, size_t count, float* out) {
  const V one = hn::Set(kWide, 1.0f), power = hn::Set(kWide, -2.0f);
  for (size_t k = 0; k < count; k += hn::Lanes(kWide)) {
    V px = place_on(x, hn::LoadU(kWide, at_x + k)), py = place_on(y, hn::LoadU(kWide, at_y + k));
    V weight = hn::Exp(kWide, hn::Mul(power, hn::Add(hn::Mul(px, px), hn::Mul(py, py))));
    hn::StoreU(hn::IfThenElseZero(hn::Le(hn::Max(px, py), one), weight), kWide, out + k);
  }
}

constexpr hn::CappedTag<float, FilterWindow::kLanes> kFour;
using V4 = hn::Vec<decltype(kFour)>;

/// The sums of the lanes of four vectors.
HWY_INLINE V4 sums_of(const V4 (&v)[4]) {
#if HWY_TARGET == HWY_SCALAR
  return v[0];
#else
  auto pairs = [](V4 a, V4 b) HWY_ATTR {
    return hn::Add(hn::InterleaveLower(kFour, a, b), hn::InterleaveUpper(kFour, a, b));
  };
  const V4 ab = pairs(v[0], v[1]), cd = pairs(v[2], v[3]);
  return hn::Add(hn::ConcatLowerLower(kFour, cd, ab), hn::ConcatUpperUpper(kFour, cd, ab));
#endif
}

/// Weighted sums of four planes, or of as many as a vector has lanes.
void weigh(const float* const* planes, size_t first, size_t width, const FilterWindow& window,
           const float* weights, float* out) {
  constexpr size_t kStep = hn::MaxLanes(kFour);
  const size_t columns = window.columns(), whole = columns / kStep * kStep, left = columns - whole;
  const auto rest = hn::FirstN(kFour, left);
  V4 sums[4] = {hn::Zero(kFour), hn::Zero(kFour), hn::Zero(kFour), hn::Zero(kFour)};
  for (size_t j = 0; j < window.rows(); ++j, first += width, weights += window.stride()) {
    for (size_t i = 0; i < whole; i += kStep) {
      const V4 w = hn::LoadU(kFour, weights + i);
      for (size_t p = 0; p < kStep; ++p)
        sums[p] = hn::Add(sums[p], hn::Mul(w, hn::LoadU(kFour, planes[p] + first + i)));
    }
    if (left == 0) continue;
    // Beyond a row's end there may be anything.
    const V4 w = hn::LoadU(kFour, weights + whole);
    for (size_t p = 0; p < kStep; ++p)
      sums[p] =
          hn::Add(sums[p], hn::Mul(w, hn::IfThenElseZero(rest, hn::LoadU(kFour, planes[p] + first + whole))));
  }
  hn::StoreU(sums_of(sums), kFour, out);
}

/// The same of all planes, divided by the sum of the weights.
void mean(std::span<const float* const> planes, size_t first, size_t width, const FilterWindow& window,
          const float* weights, float total, float* out) {
  const V4 divisor = hn::Set(kFour, total);
  for (size_t p = 0; p < planes.size(); p += hn::MaxLanes(kFour)) {
    weigh(planes.data() + p, first, width, window, weights, out + p);
    hn::StoreU(hn::Div(hn::LoadU(kFour, out + p), divisor), kFour, out + p);
  }
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <cmath>

namespace render {
const auto kSeparable = SL_BEST(separable);
const auto kGaussian = SL_BEST(gaussian);
const auto kWeigh = SL_BEST(weigh);
const auto kMean = SL_BEST(mean);

FilterWindow::FilterWindow(const PixelFilter& f, const SampleGridSize& size) {
  // The cells that have points less than half a width from the pixel's centre.
  auto first = [](float width, int density) {
    return static_cast<int>(std::floor((0.5f - width / 2) * static_cast<float>(density)));
  };
  auto end = [](float width, int density) {
    return static_cast<int>(std::ceil((0.5f + width / 2) * static_cast<float>(density)));
  };
  i0 = first(f.xwidth, size.xsamples);
  i1 = end(f.xwidth, size.xsamples);
  j0 = first(f.ywidth, size.ysamples);
  j1 = end(f.ywidth, size.ysamples);
}

WindowWeights::WindowWeights(const PixelFilter& filter, const SampleGridSize& size)
    : filter_(filter), size_(size), window_(filter, size) {
  if (!is_separable(filter.kind) || filter.kind == FilterKind::kGaussian) return;
  x_ = axis_table(filter.xwidth);
  y_ = axis_table(filter.ywidth);
}

WindowWeights::AxisTable WindowWeights::axis_table(float width) const {
  AxisTable out{};
  for (size_t i = 0; i <= kSteps; ++i)
    out[i] = axis_weight(filter_.kind, width / 2 * static_cast<float>(i) / kSteps, width);
  return out;
}

const float* WindowWeights::at(int x, int y, const SamplePattern& pattern) {
  constexpr size_t kMost = 1 << 22; // floats: filters of up to 7 by 7 pixels, whatever the number of samples
  const auto period = static_cast<size_t>(pattern.period());
  const size_t count = sum_at() + 1;
  const bool kept = period * period * count <= kMost;
  if (weights_.empty()) {
    weights_.resize((kept ? period * period : 1) * count + SamplePattern::kPadding);
    known_.assign(kept ? period * period : 0, 0);
  }
  if (!kept) {
    compute(x, y, pattern, weights_.data());
    return weights_.data();
  }
  const int mask = pattern.period() - 1;
  const size_t pixel = static_cast<size_t>(y & mask) * period + static_cast<size_t>(x & mask);
  float* out = weights_.data() + pixel * count;
  if (!known_[pixel]) {
    compute(x, y, pattern, out);
    known_[pixel] = 1;
  }
  return out;
}

void WindowWeights::compute(int x, int y, const SamplePattern& pattern, float* out) {
  at_x_.clear();
  at_y_.clear();
  const auto stride = static_cast<int>(window_.stride());
  for (int j = window_.j0; j < window_.j1; ++j)
    for (int i = window_.i0; i < window_.i0 + stride; ++i) {
      // What fills up a row is beyond all filters.
      Vec2 within = i < window_.i1 ? pattern.jitter(x * size_.xsamples + i, y * size_.ysamples + j)
                                   : Vec2(2 * filter_.xwidth * static_cast<float>(size_.xsamples), 0);
      at_x_.push_back((static_cast<float>(i) + within.x) / static_cast<float>(size_.xsamples) - 0.5f);
      at_y_.push_back((static_cast<float>(j) + within.y) / static_cast<float>(size_.ysamples) - 0.5f);
    }
  const size_t count = at_x_.size();
  // What goes on to the end of a vector needs room.
  at_x_.resize(count + SamplePattern::kPadding);
  at_y_.resize(count + SamplePattern::kPadding);
  scratch_.resize(count + SamplePattern::kPadding);
  if (is_separable(filter_.kind)) {
    separable_weights(count);
  } else {
    for (size_t k = 0; k < count; ++k)
      scratch_[k] = filter_weight(filter_, at_x_[k], at_y_[k]);
  }
  std::copy_n(scratch_.begin(), count, out);
  at_x_.assign(count + SamplePattern::kPadding, 1.0f);
  const float* ones[FilterWindow::kLanes] = {at_x_.data(), at_x_.data(), at_x_.data(), at_x_.data()};
  float sums[FilterWindow::kLanes];
  kWeigh(ones, 0, window_.stride(), window_, out, sums);
  out[count] = sums[0];
}

void WindowWeights::separable_weights(size_t count) {
  const bool gauss = filter_.kind == FilterKind::kGaussian;
  const float last = gauss ? 1 : kSteps;
  const Axis across{x_.data(), 2 * last / filter_.xwidth, last},
      down{y_.data(), 2 * last / filter_.ywidth, last};
  (gauss ? kGaussian : kSeparable)(across, down, at_x_.data(), at_y_.data(), count, scratch_.data());
}

void WindowWeights::means(std::span<const float* const> planes, size_t first, size_t width,
                          const float* weights, float* out) const {
  kMean(planes, first, width, window_, weights, weights[sum_at()], out);
}

} // namespace render
#endif
