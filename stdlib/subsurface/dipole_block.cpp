#include "stdlib/subsurface/dipole_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stdlib/subsurface/dipole_block.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/targets.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace subsurface {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, kBlock> kWide;
constexpr hn::RebindToSigned<decltype(kWide)> kWideInt;
constexpr size_t kLanes = hn::MaxLanes(kWide);
using V = hn::Vec<decltype(kWide)>;

/// At most 87, where exp(-x) is no longer told from 0; so is what is no number (x86: of min).
HWY_INLINE V at_most_87(V x) {
  return hn::Min(x, hn::Set(kWide, 87.0f));
}

/// exp(-x) = 2^-n exp(-f) with n = round(x/log 2), |f| <= log(2)/2; the polynomial is Taylor's, whose next
/// term is below 4e-8 there. Without branches.
HWY_INLINE V exp_minus_wide(V bounded) {
  const V n = hn::Round(hn::Mul(bounded, hn::Set(kWide, 1.44269504f)));
  const V high = hn::NegMulAdd(n, hn::Set(kWide, 0.693145752f), bounded);
  const V f = hn::Neg(hn::NegMulAdd(n, hn::Set(kWide, 1.42860677e-6f), high));
  V p = hn::Set(kWide, 1.0f / 5040);
  for (float c : {1.0f / 720, 1.0f / 120, 1.0f / 24, 1.0f / 6, 0.5f, 1.0f, 1.0f})
    p = hn::MulAdd(p, f, hn::Set(kWide, c));
  const auto exponent = hn::ShiftLeft<23>(hn::ConvertTo(kWideInt, n));
  return hn::BitCast(kWide, hn::Sub(hn::BitCast(kWideInt, p), exponent));
}

HWY_INLINE V source(V distance2, V transport, V z) {
  const V d2 = hn::MulAdd(z, z, distance2), d = hn::Sqrt(d2), reach = at_most_87(hn::Mul(transport, d));
  const V decay = exp_minus_wide(reach);
  return hn::Div(hn::Mul(hn::MulAdd(z, reach, z), decay), hn::Mul(d2, d));
}

void add_dipoles(const DipoleBlock& block, Vec3 x, const float* HWY_RESTRICT weight, DipoleSums& sums) {
  for (size_t i = 0; i < kBlock; i += kLanes) {
    auto load = [i](const float* from) { return hn::Load(kWide, from + i); };
    V distance2 = hn::Zero(kWide);
    for (int c = 0; c < 3; ++c) {
      const V from = hn::Sub(hn::Set(kWide, x[c]), load(block.position[c]));
      distance2 = hn::MulAdd(from, from, distance2);
    }
    const V counts = load(weight);
    for (int c = 0; c < 3; ++c) {
      const DipoleBlock::Lanes& d = block.dipole[c];
      const V transport = load(d.transport);
      const V both = hn::Add(source(distance2, transport, load(d.z_real)),
                             source(distance2, transport, load(d.z_virtual)));
      const V light = hn::Mul(hn::Mul(counts, load(block.flux[c])), load(d.gain));
      hn::Store(hn::MulAdd(light, both, load(sums.lane[c])), kWide, sums.lane[c] + i);
    }
  }
}

void exp_minus(const float* x, float* result) {
  for (size_t i = 0; i < kBlock; i += kLanes)
    hn::StoreU(exp_minus_wide(at_most_87(hn::LoadU(kWide, x + i))), kWide, result + i);
}

} // namespace HWY_NAMESPACE
} // namespace subsurface
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace subsurface {
const auto kAddDipoles = SL_BEST(add_dipoles);
const auto kExpMinus = SL_BEST(exp_minus);

void add_dipoles(const DipoleBlock& block, Vec3 x, const float* weight, DipoleSums& sums) {
  kAddDipoles(block, x, weight, sums);
}

void exp_minus(const float* x, float* result) {
  kExpMinus(x, result);
}

Color DipoleSums::total() const {
  Color sum;
  for (int c = 0; c < 3; ++c)
    for (float value : lane[c])
      sum[c] += value;
  return sum;
}

} // namespace subsurface
#endif
