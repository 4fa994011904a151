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

/// One micropolygon's depths in all lanes: those of the plane of each of its triangles through the corner a.
struct WideDepths {
  static constexpr size_t kNumbers = 7;
  V at_a, first_x, first_y, second_x, second_y; ///< changes by pixel of the first and of the second
  V least, most;                                ///< of the corners: planes seen from their edges are steep

  /// From kNumbers in this order, kLanes apart.
  HWY_INLINE explicit WideDepths(const float* numbers) {
    size_t i = 0;
    for (V* v : {&at_a, &first_x, &first_y, &second_x, &second_y, &least, &most})
      *v = hn::Set(kWide, numbers[kLanes * i++]);
  }
  HWY_INLINE V at(const WideCoverage& in) const {
    const V x = hn::IfThenElse(in.first, first_x, second_x), y = hn::IfThenElse(in.first, first_y, second_y);
    const V z = hn::Add(at_a, hn::Add(hn::Mul(x, in.from_a.x), hn::Mul(y, in.from_a.y)));
    return hn::Min(hn::Max(z, least), most);
  }
};

/// Paints the samples of vectors that one micropolygon covers.
class Painter {
public:
  Painter(const ShadedGrid& grid, std::span<const PaintedValues> values, const SampleCanvas& canvas)
      : nu_(static_cast<size_t>(grid.nu)), smooth_(grid.smooth), values_(values), canvas_(canvas) {}
  /// How many had no surface before.
  size_t covered_first() const { return covered_first_; }

  /// `k`: the micropolygon's first corner; `clipped`: parts of it may be beyond the clipping planes.
  template <class Samples>
  HWY_INLINE void paint(const Samples& samples, const WideDepths& depths, const WideCoverage& in, size_t k,
                        bool clipped) {
    M seen = hn::Or(in.first, in.second);
    const V z = depths.at(in), before = samples.load(canvas_.z);
    if (clipped)
      seen = hn::And(seen, hn::And(hn::Ge(z, hn::Set(kWide, canvas_.near_plane)),
                                   hn::Le(z, hn::Set(kWide, canvas_.far_plane))));
    seen = hn::And(seen, hn::Lt(z, before));
    if (hn::AllFalse(kWide, seen)) return;
    samples.store(hn::IfThenElse(seen, z, before), canvas_.z);
    covered_first_ += hn::CountTrue(kWide, hn::And(seen, hn::Eq(before, hn::Set(kWide, kInfinity))));
    if (smooth_)
      blend(samples, in, seen, k);
    else
      for (const PaintedValues& v : values_)
        set(samples, seen, hn::Set(kWide, v.values[k * v.step]), v.plane);
  }

private:
  template <class Samples> HWY_INLINE static void set(const Samples& samples, M seen, V value, float* plane) {
    samples.store(hn::IfThenElse(seen, value, samples.load(plane)), plane);
  }
  template <class Samples>
  HWY_INLINE void blend(const Samples& samples, const WideCoverage& in, M seen, size_t k) const {
    const WideWeights weights = weights_in(in, seen);
    for (const PaintedValues& v : values_) {
      const float *at = v.values + k * v.step, *next = at + nu_ * v.step;
      set(samples, seen,
          weights.blend(hn::Set(kWide, at[0]), hn::Set(kWide, at[v.step]), hn::Set(kWide, next[0]),
                        hn::Set(kWide, next[v.step])),
          v.plane);
    }
  }

  size_t nu_;
  bool smooth_;
  std::span<const PaintedValues> values_;
  const SampleCanvas& canvas_;
  size_t covered_first_ = 0;
};

/// Micropolygons beside each other in a row, a lane each: the samples their boxes touch and the planes they
/// are in.
class Neighbours {
public:
  /// Up to kLanes micropolygons, the first corner of the first of which is k.
  HWY_INLINE Neighbours(const ShadedGrid& grid, size_t k, size_t count, const SampleCanvas& canvas) {
    M touching = hn::FirstN(kWide, count);
    const Corners x(grid, 0, k), y(grid, 1, k);
    find(x, canvas.covered.x0, canvas.density.x, canvas.width, i0_, i1_, touching);
    find(y, canvas.covered.y0, canvas.density.y, canvas.height, j0_, j1_, touching);
    if (hn::AllFalse(kWide, touching)) return;
    const Corners z(grid, 2, k);
    find_depths(x, y, z, touching);
    const M clipped = hn::Not(hn::And(hn::Ge(z.least(), hn::Set(kWide, canvas.near_plane)),
                                      hn::Le(z.most(), hn::Set(kWide, canvas.far_plane))));
    touching_ = bits_of(touching);
    clipped_ = bits_of(clipped);
  }

  /// A bit for each that touches samples and has an area.
  uint64_t touching() const { return touching_; }
  /// Whether parts of it may be beyond the clipping planes.
  bool clipped(size_t lane) const { return (clipped_ >> lane & 1) != 0; }
  SampleWindow window(size_t lane) const {
    return {static_cast<size_t>(i0_[lane]), static_cast<size_t>(i1_[lane]), static_cast<size_t>(j0_[lane]),
            static_cast<size_t>(j1_[lane])};
  }
  /// For WideDepths.
  const float* depths(size_t lane) const { return depths_ + lane; }

private:
  /// One component of the corners of each.
  struct Corners {
    V a, b, c, d;

