// Transcendental functions of Float, by SLEEF 3.5 (https://sleef.org): its deterministic variants, whose
// results are the same bits for every vector width. AVX2 and AVX-512 share those with fused multiply-add
// ("finz"), SSE4 and the emulated target those without ("cinz"). All take any argument, NaN and infinities
// included.
#if defined(SLVM_WIDE_TRANSCENDENTAL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SLVM_WIDE_TRANSCENDENTAL_H_
#undef SLVM_WIDE_TRANSCENDENTAL_H_
#else
#define SLVM_WIDE_TRANSCENDENTAL_H_
#endif

#include "slvm/wide/wide.h"

#if HWY_TARGET == HWY_AVX3
#define SL_SLEEF(name, ulp) Sleef_finz_##name##f16_##ulp##avx512f
#define SL_SLEEF_VECTOR __m512
#elif HWY_TARGET == HWY_AVX2
#define SL_SLEEF(name, ulp) Sleef_finz_##name##f8_##ulp##avx2
#define SL_SLEEF_VECTOR __m256
#elif HWY_TARGET == HWY_SSE4
#define SL_SLEEF(name, ulp) Sleef_cinz_##name##f4_##ulp##sse4
#define SL_SLEEF_VECTOR __m128
#else
#define SL_SLEEF(name, ulp) Sleef_cinz_##name##f1_##ulp##purec
#define SL_SLEEF_VECTOR float
#endif

HWY_BEFORE_NAMESPACE();

// Declared here, as sleef.h hides the variants that the command line's instruction set does not include.
#define SL_SLEEF_UNARY(name, ulp) extern "C" SL_SLEEF_VECTOR SL_SLEEF(name, ulp)(SL_SLEEF_VECTOR);
#define SL_SLEEF_BINARY(name, ulp)                                                                           \
  extern "C" SL_SLEEF_VECTOR SL_SLEEF(name, ulp)(SL_SLEEF_VECTOR, SL_SLEEF_VECTOR);
SL_SLEEF_UNARY(sin, u10)
SL_SLEEF_UNARY(cos, u10)
SL_SLEEF_UNARY(tan, u10)
SL_SLEEF_UNARY(asin, u10)
SL_SLEEF_UNARY(acos, u10)
SL_SLEEF_UNARY(atan, u10)
SL_SLEEF_UNARY(exp, u10)
SL_SLEEF_UNARY(log, u10)
SL_SLEEF_UNARY(erf, u10)
SL_SLEEF_UNARY(erfc, u15)
SL_SLEEF_BINARY(atan2, u10)
SL_SLEEF_BINARY(pow, u10)
#undef SL_SLEEF_UNARY
#undef SL_SLEEF_BINARY

namespace slvm {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4
template <auto kFunction, class... A> HWY_INLINE Float call_sleef(A... a) {
  return hn::Vec<FloatTag>{kFunction(a.v.raw...)};
}
#else
template <auto kFunction, class... A> HWY_INLINE Float call_sleef(A... a) {
  HWY_ALIGN float results[kWidth];
  for (size_t i = 0; i < kWidth; ++i)
    results[i] = kFunction(hn::ExtractLane(a.v, i)...);
  return hn::Load(FloatTag(), results);
}
#endif

// The greatest error, in units in the last place, is 1.0; that of erfc 1.5.
HWY_INLINE Float sin(Float a) {
  return call_sleef<SL_SLEEF(sin, u10)>(a);
}
HWY_INLINE Float cos(Float a) {
  return call_sleef<SL_SLEEF(cos, u10)>(a);
}
HWY_INLINE Float tan(Float a) {
  return call_sleef<SL_SLEEF(tan, u10)>(a);
}
HWY_INLINE Float asin(Float a) {
  return call_sleef<SL_SLEEF(asin, u10)>(a);
}
HWY_INLINE Float acos(Float a) {
  return call_sleef<SL_SLEEF(acos, u10)>(a);
}
HWY_INLINE Float atan(Float a) {
  return call_sleef<SL_SLEEF(atan, u10)>(a);
}
HWY_INLINE Float atan2(Float y, Float x) {
  return call_sleef<SL_SLEEF(atan2, u10)>(y, x);
}
HWY_INLINE Float exp(Float a) {
  return call_sleef<SL_SLEEF(exp, u10)>(a);
}
HWY_INLINE Float log(Float a) {
  return call_sleef<SL_SLEEF(log, u10)>(a);
}
HWY_INLINE Float pow(Float x, Float y) {
  return call_sleef<SL_SLEEF(pow, u10)>(x, y);
}
HWY_INLINE Float erf(Float a) {
  return call_sleef<SL_SLEEF(erf, u10)>(a);
}
HWY_INLINE Float erfc(Float a) {
  return call_sleef<SL_SLEEF(erfc, u15)>(a);
}

} // namespace HWY_NAMESPACE
} // namespace slvm
#undef SL_SLEEF
#undef SL_SLEEF_VECTOR
HWY_AFTER_NAMESPACE();

#endif // per-target guard
