// Separable filters from tables, as many samples at a time as the processor has lanes.
#include "render/hider/window_weights.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/hider/window_weights.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

namespace render {
#ifndef RENDER_HIDER_AXIS_
#define RENDER_HIDER_AXIS_
/// One axis: the table of its weights and how distances are turned into places there.
struct Axis {
  const float* table;
  float scale, centre, last; ///< last: place in the table beyond which weights are 0
};
#endif
} // namespace render

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D, class V = hn::Vec<D>> HWY_INLINE V axis_weight(D wide, const Axis& axis, V at) {
  constexpr hn::RebindToSigned<D> kIndices;
  V place = hn::Mul(hn::Abs(hn::Sub(at, hn::Set(wide, axis.centre))), hn::Set(wide, axis.scale));
  V last = hn::Set(wide, axis.last);
  auto i = hn::ConvertTo(kIndices, hn::Min(place, last));
  V below = hn::GatherIndex(wide, axis.table, i), above = hn::GatherIndex(wide, axis.table + 1, i);
  V weight = hn::Add(below, hn::Mul(hn::Sub(above, below), hn::Sub(place, hn::ConvertTo(wide, i))));
  return hn::IfThenElseZero(hn::Le(place, last), weight);
}

/// Writes up to a vector beyond the last weight.
template <class D>
HWY_INLINE void separable_in(D wide, const Axis& x, const Axis& y, const SamplePattern& pattern,
                             const SampleWindow& window, float* out) {
  for (size_t j = window.j0; j < window.j1; ++j) {
    size_t first = j * static_cast<size_t>(pattern.width());
    for (size_t i = window.i0; i < window.i1; i += hn::Lanes(wide)) {
      auto weight = hn::Mul(axis_weight(wide, x, hn::LoadU(wide, pattern.x() + first + i)),
                            axis_weight(wide, y, hn::LoadU(wide, pattern.y() + first + i)));
      hn::StoreU(weight, wide, out + (i - window.i0));
    }
    out += window.i1 - window.i0;
  }
}

void separable(const Axis& x, const Axis& y, const SamplePattern& pattern, const SampleWindow& window,
               float* out) {
  // Windows are often 4 samples wide: wider gathers would cost more than they bring.
  if (window.i1 - window.i0 <= 4) return separable_in(hn::CappedTag<float, 4>(), x, y, pattern, window, out);
  separable_in(hn::CappedTag<float, 8>(), x, y, pattern, window, out);
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(separable);

WindowWeights::WindowWeights(const PixelFilter& filter) : filter_(filter) {
  if (!is_separable(filter.kind)) return;
  x_ = axis_table(filter.xwidth);
  y_ = axis_table(filter.ywidth);
}

WindowWeights::AxisTable WindowWeights::axis_table(float width) const {
  AxisTable out{};
  for (size_t i = 0; i <= kSteps; ++i)
    out[i] = axis_weight(filter_.kind, width / 2 * static_cast<float>(i) / kSteps, width);
  return out;
}

const float* WindowWeights::at(Vec2 centre, const SamplePattern& pattern, const SampleWindow& window) {
  size_t room = window.count() + SamplePattern::kPadding;
  if (weights_.size() < room) weights_.resize(room);
  if (is_separable(filter_.kind)) {
    Axis x{x_.data(), 2 * kSteps / filter_.xwidth, centre.x, kSteps},
        y{y_.data(), 2 * kSteps / filter_.ywidth, centre.y, kSteps};
    HWY_DYNAMIC_DISPATCH(separable)(x, y, pattern, window, weights_.data());
    return weights_.data();
  }
  float* out = weights_.data();
  for (size_t j = window.j0; j < window.j1; ++j)
    for (size_t i = window.i0; i < window.i1; ++i) {
      Vec2 offset = pattern.at(j * static_cast<size_t>(pattern.width()) + i) - centre;
      *out++ = filter_weight(filter_, offset.x, offset.y);
    }
  return weights_.data();
}

} // namespace render
#endif
