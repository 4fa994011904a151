// The noise functions (RISpec 3.2, 15.1): gradient noise in one to four dimensions, free or periodic, and
// cell noise. What noise is made of: gradient_noise.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/noise.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"

#include "slvm/kernels/gradient_noise.h"
#include "slvm/kernels/hash.h"
#include "slvm/kernels/rows.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

// ---- Noise
inline Float noise1_f(Float x) {
  return float_noise({coordinate<0>(x)});
}
inline Vec3 noise1_v(Float x) {
  return triple_noise({coordinate<0>(x)});
}
inline Float noise2_f(Float x, Float y) {
  return float_noise({coordinate<0>(x), coordinate<1>(y)});
}
inline Vec3 noise2_v(Float x, Float y) {
  return triple_noise({coordinate<0>(x), coordinate<1>(y)});
}
inline Float noise3_f(Vec3 p) {
  return float_noise({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z)});
}
inline Vec3 noise3_v(Vec3 p) {
  return triple_noise({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z)});
}
inline Float noise4_f(Vec3 p, Float t) {
  return float_noise({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z), coordinate<3>(t)});
}
inline Vec3 noise4_v(Vec3 p, Float t) {
  return triple_noise({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z), coordinate<3>(t)});
}

// ---- Periodic noise
inline Float pnoise1_f(Float x, Float p) {
  return float_noise({coordinate<0>(x, p)});
}
inline Vec3 pnoise1_v(Float x, Float p) {
  return triple_noise({coordinate<0>(x, p)});
}
inline Float pnoise2_f(Float x, Float y, Float px, Float py) {
  return float_noise({coordinate<0>(x, px), coordinate<1>(y, py)});
}
inline Vec3 pnoise2_v(Float x, Float y, Float px, Float py) {
  return triple_noise({coordinate<0>(x, px), coordinate<1>(y, py)});
}
inline Float pnoise3_f(Vec3 a, Vec3 p) {
  return float_noise({coordinate<0>(a.x, p.x), coordinate<1>(a.y, p.y), coordinate<2>(a.z, p.z)});
}
inline Vec3 pnoise3_v(Vec3 a, Vec3 p) {
  return triple_noise({coordinate<0>(a.x, p.x), coordinate<1>(a.y, p.y), coordinate<2>(a.z, p.z)});
}
inline Float pnoise4_f(Vec3 a, Float t, Vec3 p, Float pt) {
  return float_noise(
      {coordinate<0>(a.x, p.x), coordinate<1>(a.y, p.y), coordinate<2>(a.z, p.z), coordinate<3>(t, pt)});
}
inline Vec3 pnoise4_v(Vec3 a, Float t, Vec3 p, Float pt) {
  return triple_noise(
      {coordinate<0>(a.x, p.x), coordinate<1>(a.y, p.y), coordinate<2>(a.z, p.z), coordinate<3>(t, pt)});
}

// ---- Cell noise: a random number for each unit cell
template <int kDimension> HWY_INLINE Bits cell_hash(const Coordinate (&at)[kDimension]) {
  Bits hash(0x2c1b3c6du * kDimension);
  for (const Coordinate& c : at)
    hash = hash ^ c.below;
  return mix_bits(mix_bits(hash));
}

inline Float cellnoise1_f(Float x) {
  return unit_float(cell_hash({coordinate<0>(x)}));
}
inline Vec3 cellnoise1_v(Float x) {
  return unit_triple(cell_hash({coordinate<0>(x)}));
}
inline Float cellnoise2_f(Float x, Float y) {
  return unit_float(cell_hash({coordinate<0>(x), coordinate<1>(y)}));
}
inline Vec3 cellnoise2_v(Float x, Float y) {
  return unit_triple(cell_hash({coordinate<0>(x), coordinate<1>(y)}));
}
inline Float cellnoise3_f(Vec3 p) {
  return unit_float(cell_hash({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z)}));
}
inline Vec3 cellnoise3_v(Vec3 p) {
  return unit_triple(cell_hash({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z)}));
}
inline Float cellnoise4_f(Vec3 p, Float t) {
  return unit_float(
      cell_hash({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z), coordinate<3>(t)}));
}
inline Vec3 cellnoise4_v(Vec3 p, Float t) {
  return unit_triple(
      cell_hash({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z), coordinate<3>(t)}));
}

#define SL_FAMILY fill_noise
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
