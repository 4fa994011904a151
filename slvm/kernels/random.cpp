// Random numbers as functions of (seed of the grid, grid point, counter of the call): the same for any strip
// size, thread or order of grids.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/random.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"

#include "slvm/kernels/hash.h"
#include "slvm/kernels/rows.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

enum class Draw { kPerPoint, kPerGrid };

HWY_INLINE void put_unit(const Operand& result, size_t lane, Bits hash, Float*) {
  store(result, lane, unit_float(hash));
}
HWY_INLINE void put_unit(const Operand& result, size_t lane, Bits hash, Vec3*) {
  store(result, lane, unit_triple(hash));
}

/// Raw, for the context. `counter` is nullptr where the row has no counter.
template <class T, Draw kDraw>
HWY_INLINE void draw(const Operand& result, const Operand* counter, size_t lanes,
                     const KernelContext& context) {
  auto seed = static_cast<uint32_t>(context.seed), high = static_cast<uint32_t>(context.seed >> 32);
  Bits next_points = hn::Iota(BitsTag(), 1);
  for (size_t lane = context.begin; lane < lanes; lane += kWidth) {
    Bits hash(seed);
    if constexpr (kDraw == Draw::kPerPoint)
      hash = hash + next_points + Bits(context.first_point + static_cast<uint32_t>(lane));
    hash = mix_bits(hash) ^ Bits(high);
    if (counter != nullptr) hash = mix_bits(hash) + bits_of(loaded<Float>(*counter, lane) + 0.0f);
    put_unit(result, lane, mix_bits(hash), static_cast<T*>(nullptr));
  }
}

inline void random_f(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  draw<Float, Draw::kPerPoint>(o[0], nullptr, lanes, context);
}
inline void random_v(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  draw<Vec3, Draw::kPerPoint>(o[0], nullptr, lanes, context);
}
inline void randomgrid_f(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  draw<Float, Draw::kPerGrid>(o[0], nullptr, lanes, context);
}
inline void randomvarying_f(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  draw<Float, Draw::kPerPoint>(o[0], &o[1], lanes, context);
}
inline void randomvarying_v(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  draw<Vec3, Draw::kPerPoint>(o[0], &o[1], lanes, context);
}
inline void randomuniform_f(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  draw<Float, Draw::kPerGrid>(o[0], &o[1], lanes, context);
}
inline void randomuniform_v(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  draw<Vec3, Draw::kPerGrid>(o[0], &o[1], lanes, context);
}

#define SL_FAMILY fill_random
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
