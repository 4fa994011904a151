// Micropolygons over lanes of samples: edge functions (Pineda, 1988). Compiled once per SIMD target
// (Highway), hence the unusual guard.
#if defined(RENDER_HIDER_QUAD_COVERAGE_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_HIDER_QUAD_COVERAGE_H_
#undef RENDER_HIDER_QUAD_COVERAGE_H_
#else
#define RENDER_HIDER_QUAD_COVERAGE_H_
#endif

#include "render/state/math.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, 16> kWide;
constexpr hn::RebindToSigned<decltype(kWide)> kIndices;
constexpr size_t kLanes = hn::MaxLanes(kWide);
using V = hn::Vec<decltype(kWide)>;
using I = hn::Vec<decltype(kIndices)>;
using M = hn::Mask<decltype(kWide)>;

struct WideVec2 {
  V x, y;
};

/// Which lanes' samples are in the triangle a b d, and which in a d c; and twice the areas that the samples
/// span with the sides, of either sign.
struct WideCoverage {
  M first, second;
  V ab, bd, dc, ca, diagonal;
  WideVec2 from_a; ///< to the samples
};

/// Corners a, b, c, d, u fastest; as many micropolygons as lanes, or one in all of them.
struct WideOutline {
  WideVec2 p[4];

  /// Of the samples at `at` only those in `looked_at` are found. Of two triangles that share an edge exactly
  /// one contains a sample on or near it: the areas for an edge and for its reverse differ in their signs
  /// only, products and differences being what they are in floating point; and samples that are right on an
  /// edge go to one side of it by its direction.
  HWY_INLINE WideCoverage cover(const WideVec2& at, M looked_at) const {
    WideVec2 from[4];
    for (size_t c = 0; c < 4; ++c)
      from[c] = {hn::Sub(at.x, p[c].x), hn::Sub(at.y, p[c].y)};
    auto area = [&](size_t i, size_t j) HWY_ATTR {
      return hn::Sub(hn::Mul(from[i].x, from[j].y), hn::Mul(from[i].y, from[j].x));
    };
    WideCoverage out;
    out.ab = area(0, 1);
    out.bd = area(1, 3);
    out.dc = area(3, 2);
    out.ca = area(2, 0);
    out.diagonal = area(3, 0);
    out.from_a = from[0];
    const V zero = hn::Zero(kWide);
    M ab = hn::Gt(out.ab, zero), bd = hn::Gt(out.bd, zero), dc = hn::Gt(out.dc, zero),
      ca = hn::Gt(out.ca, zero), da = hn::Gt(out.diagonal, zero);
    // Not greater than zero: also what is too small for a number, and what is none.
    const V product = hn::Mul(hn::Mul(hn::Mul(out.ab, out.bd), hn::Mul(out.dc, out.ca)), out.diagonal);
    if (HWY_UNLIKELY(!hn::AllFalse(kWide, hn::AndNot(hn::Gt(hn::Abs(product), zero), looked_at)))) {
      ab = with_ties(ab, out.ab, 0, 1);
      bd = with_ties(bd, out.bd, 1, 3);
      dc = with_ties(dc, out.dc, 3, 2);
      ca = with_ties(ca, out.ca, 2, 0);
      da = with_ties(da, out.diagonal, 3, 0);
    }
    out.first = hn::AndNot(hn::Or(hn::Xor(ab, da), hn::Xor(bd, da)), looked_at);
    // Seen from there the diagonal runs the other way.
    out.second = hn::And(hn::And(hn::Xor(dc, da), hn::Xor(ca, da)), looked_at);
    return out;
  }

private:
  /// Samples right on an edge are to the left of it if it runs to the left, or straight down.
  HWY_INLINE M with_ties(M left, V area, size_t from, size_t to) const {
    const WideVec2 &a = p[from], &b = p[to];
    const M back = hn::Or(hn::Lt(b.x, a.x), hn::And(hn::Eq(b.x, a.x), hn::Lt(b.y, a.y)));
    return hn::Or(left, hn::And(hn::Eq(area, hn::Zero(kWide)), back));
  }
};

struct WideQuad : WideOutline {
  V z[4];
};

struct WideBox {
  WideVec2 low, high;
  HWY_INLINE WideBox(Vec2 from, Vec2 to)
      : low{hn::Set(kWide, from.x), hn::Set(kWide, from.y)}, high{hn::Set(kWide, to.x),
                                                                  hn::Set(kWide, to.y)} {}
  HWY_INLINE M contains(const WideVec2& p) const {
    return hn::And(hn::And(hn::Ge(p.x, low.x), hn::Le(p.x, high.x)),
                   hn::And(hn::Ge(p.y, low.y), hn::Le(p.y, high.y)));
  }
};

