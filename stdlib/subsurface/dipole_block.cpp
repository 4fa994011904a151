#include "stdlib/subsurface/dipole_block.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace subsurface {
namespace {

/// Where exp(-x) is no longer told from 0. Numbers that are not negative compare like their bits, NaN as the
/// largest; compilers do not make vectors of comparisons of floats, which may trap.
constexpr float kMost = 87.0f;
inline float bounded(float x) {
  return std::bit_cast<float>(
      std::min(std::bit_cast<int32_t>(kMost), std::bit_cast<int32_t>(x) & 0x7fffffff));
}

/// exp(-x) = 2^-n exp(-f) with n = round(x/log 2), |f| <= log(2)/2; the polynomial is Taylor's, whose next
/// term is below 4e-8 there. Without branches, for 0 <= x <= kMost.
inline float exp_minus_bounded(float x) {
  constexpr float kLog2e = 1.44269504f, kRound = 12582912.0f; // 1.5 2^23: adding it rounds
  constexpr float kLn2High = 0.693145752f, kLn2Low = 1.42860677e-6f;
  const float shifted = x * kLog2e + kRound, n = shifted - kRound;
  const float f = n * kLn2High - x + n * kLn2Low;
  float p = 1.0f / 5040;
  p = p * f + 1.0f / 720;
  p = p * f + 1.0f / 120;
  p = p * f + 1.0f / 24;
  p = p * f + 1.0f / 6;
  p = p * f + 0.5f;
  p = p * f + 1;
  p = p * f + 1;
  return std::bit_cast<float>(std::bit_cast<uint32_t>(p) - (std::bit_cast<uint32_t>(shifted) << 23));
}

inline float source(float distance2, float transport, float z) {
  const float d2 = distance2 + z * z, d = std::sqrt(d2), reach = bounded(transport * d);
  return z * (1 + reach) * exp_minus_bounded(reach) / (d2 * d);
}

} // namespace

float exp_minus(float x) {
  return exp_minus_bounded(bounded(x));
}

void add_dipoles(const float* __restrict distance2, const float* __restrict flux, const DipoleLanes& lanes,
                 float* __restrict sum) {
  for (size_t i = 0; i < kBlock; ++i)
    sum[i] += flux[i] * lanes.gain[i] *
              (source(distance2[i], lanes.transport[i], lanes.z_real[i]) +
               source(distance2[i], lanes.transport[i], lanes.z_virtual[i]));
}

void add_dipoles(const float* __restrict distance2, const float* __restrict flux, float gain, float transport,
                 float z_real, float z_virtual, float* __restrict sum) {
  for (size_t i = 0; i < kBlock; ++i)
    sum[i] += flux[i] * gain *
              (source(distance2[i], transport, z_real) + source(distance2[i], transport, z_virtual));
}

} // namespace subsurface
