#include "slvm/kernels/draw_numbers.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/draw_numbers.cpp"
#include <hwy/foreach_target.h>

#include "slvm/support/sample_sequence.h"
#include "slvm/wide/targets.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

/// The compiler makes vectors of it (-O3).
void draw_all(uint32_t bits, const uint32_t* __restrict seeds, size_t count, float* __restrict out) {
  for (size_t i = 0; i < count; ++i)
    out[i] = scrambled(bits, seeds[i]);
}

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slvm {

const auto kDrawAll = SL_BEST(draw_all);

void draw_numbers(uint32_t bits, const uint32_t* seeds, size_t count, float* out) {
  kDrawAll(bits, seeds, count, out);
}

} // namespace slvm
#endif
