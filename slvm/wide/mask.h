// Lane masks: one bit per lane in 64-bit words, lane 0 in the lowest bit of word 0. Bits at and above the
// lane count are 0. The operations here are on whole masks; those that touch lanes of planes are compiled per
// target and found in slvm/kernels/table.h (mask_of_bools, bools_of_mask, blend).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace slvm {

using MaskWord = uint64_t;
inline constexpr size_t kMaskWordLanes = 64;

constexpr size_t mask_words(size_t lanes) {
  return (lanes + kMaskWordLanes - 1) / kMaskWordLanes;
}

/// The word `word` of a mask of `lanes` lanes that are all on.
constexpr MaskWord full_mask_word(size_t word, size_t lanes) {
  size_t begin = word * kMaskWordLanes;
  if (lanes <= begin) return 0;
  return lanes - begin >= kMaskWordLanes ? ~MaskWord{0} : (MaskWord{1} << (lanes - begin)) - 1;
}

inline void mask_set_all(MaskWord* mask, size_t lanes) {
  for (size_t i = 0; i < mask_words(lanes); ++i)
    mask[i] = full_mask_word(i, lanes);
}
inline void mask_clear(MaskWord* mask, size_t lanes) {
  std::fill_n(mask, mask_words(lanes), MaskWord{0});
}

inline bool mask_all(const MaskWord* mask, size_t lanes) {
  for (size_t i = 0; i < mask_words(lanes); ++i)
    if (mask[i] != full_mask_word(i, lanes)) return false;
  return true;
}
inline bool mask_any(const MaskWord* mask, size_t lanes) {
  MaskWord bits = 0;
  for (size_t i = 0; i < mask_words(lanes); ++i)
    bits |= mask[i];
  return bits != 0;
}
inline bool mask_none(const MaskWord* mask, size_t lanes) {
  return !mask_any(mask, lanes);
}

inline void mask_and(MaskWord* out, const MaskWord* a, const MaskWord* b, size_t lanes) {
  for (size_t i = 0; i < mask_words(lanes); ++i)
    out[i] = a[i] & b[i];
}
/// a and not b.
inline void mask_andnot(MaskWord* out, const MaskWord* a, const MaskWord* b, size_t lanes) {
  for (size_t i = 0; i < mask_words(lanes); ++i)
    out[i] = a[i] & ~b[i];
}
inline void mask_or(MaskWord* out, const MaskWord* a, const MaskWord* b, size_t lanes) {
  for (size_t i = 0; i < mask_words(lanes); ++i)
    out[i] = a[i] | b[i];
}

inline size_t mask_count(const MaskWord* mask, size_t lanes) {
  size_t count = 0;
  for (size_t i = 0; i < mask_words(lanes); ++i)
    count += static_cast<size_t>(std::popcount(mask[i]));
  return count;
}
constexpr bool mask_test(const MaskWord* mask, size_t lane) {
  return (mask[lane / kMaskWordLanes] >> (lane % kMaskWordLanes) & 1) != 0;
}
/// Calls visit(lane) for every lane that is on, in order.
template <class Visitor> void mask_for_each(const MaskWord* mask, size_t lanes, Visitor&& visit) {
  for (size_t i = 0; i < mask_words(lanes); ++i)
    for (MaskWord bits = mask[i]; bits != 0; bits &= bits - 1)
      visit(i * kMaskWordLanes + static_cast<size_t>(std::countr_zero(bits)));
}

} // namespace slvm
