// Depths and values of vectors of samples, interpolated and stored where they are nearer.
#include "render/hider/quad_paint.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/hider/quad_paint.cpp"
#include <hwy/foreach_target.h>

#include "render/hider/quad_coverage.h"
#include "render/hider/sample_window.h"
#include "slvm/wide/targets.h"

#include <hwy/highway.h>

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
      const float* own = v.values + k * v.stride;
      for (float* plane : v.planes) {
        V value = hn::Set(kWide, own[0]);
        if (smooth_)
          value = weights.blend(value, hn::Set(kWide, own[v.stride]), hn::Set(kWide, own[nu_ * v.stride]),
                                hn::Set(kWide, own[(nu_ + 1) * v.stride]));
        samples.store(hn::IfThenElse(seen, value, samples.load(plane)), plane);
        ++own;
      }
    }
  }

private:
  size_t nu_;
  bool smooth_;
  std::span<const PaintedValues> values_;
  const SampleCanvas& canvas_;
  size_t covered_first_ = 0;
};

size_t paint_grid(const ShadedGrid& grid, std::span<const PaintedValues> values, const SampleCanvas& canvas) {
  const auto nu = static_cast<size_t>(grid.nu), nv = static_cast<size_t>(grid.nv),
             width = static_cast<size_t>(canvas.width);
  const Vec2 origin(static_cast<float>(canvas.covered.x0), static_cast<float>(canvas.covered.y0));
  Painter painter(grid, values, canvas);
  for (size_t j = 0, m = 0; j + 1 < nv; ++j) {
    if (!grid.rows.empty() && !grid.rows[j].touches(canvas.covered)) {
      m += nu - 1;
      continue;
    }
    for (size_t k = j * nu; k < (j + 1) * nu - 1; ++k, ++m) {
      if (grid.hidden[m] == ShadedGrid::kNotDrawn) continue;
      const Vec3* at = grid.position.data() + k;
      const Vec3 p[4] = {at[0], at[1], at[nu], at[nu + 1]};
      const Vec2 low = glm::min(glm::min(Vec2(p[0]), Vec2(p[1])), glm::min(Vec2(p[2]), Vec2(p[3])));
      const Vec2 high = glm::max(glm::max(Vec2(p[0]), Vec2(p[1])), glm::max(Vec2(p[2]), Vec2(p[3])));
      SampleWindow window;
      if (!find_window((low - origin) * canvas.density, (high - origin) * canvas.density, canvas.width,
                       canvas.height, window))
        continue;
      for_covered(p, canvas.x, canvas.y, width, window,
                  [&](const auto& samples, const WideQuad& quad, const WideCoverage& in)
                      HWY_ATTR { painter.paint(samples, quad, in, k); });
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

size_t paint(const ShadedGrid& grid, std::span<const PaintedValues> values, const SampleCanvas& canvas) {
  return kPaint(grid, values, canvas);
}

} // namespace render
#endif