/// Samples that are looked at together: neighbours in kRows rows, each of which has its part of a vector.
/// Where there are fewer rows the first one stands in for those that are missing.
template <size_t kRows> class SampleRows {
public:
  HWY_INLINE SampleRows(size_t first, size_t rows, size_t width) {
    for (size_t j = 0; j < kRows; ++j)
      first_[j] = j < rows ? first + j * width : first;
  }
  HWY_INLINE V load(const float* plane) const { return load(kWide, plane, 0); }
  /// What belongs to the first row wins where others are the same samples.
  HWY_INLINE void store(V v, float* plane) const { store(kWide, v, plane, 0); }
  HWY_INLINE I numbers() const {
    HWY_ALIGN int32_t out[kLanes];
    for (size_t j = 0; j < kRows; ++j)
      for (size_t i = 0; i < kLanes / kRows; ++i)
        out[j * (kLanes / kRows) + i] = static_cast<int32_t>(first_[j] + i);
    return hn::Load(kIndices, out);
  }

private:
  template <class D> HWY_INLINE hn::Vec<D> load(D d, const float* plane, size_t row) const {
#if HWY_TARGET != HWY_SCALAR
    if constexpr (hn::MaxLanes(d) * kRows > kLanes) {
      const hn::Half<D> half;
      constexpr size_t kUpper = hn::MaxLanes(half) * kRows / kLanes;
      return hn::Combine(d, load(half, plane, row + kUpper), load(half, plane, row));
    }
#endif
    return hn::LoadU(d, plane + first_[row]);
  }
  template <class D> HWY_INLINE void store(D d, hn::Vec<D> v, float* plane, size_t row) const {
#if HWY_TARGET != HWY_SCALAR
    if constexpr (hn::MaxLanes(d) * kRows > kLanes) {
      const hn::Half<D> half;
      constexpr size_t kUpper = hn::MaxLanes(half) * kRows / kLanes;
      store(half, hn::UpperHalf(half, v), plane, row + kUpper);
      store(half, hn::LowerHalf(half, v), plane, row);
      return;
    }
#endif
    hn::StoreU(v, d, plane + first_[row]);
  }

  size_t first_[kRows];
};

/// For windows of so many columns and rows, less one each: the lanes that are in it.
template <size_t kRows> struct WindowLanes {
  static constexpr size_t kColumns = kLanes / kRows;
  HWY_ALIGN int32_t lanes[kRows][kColumns][kLanes] = {};

  constexpr WindowLanes() {
    for (size_t rows = 0; rows < kRows; ++rows)
      for (size_t columns = 0; columns < kColumns; ++columns)
        for (size_t lane = 0; lane < kLanes; ++lane)
          lanes[rows][columns][lane] = lane / kColumns <= rows && lane % kColumns <= columns ? -1 : 0;
  }
};
template <size_t kRows> constexpr WindowLanes<kRows> kWindowLanes;

/// Calls look(samples, lanes in the window) for the samples of a window of at most kLanes / kRows columns.
template <size_t kRows, class Window, class Look>
HWY_INLINE void for_rows(size_t width, const Window& window, Look&& look) {
  const size_t columns = window.i1 - window.i0;
  size_t first = window.j0 * width + window.i0;
  for (size_t rows = window.j1 - window.j0;; rows -= kRows, first += kRows * width) {
    const int32_t* lanes = kWindowLanes<kRows>.lanes[std::min(rows, kRows) - 1][columns - 1];
    look(SampleRows<kRows>(first, rows, width),
         hn::RebindMask(kWide, hn::MaskFromVec(hn::Load(kIndices, lanes))));
    if (rows <= kRows) return;
  }
}

/// Calls look(samples, lanes in the window) for all of a window.
template <class Window, class Look>
HWY_INLINE void for_window(size_t width, const Window& window, Look&& look) {
  // Most micropolygons are so small that several rows of their windows fit into a vector.
  const size_t columns = window.i1 - window.i0;
  if constexpr (kLanes >= 8)
    if (columns <= 4) return for_rows<kLanes / 4>(width, window, look);
  if constexpr (kLanes >= 16)
    if (columns <= 8) return for_rows<kLanes / 8>(width, window, look);
  for (size_t j = window.j0; j < window.j1; ++j)
    for (size_t i = window.i0; i < window.i1; i += kLanes)
      look(SampleRows<1>(j * width + i, 1, width), hn::FirstN(kWide, window.i1 - i));
}

/// Calls `found(rows, coverage)` for all samples of the window, in vectors, of which some are in the
/// micropolygon. The raster positions are in the planes x and y, `width` samples to a row.
template <class Window, class Found>
HWY_INLINE void for_covered(const WideOutline& outline, const float* x, const float* y, size_t width,
                            const Window& window, Found&& found) {
  for_window(width, window, [&](const auto& rows, M in_window) HWY_ATTR {
    const WideCoverage covered = outline.cover({rows.load(x), rows.load(y)}, in_window);
    if (!hn::AllFalse(kWide, hn::Or(covered.first, covered.second))) found(rows, covered);
  });
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#endif
