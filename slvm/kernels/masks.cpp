// Lane masks against planes, compiled per target: what the interpreter does around kernels when lanes
// diverge.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/masks.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/wide.h"

#include "slvm/kernels/table.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

/// The mask of the kWidth lanes from `lane` on: a vector never straddles two words.
HWY_INLINE hn::Mask<FloatTag> lanes_of(const MaskWord* mask, size_t lane) {
  MaskWord bits = mask[lane / kMaskWordLanes] >> (lane % kMaskWordLanes);
  uint8_t bytes[sizeof(MaskWord)];
  for (size_t i = 0; i < sizeof(MaskWord); ++i)
    bytes[i] = static_cast<uint8_t>(bits >> (8 * i));
  return hn::LoadMaskBits(FloatTag(), bytes);
}

void mask_of_bools(MaskWord* mask, const float* bools, size_t lanes) {
  for (size_t word = 0; word < mask_words(lanes); ++word) {
    size_t begin = word * kMaskWordLanes, end = std::min(lanes, begin + kMaskWordLanes);
    MaskWord bits = 0;
    for (size_t lane = begin; lane < end; lane += kWidth) {
      uint8_t bytes[sizeof(MaskWord)] = {};
      hn::StoreMaskBits(FloatTag(), hn::MaskFromVec(hn::Load(FloatTag(), bools + lane)), bytes);
      bits |= MaskWord(bytes[0] | bytes[1] << 8) << (lane - begin);
    }
    mask[word] = bits;
  }
}

void bools_of_mask(float* bools, const MaskWord* mask, size_t lanes) {
  for (size_t lane = 0; lane < lanes; lane += kWidth)
    hn::Store(hn::VecFromMask(FloatTag(), lanes_of(mask, lane)), FloatTag(), bools + lane);
}

void blend(float* target, const float* source, uint32_t source_step, const MaskWord* mask, size_t lanes) {
  for (size_t lane = 0; lane < lanes; lane += kWidth) {
    auto value = hn::Load(FloatTag(), source + lane * source_step);
    hn::BlendedStore(value, lanes_of(mask, lane), FloatTag(), target + lane);
  }
}

void fill_masks(KernelTable& table) {
  table.width = kWidth;
  table.mask_of_bools = mask_of_bools;
  table.bools_of_mask = bools_of_mask;
  table.blend = blend;
}

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
