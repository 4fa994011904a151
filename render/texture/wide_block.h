// Vectors for blocks of lookups, as wide as the processor has lanes. Compiled once per SIMD target (Highway),
// hence the unusual guard.
#if defined(RENDER_TEXTURE_WIDE_BLOCK_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_TEXTURE_WIDE_BLOCK_H_
#undef RENDER_TEXTURE_WIDE_BLOCK_H_
#else
#define RENDER_TEXTURE_WIDE_BLOCK_H_
#endif

#include "render/texture/lookup_block.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, kLookupBlock> kWide;
constexpr hn::RebindToSigned<decltype(kWide)> kWideInt;
constexpr hn::RebindToUnsigned<decltype(kWide)> kWideBits;
constexpr size_t kLanes = hn::MaxLanes(kWide);
using V = hn::Vec<decltype(kWide)>;
using I = hn::Vec<decltype(kWideInt)>;

HWY_INLINE V number(float x) {
  return hn::Set(kWide, x);
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#endif
