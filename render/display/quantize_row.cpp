// Loops that compilers turn into vectors, compiled for each processor.
#include "render/display/quantize_row.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/display/quantize_row.cpp"
#include <hwy/foreach_target.h>

#include "render/display/quantize.h"
#include "slvm/wide/targets.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

void hash_all(int x, int y, int group, std::span<uint64_t> hashes) {
  for (size_t k = 0; k < hashes.size(); ++k)
    hashes[k] = Quantizer::hash(x + static_cast<int>(k), y, group);
}

void quantize_all(const Quantizer& quantizer, std::span<const uint64_t> hashes, const float* values,
                  int* out) {
  const Quantizer quantize = quantizer; // of its own, for what is written to be nothing of it
  for (size_t k = 0; k < hashes.size(); ++k)
    out[k] = quantize.bits(hashes[k]);
  for (size_t k = 0; k < hashes.size(); ++k)
    out[k] = quantize(values[k], out[k]);
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
const auto kHash = SL_BEST(hash_all);
const auto kQuantize = SL_BEST(quantize_all);

void hash_row(int x, int y, int group, std::span<uint64_t> hashes) {
  kHash(x, y, group, hashes);
}

void quantize_row(const Quantization& q, int channel, std::span<const uint64_t> hashes, const float* values,
                  int* out) {
  kQuantize(Quantizer(q, channel), hashes, values, out);
}

} // namespace render
#endif
