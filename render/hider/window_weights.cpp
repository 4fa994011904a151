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

constexpr hn::CappedTag<float, WindowWeights::kBlock> kWide;
constexpr size_t kLanes = hn::MaxLanes(kWide);
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

/// For `count` samples, whole blocks.
void separable(const Axis& x, const Axis& y, const float* at_x, const float* at_y, size_t count, float* out) {
  for (size_t k = 0; k < count; k += kLanes)
    hn::StoreU(hn::Mul(weight_on(x, hn::LoadU(kWide, at_x + k)), weight_on(y, hn::LoadU(kWide, at_y + k))),
               kWide, out + k);
}

/// The same of e^(-2 (x^2 + y^2)).
void gaussian(const Axis& x, const Axis& y, const float* at_x, const float* at_y, size_t count, float* out) {
  const V one = hn::Set(kWide, 1.0f), power = hn::Set(kWide, -2.0f);
  for (size_t k = 0; k < count; k += kLanes) {
    V px = place_on(x, hn::LoadU(kWide, at_x + k)), py = place_on(y, hn::LoadU(kWide, at_y + k));
    V weight = hn::Exp(kWide, hn::Mul(power, hn::Add(hn::Mul(px, px), hn::Mul(py, py))));
    hn::StoreU(hn::IfThenElseZero(hn::Le(hn::Max(px, py), one), weight), kWide, out + k);
  }
}

void mean(std::span<const float* const> planes, std::span<const std::ptrdiff_t> offsets, const float* weights,
          float* out) {
  constexpr size_t kPlanes = WindowWeights::kPlanes, kBlock = WindowWeights::kBlock;
  const float* totals = weights + kBlock * offsets.size();
  for (size_t p = 0; p < planes.size(); p += kPlanes, out += kPlanes * kBlock)
    for (size_t lane = 0; lane < kBlock; lane += kLanes) {
      V sums[kPlanes] = {hn::Zero(kWide), hn::Zero(kWide), hn::Zero(kWide), hn::Zero(kWide)};
      const float* weight = weights + lane;
      for (std::ptrdiff_t offset : offsets) {
        const V w = hn::LoadU(kWide, weight);
        for (size_t q = 0; q < kPlanes; ++q)
          sums[q] = hn::Add(sums[q], hn::Mul(w, hn::LoadU(kWide, planes[p + q] + offset + lane)));
        weight += kBlock;
      }
      for (size_t q = 0; q < kPlanes; ++q)
        hn::StoreU(hn::Div(sums[q], hn::LoadU(kWide, totals + lane)), kWide, out + q * kBlock + lane);
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
const auto kMean = SL_BEST(mean);

FilterWindow::FilterWindow(const PixelFilter& f, const SampleGridSize& size) {
  // The cells that have points less than half a width from the pixel's centre.
  auto first = [](float width, int density) {
    return std::min(0, static_cast<int>(std::floor((0.5f - width / 2) * static_cast<float>(density))));
  };
  auto end = [](float width, int density) {
    return std::max(density, static_cast<int>(std::ceil((0.5f + width / 2) * static_cast<float>(density))));
  };
  i0 = first(f.xwidth, size.xsamples);
  i1 = end(f.xwidth, size.xsamples);
  j0 = first(f.ywidth, size.ysamples);
  j1 = end(f.ywidth, size.ysamples);
}

WindowWeights::WindowWeights(const PixelFilter& filter, const SampleGridSize& size)
    : filter_(filter), size_(size), window_(filter, size), at_x_(kBlock * window_.count()),
      at_y_(at_x_.size()) {
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
  const auto period = static_cast<size_t>(pattern.period()), row = std::max<size_t>(period / kBlock, 1);
  const size_t blocks = row * period, floats = kBlock * (window_.count() + 1);
  const bool kept = blocks * floats <= kMost;
  if (weights_.empty()) {
    weights_.resize((kept ? blocks : 1) * floats);
    known_.assign(kept ? blocks : 0, 0);
  }
  if (!kept) {
    compute(x, y, pattern, weights_.data());
    return weights_.data();
  }
  const int mask = pattern.period() - 1;
  const size_t block = static_cast<size_t>(y & mask) * row + static_cast<size_t>(x & mask) / kBlock;
  float* out = weights_.data() + block * floats;
  if (!known_[block]) {
    compute(x, y, pattern, out);
    known_[block] = 1;
  }
  return out;
}

void WindowWeights::compute(int x, int y, const SamplePattern& pattern, float* out) {
  const auto xs = static_cast<float>(size_.xsamples), ys = static_cast<float>(size_.ysamples);
  float *at_x = at_x_.data(), *at_y = at_y_.data();
  for (int j = window_.j0; j < window_.j1; ++j)
    for (int i = window_.i0; i < window_.i1; ++i, at_x += kBlock, at_y += kBlock) {
      pattern.jitter({at_x, kBlock}, {at_y, kBlock}, x * size_.xsamples + i, y * size_.ysamples + j);
      for (size_t k = 0; k < kBlock; ++k) {
        at_x[k] = (static_cast<float>(i) + at_x[k]) / xs - 0.5f;
        at_y[k] = (static_cast<float>(j) + at_y[k]) / ys - 0.5f;
      }
    }
  if (is_separable(filter_.kind))
    separable_weights(out);
  else
    for (size_t k = 0; k < at_x_.size(); ++k)
      out[k] = filter_weight(filter_, at_x_[k], at_y_[k]);
  add_sums(out);
}

void WindowWeights::separable_weights(float* out) const {
  const bool gauss = filter_.kind == FilterKind::kGaussian;
  const float last = gauss ? 1 : kSteps;
  const Axis across{x_.data(), 2 * last / filter_.xwidth, last},
      down{y_.data(), 2 * last / filter_.ywidth, last};
  (gauss ? kGaussian : kSeparable)(across, down, at_x_.data(), at_y_.data(), at_x_.size(), out);
}

/// In the order of means().
void WindowWeights::add_sums(float* weights) const {
  float* sums = weights + at_x_.size();
  auto add_up = [&] {
    std::fill_n(sums, kBlock, 0.0f);
    for (const float* w = weights; w != sums; w += kBlock)
      for (size_t lane = 0; lane < kBlock; ++lane)
        sums[lane] += w[lane];
  };
  add_up();
  if (std::find(sums, sums + kBlock, 0.0f) == sums + kBlock) return;
  for (size_t lane = 0; lane < kBlock; ++lane)
    for (int j = 0; sums[lane] == 0 && j < size_.ysamples; ++j)
      for (int i = 0; i < size_.xsamples; ++i)
        weights[(static_cast<size_t>(j - window_.j0) * window_.columns() +
                 static_cast<size_t>(i - window_.i0)) *
                    kBlock +
                lane] = 1;
  add_up();
}

void WindowWeights::means(std::span<const float* const> planes, std::span<const std::ptrdiff_t> offsets,
                          const float* weights, float* out) {
  kMean(planes, offsets, weights, out);
}

} // namespace render
#endif
