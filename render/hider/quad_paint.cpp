// Depths and values of vectors of samples, interpolated and stored where they are nearer.
#include "render/hider/quad_paint.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/hider/quad_paint.cpp"
#include <hwy/foreach_target.h>

#include "render/hider/quad_coverage.h"
#include "render/hider/sample_window.h"
#include "slvm/wide/targets.h"

#include <hwy/highway.h>

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Weights of the corners b, c, d; that of a is what is missing to 1.
struct WideWeights {
  V b, c, d;

  /// Differences, so that equal values stay exactly what they are.
  HWY_INLINE V blend(V at_a, V at_b, V at_c, V at_d) const {
    V ab = hn::Mul(hn::Sub(at_b, at_a), b), ad = hn::Mul(hn::Sub(at_d, at_a), d),
      ac = hn::Mul(hn::Sub(at_c, at_a), c);
    return hn::Add(hn::Add(hn::Add(at_a, ab), ad), ac);
  }
};

/// In each lane barycentric in the triangle that covers its sample. Lanes of triangles without area leave
/// `seen`.
HWY_INLINE WideWeights weights_in(const WideCoverage& in, M& seen) {
  const V diagonal = hn::Abs(in.diagonal), zero = hn::Zero(kWide);
  // The areas opposite to d and to b of the first triangle; to c and to d of the second.
  const V of_d = hn::Abs(hn::IfThenElse(in.first, in.ab, in.ca));
  const V of_a = hn::Abs(hn::IfThenElse(in.first, in.bd, in.dc));
  const V sum = hn::IfThenElse(in.first, hn::Add(hn::Add(of_a, diagonal), of_d),
                               hn::Add(hn::Add(of_a, of_d), diagonal));
  seen = hn::And(seen, hn::Gt(sum, zero));
  const V scale = hn::Div(hn::Set(kWide, 1.0f), sum), side = hn::Mul(diagonal, scale);
  return {hn::IfThenElseZero(in.first, side), hn::IfThenZeroElse(in.first, side), hn::Mul(of_d, scale)};
}

/// Paints the samples of vectors that one micropolygon covers.
class Painter {
public:
  Painter(const ShadedGrid& grid, std::span<const PaintedValues> values, const SampleCanvas& canvas)
      : nu_(static_cast<size_t>(grid.nu)), smooth_(grid.smooth), values_(values), canvas_(canvas) {}
  /// How many had no surface before.
  size_t covered_first() const { return covered_first_; }

  /// `k`: the micropolygon's first corner.
  template <class Samples>
  HWY_INLINE void paint(const Samples& samples, const WideQuad& quad, const WideCoverage& in, size_t k) {
    M seen = hn::Or(in.first, in.second);
    const WideWeights weights = weights_in(in, seen);
    const V z = weights.blend(quad.z[0], quad.z[1], quad.z[2], quad.z[3]), before = samples.load(canvas_.z);
    const M between =
        hn::And(hn::Ge(z, hn::Set(kWide, canvas_.near_plane)), hn::Le(z, hn::Set(kWide, canvas_.far_plane)));
    seen = hn::And(hn::And(seen, hn::Lt(z, before)), between);
    if (hn::AllFalse(kWide, seen)) return;
    samples.store(hn::IfThenElse(seen, z, before), canvas_.z);
    covered_first_ += hn::CountTrue(kWide, hn::And(seen, hn::Eq(before, hn::Set(kWide, kInfinity))));
    for (const PaintedValues& v : values_) {
      const float* own = v.values + k * v.step;
      V value = hn::Set(kWide, own[0]);
      if (smooth_)
        value = weights.blend(value, hn::Set(kWide, own[v.step]), hn::Set(kWide, own[nu_ * v.step]),
                              hn::Set(kWide, own[(nu_ + 1) * v.step]));
      samples.store(hn::IfThenElse(seen, value, samples.load(v.plane)), v.plane);
    }
  }

private:
  size_t nu_;
  bool smooth_;
  std::span<const PaintedValues> values_;
  const SampleCanvas& canvas_;
  size_t covered_first_ = 0;
};

/// Boxes around micropolygons beside each other in a row, a lane each, and the samples they touch.
class NeighbourBoxes {
public:
  /// Up to kLanes micropolygons, the first corner of the first of which is k.
  HWY_INLINE NeighbourBoxes(const ShadedGrid& grid, size_t k, size_t count, const SampleCanvas& canvas) {
    M touching = hn::FirstN(kWide, count);
    find(grid, 0, k, canvas.covered.x0, canvas.density.x, canvas.width, low_x_, high_x_, i0_, i1_, touching);
    find(grid, 1, k, canvas.covered.y0, canvas.density.y, canvas.height, low_y_, high_y_, j0_, j1_, touching);
    hn::StoreMaskBits(kWide, touching, reinterpret_cast<uint8_t*>(&touching_));
  }

