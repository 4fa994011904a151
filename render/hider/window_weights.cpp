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
/// One axis: where the pixel is, and what turns distances from it into places in the table of weights or, of
/// gaussians, into parts of the filter's half width.
struct Axis {
  const float* table;
  float centre, scale, last; ///< last: place beyond which weights are 0
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
  return hn::Mul(hn::Abs(hn::Sub(at, hn::Set(kWide, axis.centre))), hn::Set(kWide, axis.scale));
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

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cstring>

namespace render {
const auto kSeparable = SL_BEST(separable);
const auto kGaussian = SL_BEST(gaussian);

WindowWeights::WindowWeights(const PixelFilter& filter) : filter_(filter) {
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

/// Copies what of each row is in the window, one after the other, in steps of four.
void WindowWeights::pack(const float* samples, size_t width, const SampleWindow& window,
                         std::vector<float>& out) {
  float* to = out.data();
  for (size_t j = window.j0; j < window.j1; ++j, to += window.i1 - window.i0) {
    const float* row = samples + j * width + window.i0;
    for (size_t i = 0; i < window.i1 - window.i0; i += 4)
      std::memcpy(to + i, row + i, 4 * sizeof(float));
  }
}

const float* WindowWeights::at(Vec2 centre, const SamplePattern& pattern, const SampleWindow& window) {
  const size_t count = window.count(), room = count + SamplePattern::kPadding;
  auto width = static_cast<size_t>(pattern.width());
  for (std::vector<float>* v : {&at_x_, &at_y_, &weights_})
    if (v->size() < room) v->resize(room);
  if (!is_separable(filter_.kind)) {
    float* out = weights_.data();
    for (size_t j = window.j0; j < window.j1; ++j)
      for (size_t i = window.i0; i < window.i1; ++i) {
        Vec2 offset = pattern.at(j * width + i) - centre;
        *out++ = filter_weight(filter_, offset.x, offset.y);
      }
    return weights_.data();
  }
  pack(pattern.x(), width, window, at_x_);
  pack(pattern.y(), width, window, at_y_);
  const bool gauss = filter_.kind == FilterKind::kGaussian;
  const float last = gauss ? 1 : kSteps;
  const Axis x{x_.data(), centre.x, 2 * last / filter_.xwidth, last},
      y{y_.data(), centre.y, 2 * last / filter_.ywidth, last};
  (gauss ? kGaussian : kSeparable)(x, y, at_x_.data(), at_y_.data(), count, weights_.data());
  return weights_.data();
}

} // namespace render
#endif
