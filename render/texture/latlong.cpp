// As many directions at a time as the processor has lanes.
#include "render/texture/latlong.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/texture/latlong.cpp"
#include <hwy/foreach_target.h>

#include "render/texture/wide_block.h"
#include "slvm/wide/targets.h"

#include <hwy/contrib/math/math-inl.h>

#include <limits>
#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// In parts of a turn, -1/2 to 1/2; 0 where both are.
HWY_INLINE V turn_of(V y, V x) {
  const V across = hn::Abs(x), up = hn::Abs(y), zero = hn::Zero(kWide);
  const V large = hn::Max(across, up), small = hn::Min(across, up);
  const V tangent = hn::IfThenElseZero(hn::Gt(large, zero), hn::Div(small, large));
  V turn = hn::Mul(hn::Atan(kWide, tangent), number(1 / kTurn));
  turn = hn::IfThenElse(hn::Gt(up, across), hn::Sub(number(0.25f), turn), turn);
  turn = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(number(0.5f), turn), turn);
  return hn::IfThenElse(hn::Lt(y, zero), hn::Neg(turn), turn);
}

void find_places(const Directions& d, TextureRegions& out) {
  const V zero = hn::Zero(kWide), one = number(1);
  for (size_t i = 0; i < TextureRegions::kBlock; i += kLanes) {
    const V x = hn::Load(kWide, d.centre[0] + i), y = hn::Load(kWide, d.centre[1] + i),
            z = hn::Load(kWide, d.centre[2] + i);
    const V across = hn::Add(hn::Mul(x, x), hn::Mul(y, y)), flat = hn::Sqrt(across),
            square = hn::Add(across, hn::Mul(z, z));
    // What is no number leads nowhere: comparisons and minima would lose it.
    const auto somewhere = hn::And(hn::And(hn::Eq(x, x), hn::Eq(y, y)), hn::Eq(z, z));
    const auto aside = hn::Gt(across, zero), there = hn::Gt(square, zero);
    const V length = hn::Sqrt(square), half_turns = hn::Mul(length, number(kTurn / 2));
    const V longitude = turn_of(y, x),
            s = hn::IfThenElse(hn::Lt(longitude, zero), hn::Add(longitude, one), longitude);
    hn::Store(hn::IfThenElse(somewhere, s, number(std::numeric_limits<float>::quiet_NaN())), kWide,
              out.s + i);
    // A circle on the sphere is so many times longer on the map than it is high.
    const V stretch = hn::IfThenElse(there, hn::Div(length, hn::Max(flat, number(1e-30f))), one);
    const V sblur = hn::Load(kWide, out.sblur + i);
    V east_square = hn::Mul(hn::Mul(sblur, sblur), number(4)); // in half turns
    auto change = [&](const Directions::Lanes(&along)[3], float* s_change, float* t_change) HWY_ATTR {
      const V dx = hn::Load(kWide, along[0] + i), dy = hn::Load(kWide, along[1] + i),
              dz = hn::Load(kWide, along[2] + i);
      const V east = hn::Div(hn::Sub(hn::Mul(x, dy), hn::Mul(y, dx)), hn::Mul(flat, half_turns));
      const V outward = hn::Div(hn::Add(hn::Mul(x, dx), hn::Mul(y, dy)), flat);
      const V down = hn::Div(hn::Sub(hn::Mul(z, outward), hn::Mul(flat, dz)), hn::Mul(length, half_turns));
      // From a pole all ways lead down; next to it all longitudes are near.
      const V away = hn::Div(hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy))), half_turns);
      auto on_sphere = [&](V other)
                           HWY_ATTR { return hn::IfThenElseZero(there, hn::IfThenElse(aside, other, away)); };
      const V east_there = on_sphere(east), round = hn::Mul(hn::Mul(east_there, number(0.5f)), stretch);
      east_square = hn::Add(east_square, hn::Mul(east_there, east_there));
      hn::Store(hn::Min(hn::Max(round, number(-1)), one), kWide, s_change + i);
      hn::Store(on_sphere(down), kWide, t_change + i);
    };
    change(d.along_u, out.s_u, out.t_u);
    change(d.along_v, out.s_v, out.t_v);
    // What is to the east and west of a place is further from the pole: its mean distance is that of the
    // variance of a box.
    const V latitude = hn::Mul(turn_of(z, flat), number(2)), pole = hn::Sub(number(0.5f), hn::Abs(latitude));
    const V mean = hn::Sqrt(hn::Add(hn::Mul(pole, pole), hn::Mul(east_square, number(1.0f / 12)))),
            lower = hn::Div(hn::Mul(hn::Sub(mean, pole), z), hn::Max(length, number(1e-30f)));
    hn::Store(hn::Add(hn::Sub(number(0.5f), latitude), lower), kWide, out.t + i);
    hn::Store(hn::IfThenElseZero(hn::Gt(sblur, zero), hn::Min(hn::Mul(sblur, stretch), hn::Max(sblur, one))),
              kWide, out.sblur + i);
    hn::Store(stretch, kWide, out.stretch + i);
  }
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
const auto kFindPlaces = SL_BEST(find_places);

void find_latlong(const Directions& directions, TextureRegions& out) {
  kFindPlaces(directions, out);
}

} // namespace render
#endif
