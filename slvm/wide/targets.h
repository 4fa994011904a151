// Which SIMD targets there is code for, and which of them this machine can run. Highway has that in its
// library, too; but the shared library of 1.0 measures its clock for 4 ms whenever it is loaded, which is
// longer than a small picture takes. Of Highway only headers are used.
#pragma once

#include <hwy/detect_targets.h>

#include <cstdint>
#include <initializer_list>

// Runs of the list of targets, best first: X(target, namespace, name, arguments...) for each this build has
// code for.
#if HWY_TARGETS & HWY_AVX3
#define SL_AVX3(X, ...) X(HWY_AVX3, N_AVX3, "AVX3" __VA_OPT__(, ) __VA_ARGS__)
#else
#define SL_AVX3(X, ...)
#endif
#if HWY_TARGETS & HWY_AVX2
#define SL_AVX2(X, ...) X(HWY_AVX2, N_AVX2, "AVX2" __VA_OPT__(, ) __VA_ARGS__)
#else
#define SL_AVX2(X, ...)
#endif
#if HWY_TARGETS & HWY_SSE4
#define SL_SSE4(X, ...) X(HWY_SSE4, N_SSE4, "SSE4" __VA_OPT__(, ) __VA_ARGS__)
#else
#define SL_SSE4(X, ...)
#endif
#if HWY_TARGETS & HWY_NEON
#define SL_NEON(X, ...) X(HWY_NEON, N_NEON, "NEON" __VA_OPT__(, ) __VA_ARGS__)
#else
#define SL_NEON(X, ...)
#endif
#if HWY_TARGETS & HWY_EMU128
#define SL_EMU128(X, ...) X(HWY_EMU128, N_EMU128, "EMU128" __VA_OPT__(, ) __VA_ARGS__)
#else
#define SL_EMU128(X, ...)
#endif
#if HWY_TARGETS & HWY_SCALAR
#define SL_SCALAR(X, ...) X(HWY_SCALAR, N_SCALAR, "SCALAR" __VA_OPT__(, ) __VA_ARGS__)
#else
#define SL_SCALAR(X, ...)
#endif
#define SL_TARGETS(X, ...)                                                                                   \
  SL_AVX3(X, __VA_ARGS__)                                                                                    \
  SL_AVX2(X, __VA_ARGS__)                                                                                    \
  SL_SSE4(X, __VA_ARGS__) SL_NEON(X, __VA_ARGS__) SL_EMU128(X, __VA_ARGS__) SL_SCALAR(X, __VA_ARGS__)

namespace slvm {

/// Bits of the targets whose instructions this machine has.
inline int64_t supported_targets() {
  int64_t out = HWY_STATIC_TARGET | HWY_EMU128 | HWY_SCALAR;
#if HWY_ARCH_X86
  __builtin_cpu_init(); // for callers that run before main()
  // What Highway compiles each target for; those of one generation of processors are tested by their newest.
  const bool sse4 =
      __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi2");
  const bool avx3 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512dq");
  out |= (sse4 ? HWY_SSE4 : 0) | (avx2 ? HWY_AVX2 : 0) | (avx3 ? HWY_AVX3 : 0);
#endif
  return out;
}

template <class Function> struct ForTarget {
  int64_t target;
  Function* function;
};

/// Of functions, best first, the first that this machine can run.
template <class Function> Function* best_of(std::initializer_list<ForTarget<Function>> functions) {
  const int64_t supported = supported_targets();
  for (const auto& f : functions)
    if (supported & f.target) return f.function;
  return functions.end()[-1].function;
}

} // namespace slvm

/// The one to call of a function that is compiled for all targets (hwy/foreach_target.h). For use after
/// HWY_ONCE, to initialise a constant.
#define SL_BEST(function)                                                                                    \
  slvm::best_of<decltype(HWY_NAMESPACE::function)>({SL_TARGETS(SL_BEST_ROW, function)})
#define SL_BEST_ROW(target, name_space, name, function) {target, &name_space::function},