    HWY_INLINE Corners(const ShadedGrid& grid, size_t component, size_t k) {
      const auto nu = static_cast<size_t>(grid.nu);
      const float* at = grid.position.plane(component) + k;
      a = hn::LoadU(kWide, at);
      b = hn::LoadU(kWide, at + 1);
      c = hn::LoadU(kWide, at + nu);
      d = hn::LoadU(kWide, at + nu + 1);
    }
    HWY_INLINE V least() const { return hn::Min(hn::Min(a, b), hn::Min(c, d)); }
    HWY_INLINE V most() const { return hn::Max(hn::Max(a, b), hn::Max(c, d)); }
  };

  HWY_INLINE static uint64_t bits_of(M mask) {
    uint64_t bits = 0;
    hn::StoreMaskBits(kWide, mask, reinterpret_cast<uint8_t*>(&bits));
    return bits;
  }

  /// find_window() along one axis.
  HWY_INLINE static void find(const Corners& corners, int origin, float density, int cells, int32_t* begin,
                              int32_t* end, M& touching) {
    const V zero = hn::Zero(kWide), limit = hn::Set(kWide, static_cast<float>(cells));
    auto place = [&](V v) HWY_ATTR {
      return hn::Mul(hn::Sub(v, hn::Set(kWide, static_cast<float>(origin))), hn::Set(kWide, density));
    };
    const V from = place(corners.least()), to = place(corners.most());
    // Also what is not a number, of micropolygons that are hidden, stays within the cells.
    auto cell = [&](V v) HWY_ATTR {
      return hn::Max(hn::ConvertTo(kIndices, hn::Min(limit, hn::Max(zero, v))), hn::Zero(kIndices));
    };
    const I first = cell(from), last = cell(hn::Add(to, hn::Set(kWide, 1.0f)));
    touching = hn::And(touching, hn::And(hn::Ge(to, zero), hn::RebindMask(kWide, hn::Lt(first, last))));
    hn::Store(first, kIndices, begin);
    hn::Store(last, kIndices, end);
  }

  struct Slopes {
    V x, y;
    M solid; ///< has an area
  };
  /// Of the depths in a triangle whose sides from the corner a go by b and by d.
  HWY_INLINE static Slopes slopes(const V (&b)[3], const V (&d)[3]) {
    const V area = hn::Sub(hn::Mul(b[0], d[1]), hn::Mul(b[1], d[0])), one = hn::Set(kWide, 1.0f);
    const M solid = hn::Ne(area, hn::Zero(kWide));
    const V scale = hn::Div(one, hn::IfThenElse(solid, area, one));
    return {hn::Mul(hn::Sub(hn::Mul(b[2], d[1]), hn::Mul(d[2], b[1])), scale),
            hn::Mul(hn::Sub(hn::Mul(d[2], b[0]), hn::Mul(b[2], d[0])), scale), solid};
  }

  /// Takes those without an area and what is no number out of `touching`.
  HWY_INLINE void find_depths(const Corners& x, const Corners& y, const Corners& z, M& touching) {
    const V b[] = {hn::Sub(x.b, x.a), hn::Sub(y.b, y.a), hn::Sub(z.b, z.a)},
            c[] = {hn::Sub(x.c, x.a), hn::Sub(y.c, y.a), hn::Sub(z.c, z.a)},
            d[] = {hn::Sub(x.d, x.a), hn::Sub(y.d, y.a), hn::Sub(z.d, z.a)};
    const Slopes first = slopes(b, d), second = slopes(c, d);
    const V sum = hn::Add(hn::Add(hn::Add(first.x, first.y), hn::Add(second.x, second.y)), z.a);
    touching = hn::And(hn::And(touching, hn::Or(first.solid, second.solid)),
                       hn::Eq(hn::Sub(sum, sum), hn::Zero(kWide)));
    float* out = depths_;
    for (V v : {z.a, first.x, first.y, second.x, second.y, z.least(), z.most()}) {
      hn::Store(v, kWide, out);
      out += kLanes;
    }
  }

  HWY_ALIGN int32_t i0_[kLanes], i1_[kLanes], j0_[kLanes], j1_[kLanes];
  HWY_ALIGN float depths_[WideDepths::kNumbers * kLanes];
  uint64_t touching_ = 0, clipped_ = 0;
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
HWY_INLINE WideOutline outline_of(const ShadedGrid& grid, size_t k) {
  const float *x = grid.position.plane(0), *y = grid.position.plane(1);
  const auto nu = static_cast<size_t>(grid.nu);
  const size_t corners[] = {k, k + 1, k + nu, k + nu + 1};
  WideOutline out;
  for (size_t c = 0; c < 4; ++c)
    out.p[c] = {hn::Set(kWide, x[corners[c]]), hn::Set(kWide, y[corners[c]])};
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
      const Neighbours neighbours(grid, j * nu + first, std::min(kLanes, nu - 1 - first), canvas);
      if (neighbours.touching() == 0) continue;
      const Opacities opacities(grid, j * nu + first);
      for (uint64_t left = neighbours.touching() & ~opacities.absent; left != 0; left &= left - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(left));
        const size_t i = first + lane, k = j * nu + i;
        if (grid.hidden[j * (nu - 1) + i] == ShadedGrid::kNotDrawn) continue;
        if ((opacities.opaque >> lane & 1) == 0) {
          rest.push_back(k);
          continue;
        }
        const WideOutline outline = outline_of(grid, k);
        const bool clipped = neighbours.clipped(lane);
        const float* depths = neighbours.depths(lane);
        for_covered(outline, canvas.x, canvas.y, width, neighbours.window(lane),
                    [&](const auto& samples, const WideCoverage& in)
                        HWY_ATTR { painter.paint(samples, WideDepths(depths), in, k, clipped); });
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
