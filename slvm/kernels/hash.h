// Integer hashes of wide bits: what noise and random numbers are made from. No tables, no period.
#if defined(SLVM_KERNELS_HASH_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SLVM_KERNELS_HASH_H_
#undef SLVM_KERNELS_HASH_H_
#else
#define SLVM_KERNELS_HASH_H_
#endif

#include "slvm/wide/wide.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

/// A bijection of 32 bits in which every input bit changes every output bit with a probability near one half
/// (constants found by C. Wellons' search, "Prospecting for Hash Functions", 2018).
HWY_INLINE Bits mix_bits(Bits h) {
  h = (h ^ shift_right<16>(h)) * Bits(0x21f0aaadu);
  h = (h ^ shift_right<15>(h)) * Bits(0x735a2d97u);
  return h ^ shift_right<15>(h);
}

/// Uniform in [0, 1), a multiple of 2^-24.
HWY_INLINE Float unit_float(Bits h) {
  return from_int(shift_right<8>(h)) * 0x1p-24f;
}

/// A different hash for each component of a triple, from one well-mixed hash.
HWY_INLINE Vec3 unit_triple(Bits h) {
  return {unit_float(h), unit_float(mix_bits(h + Bits(0x9e3779b9u))),
          unit_float(mix_bits(h + Bits(0x3c6ef372u)))};
}

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();

#endif // per-target guard
