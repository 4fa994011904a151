// Arithmetic of floats and the mathematical functions (RISpec 3.2, 15.1). One function of wide values each;
// strip loops and operands are in slvm/wide/lanes.h. Errors are in units in the last place (ulp) and hold on
// the whole domain unless a comment says otherwise; a function without a comment is exact or rounds once in
// each operation it shows.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/math.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"
#include "slvm/wide/transcendental.h"

#include "slvm/kernels/rows.h"

#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

// ---- Operators
inline Float add_ff(Float a, Float b) {
  return a + b;
}
inline Float sub_ff(Float a, Float b) {
  return a - b;
}
inline Float mul_ff(Float a, Float b) {
  return a * b;
}
inline Float muladd_fff(Float a, Float b, Float c) {
  return a * b + c;
}
inline Float div_ff(Float a, Float b) {
  return a / b;
}
inline Float neg_f(Float a) {
  return -a;
}

// ---- Angles: 1 ulp, the conversions of units 1.5
inline Float radians_f(Float degrees) {
  return degrees * (std::numbers::pi_v<float> / 180.0f);
}
inline Float degrees_f(Float radians) {
  return radians * (180.0f / std::numbers::pi_v<float>);
}
inline Float sin_f(Float a) {
  return sin(a);
}
inline Float cos_f(Float a) {
  return cos(a);
}
inline Float tan_f(Float a) {
  return tan(a);
}
inline Float asin_f(Float a) {
  return asin(clamp(a, -1.0f, 1.0f));
}
inline Float acos_f(Float a) {
  return acos(clamp(a, -1.0f, 1.0f));
}
inline Float atan_f(Float yoverx) {
  return atan(yoverx);
}
inline Float atan_ff(Float y, Float x) {
  return atan2(y, x);
}

// ---- Powers: 1 ulp unless said otherwise
/// pow(0, 0) is 1. Where no real number is the answer (x < 0, y not an integer) it is 0. Squares and roots
/// are rounded once, as the optimiser's x * x and sqrt(x) are (slvm/ir/passes/strength.cpp).
inline Float pow_ff(Float x, Float y) {
  Float power = select(y == 2.0f, x * x, select(y == 0.5f, sqrt(x), pow(x, y)));
  return zero_if((x < 0.0f) & (y != floor(y)), power);
}
inline Float exp_f(Float x) {
  return exp(x);
}
/// -inf at 0, NaN below.
inline Float log_f(Float x) {
  return log(x);
}
/// 3 ulp.
inline Float log_ff(Float x, Float base) {
  return log(x) / log(base);
}
/// Rounds once. 0 where x is negative.
inline Float sqrt_f(Float x) {
  return zero_if(x < 0.0f, sqrt(x));
}
/// 1.5 ulp. 0 where x is zero or negative, so that no infinity spreads.
inline Float inversesqrt_f(Float x) {
  return keep_if(x > 0.0f, 1.0f / sqrt(x));
}
inline Float erf_f(Float x) {
  return erf(x);
}
/// 1.5 ulp.
inline Float erfc_f(Float x) {
  return erfc(x);
}

// ---- Pieces of numbers
/// a - b*floor(a/b), the two roundings mended where they leave [0, b) or, with a negative b, (b, 0].
inline Float mod_ff(Float a, Float b) {
  Float r = a - b * floor(a / b);
  Float wrapped = select((r < 0.0f) != (b < 0.0f), r + b, r);
  Float inside = select(r == 0.0f, r, wrapped);
  return zero_if(abs(inside) >= abs(b), inside);
}
inline Float abs_f(Float x) {
  return abs(x);
}
inline Float sign_f(Float x) {
  return keep_if(x > 0.0f, 1.0f) - keep_if(x < 0.0f, 1.0f);
}
inline Float floor_f(Float x) {
  return floor(x);
}
inline Float ceil_f(Float x) {
  return ceil(x);
}
/// The fraction is exact, so that halves and only halves are at the border; they go up.
inline Float round_f(Float x) {
  Float below = floor(x);
  return select(x - below >= 0.5f, below + 1.0f, below);
}

// ---- Choice and blending
inline Float min_ff(Float a, Float b) {
  return min(a, b);
}
inline Float max_ff(Float a, Float b) {
  return max(a, b);
}
inline Float clamp_fff(Float a, Float lo, Float hi) {
  return clamp(a, lo, hi);
}
inline Float mix_fff(Float a, Float b, Float t) {
  return (1.0f - t) * a + t * b;
}
inline Float step_ff(Float edge, Float x) {
  return zero_if(x < edge, 1.0f);
}

/// 0 below lo, 1 at or above hi, else the cubic 3y^2 - 2y^3 with y = (x - lo)/(hi - lo).
inline Float smoothstep_fff(Float lo, Float hi, Float x) {
  Float y = (x - lo) / (hi - lo);
  Float cubic = y * y * (3.0f - 2.0f * y);
  return select(x < lo, 0.0f, select(x >= hi, 1.0f, cubic));
}

#define SL_FAMILY fill_math
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
