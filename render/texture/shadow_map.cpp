// As many regions at a time as the processor has lanes.
#include "render/texture/shadow_map.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/texture/shadow_map.cpp"
#include <hwy/foreach_target.h>

#include "render/texture/wide_block.h"
#include "slvm/wide/targets.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

// Two low-discrepancy sequences: points that fill the square evenly, whatever their number. The steps, in
// parts of 2^32.
constexpr uint32_t kGolden = 3242174889u, kGoldenSquared = 2447445414u;

/// What regions have at their points: linear in how far these are along the two sides.
struct Coordinate {
  V centre, along_u, along_v;

  /// The coordinate of a transform, of the regions from `i`.
  HWY_INLINE Coordinate(const slvm::Matrix4& m, int column, const ShadowRegions& r, size_t i) {
    auto transform = [&](const ShadowRegions::Lanes(&v)[3]) HWY_ATTR {
      V sum = hn::Mul(hn::Load(kWide, v[0] + i), number(m(0, column)));
      sum = hn::Add(sum, hn::Mul(hn::Load(kWide, v[1] + i), number(m(1, column))));
      return hn::Add(sum, hn::Mul(hn::Load(kWide, v[2] + i), number(m(2, column))));
    };
    centre = hn::Add(transform(r.centre), number(m(3, column)));
    along_u = transform(r.along_u);
    along_v = transform(r.along_v);
  }
  HWY_INLINE V at(V u, V v) const {
    return hn::Add(hn::Add(centre, hn::Mul(u, along_u)), hn::Mul(v, along_v));
  }
  HWY_INLINE bool is_point() const {
    const V zero = hn::Zero(kWide);
    return hn::AllTrue(kWide, hn::And(hn::Eq(along_u, zero), hn::Eq(along_v, zero)));
  }
};

/// Of a number of the sequence: from -1/2 to 1/2.
HWY_INLINE V place(hn::Vec<decltype(kWideBits)> bits) {
  const V part = hn::ConvertTo(kWide, hn::BitCast(kWideInt, hn::ShiftRight<8>(bits)));
  return hn::Sub(hn::Mul(part, number(0x1p-24f)), number(0.5f));
}

/// The part of the points hidden from the camera, for as many regions as lanes.
HWY_INLINE V part_hidden(const ShadowMap& map, const ShadowRegions& r, size_t i) {
  const Coordinate x(r.to_screen, 0, r, i), y(r.to_screen, 1, r, i), w(r.to_screen, 3, r, i),
      z(r.to_camera, 2, r, i);
  const V zero = hn::Zero(kWide), one = number(1.0f), middle = number(0.5f);
  const V sblur = hn::Load(kWide, r.sblur + i), tblur = hn::Load(kWide, r.tblur + i),
          bias = hn::Load(kWide, r.bias + i);
  const V columns = number(static_cast<float>(map.width)), rows = number(static_cast<float>(map.height));
  const auto last_column = hn::Set(kWideInt, map.width - 1), last_row = hn::Set(kWideInt, map.height - 1),
             width = hn::Set(kWideInt, map.width);
  const bool sharp = hn::AllTrue(kWide, hn::And(hn::Eq(sblur, zero), hn::Eq(tblur, zero)));
  const bool points =
      r.samples <= 1 || (sharp && x.is_point() && y.is_point() && w.is_point() && z.is_point());
  const int samples = points ? 1 : r.samples;
  auto a = hn::Load(kWideBits, r.turn + i), b = a;
  V hidden = zero;
  for (int k = 0; k < samples; ++k) {
    const V u = points ? zero : place(a), v = points ? zero : place(b);
    a = hn::Add(a, hn::Set(kWideBits, kGolden));
    b = hn::Add(b, hn::Set(kWideBits, kGoldenSquared));
    const V at_w = w.at(u, v), at_z = z.at(u, v), half = hn::Div(middle, at_w);
    const V s = hn::Add(hn::Add(middle, hn::Mul(half, x.at(u, v))), hn::Mul(u, sblur)),
            t = hn::Add(hn::Sub(middle, hn::Mul(half, y.at(u, v))), hn::Mul(v, tblur));
    // In front of the camera and inside the map only; elsewhere there is no shadow.
    auto inside = [&](V x01) HWY_ATTR { return hn::And(hn::Ge(x01, zero), hn::Lt(x01, one)); };
    const auto seen = hn::And(hn::And(hn::Gt(at_w, zero), hn::Gt(at_z, zero)), hn::And(inside(s), inside(t)));
    if (hn::AllFalse(kWide, seen)) continue;
    // Just below 1, s times the columns may be all of them.
    const auto column = hn::Min(hn::ConvertTo(kWideInt, hn::IfThenElseZero(seen, hn::Mul(s, columns))),
                                last_column),
               row = hn::Min(hn::ConvertTo(kWideInt, hn::IfThenElseZero(seen, hn::Mul(t, rows))), last_row);
    const V depth = hn::GatherIndex(kWide, map.depth.data(), hn::Add(hn::Mul(row, width), column));
    hidden = hn::Add(hidden, hn::IfThenElseZero(hn::And(seen, hn::Gt(at_z, hn::Add(depth, bias))), one));
  }
  return hn::Div(hidden, number(static_cast<float>(samples)));
}

void shadowed(const ShadowMap& map, const ShadowRegions& r, float* out) {
  for (size_t i = 0; i < ShadowRegions::kBlock; i += kLanes)
    hn::StoreU(part_hidden(map, r, i), kWide, out + i);
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
const auto kShadowed = SL_BEST(shadowed);

void ShadowMap::shadowed(const ShadowRegions& regions, float (&out)[ShadowRegions::kBlock]) const {
  kShadowed(*this, regions, out);
}

} // namespace render
#endif