  /// A bit for each that touches samples.
  uint64_t touching() const { return touching_; }
  WideBox box(size_t lane) const { return {{low_x_[lane], low_y_[lane]}, {high_x_[lane], high_y_[lane]}}; }
  SampleWindow window(size_t lane) const {
    return {static_cast<size_t>(i0_[lane]), static_cast<size_t>(i1_[lane]), static_cast<size_t>(j0_[lane]),
            static_cast<size_t>(j1_[lane])};
  }

private:
  /// find_window() along one axis.
  HWY_INLINE static void find(const ShadedGrid& grid, size_t component, size_t k, int origin, float density,
                              int cells, float* low, float* high, int32_t* begin, int32_t* end, M& touching) {
    const auto nu = static_cast<size_t>(grid.nu);
    const float* at = grid.position.plane(component) + k;
    const V a = hn::LoadU(kWide, at), b = hn::LoadU(kWide, at + 1), c = hn::LoadU(kWide, at + nu),
            d = hn::LoadU(kWide, at + nu + 1);
    const V least = hn::Min(hn::Min(a, b), hn::Min(c, d)), most = hn::Max(hn::Max(a, b), hn::Max(c, d));
    const V zero = hn::Zero(kWide), limit = hn::Set(kWide, static_cast<float>(cells));
    auto place = [&](V v) HWY_ATTR {
      return hn::Mul(hn::Sub(v, hn::Set(kWide, static_cast<float>(origin))), hn::Set(kWide, density));
    };
    const V from = place(least), to = place(most);
    // Also what is not a number, of micropolygons that are hidden, stays within the cells.
    auto cell = [&](V v) HWY_ATTR {
      return hn::Max(hn::ConvertTo(kIndices, hn::Min(limit, hn::Max(zero, v))), hn::Zero(kIndices));
    };
    const I first = cell(from), last = cell(hn::Add(to, hn::Set(kWide, 1.0f)));
    touching = hn::And(touching, hn::And(hn::Ge(to, zero), hn::RebindMask(kWide, hn::Lt(first, last))));
    hn::Store(least, kWide, low);
    hn::Store(most, kWide, high);
    hn::Store(first, kIndices, begin);
    hn::Store(last, kIndices, end);
  }

  HWY_ALIGN float low_x_[kLanes], low_y_[kLanes], high_x_[kLanes], high_y_[kLanes];
  HWY_ALIGN int32_t i0_[kLanes], i1_[kLanes], j0_[kLanes], j1_[kLanes];
  uint64_t touching_ = 0;
};

/// Which of micropolygons beside each other are opaque all over, and which are not there at all: a bit each.
struct Opacities {
  uint64_t opaque = ~uint64_t{0}, absent = 0;

  HWY_INLINE Opacities(const ShadedGrid& grid, size_t k) {
    if (grid.opaque) return;
    M ones = hn::FirstN(kWide, kLanes), zeros = ones;
    for (size_t c = 0; c < 3; ++c) {
      each_corner(grid, grid.Oi.plane(c) + k, [&](V O) HWY_ATTR {
        ones = hn::And(ones, hn::Eq(O, hn::Set(kWide, 1.0f)));
        zeros = hn::And(zeros, hn::Eq(O, hn::Zero(kWide)));
      });
      each_corner(grid, grid.Ci.plane(c) + k,
                  [&](V C) HWY_ATTR { zeros = hn::And(zeros, hn::Eq(C, hn::Zero(kWide))); });
    }
    opaque = 0;
    hn::StoreMaskBits(kWide, ones, reinterpret_cast<uint8_t*>(&opaque));
    hn::StoreMaskBits(kWide, zeros, reinterpret_cast<uint8_t*>(&absent));
  }

private:
  /// Those whose values are seen: without smooth shading the first.
  template <class F> HWY_INLINE static void each_corner(const ShadedGrid& grid, const float* at, F&& f) {
    f(hn::LoadU(kWide, at));
    if (!grid.smooth) return;
    const auto nu = static_cast<size_t>(grid.nu);
    f(hn::LoadU(kWide, at + 1));
    f(hn::LoadU(kWide, at + nu));
    f(hn::LoadU(kWide, at + nu + 1));
  }
};

/// A micropolygon of a grid in all lanes.
HWY_INLINE WideQuad quad_of(const ShadedGrid& grid, size_t k) {
  const float *x = grid.position.plane(0), *y = grid.position.plane(1), *z = grid.position.plane(2);
  const auto nu = static_cast<size_t>(grid.nu);
  const size_t corners[] = {k, k + 1, k + nu, k + nu + 1};
  WideQuad out;
  for (size_t c = 0; c < 4; ++c) {
    out.p[c] = {hn::Set(kWide, x[corners[c]]), hn::Set(kWide, y[corners[c]])};
    out.z[c] = hn::Set(kWide, z[corners[c]]);
  }
  return out;
}

size_t paint_grid(const ShadedGrid& grid, std::span<const PaintedValues> values, const SampleCanvas& canvas,
                  std::vector<size_t>& rest) {
  const auto nu = static_cast<size_t>(grid.nu), nv = static_cast<size_t>(grid.nv),
             width = static_cast<size_t>(canvas.width);
  Painter painter(grid, values, canvas);
  for (size_t j = 0; j + 1 < nv; ++j) {
    if (!grid.rows.empty() && !grid.rows[j].touches(canvas.covered)) continue;
    for (size_t first = 0; first + 1 < nu; first += kLanes) {
      const NeighbourBoxes boxes(grid, j * nu + first, std::min(kLanes, nu - 1 - first), canvas);
      if (boxes.touching() == 0) continue;
      const Opacities opacities(grid, j * nu + first);
      for (uint64_t left = boxes.touching() & ~opacities.absent; left != 0; left &= left - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(left));
        const size_t i = first + lane, k = j * nu + i;
        if (grid.hidden[j * (nu - 1) + i] == ShadedGrid::kNotDrawn) continue;
        if ((opacities.opaque >> lane & 1) == 0) {
          rest.push_back(k);
          continue;
        }
        const WideQuad quad = quad_of(grid, k);
        for_covered(quad, boxes.box(lane), canvas.x, canvas.y, width, boxes.window(lane),
                    [&](const auto& samples, const WideCoverage& in)
                        HWY_ATTR { painter.paint(samples, quad, in, k); });
      }
    }
  }
  return painter.covered_first();
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
const auto kPaint = SL_BEST(paint_grid);

size_t paint(const ShadedGrid& grid, std::span<const PaintedValues> values, const SampleCanvas& canvas,
             std::vector<size_t>& rest) {
  return kPaint(grid, values, canvas, rest);
}

} // namespace render
#endif
