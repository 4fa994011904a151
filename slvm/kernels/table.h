// Where kernels are found: one table per SIMD target, indexed by ShadeopId. Made on first use, constant
// afterwards. Read next: a family of kernels, math.cpp.
#pragma once

#include "slvm/format/shadeop_info.h"
#include "slvm/wide/mask.h"
#include "slvm/wide/operand.h"

#include <span>
#include <string_view>

namespace slvm {

/// Rows of shadeops.def.
inline constexpr size_t kShadeopCount = 0
#define SHADEOP(name, signature, kernel, flags, ulps, doc) +1
#define GRIDOP(name, signature, function, flags, doc) +1
#define RSLOP(name, signature, flags, doc) +1
#define PENDING(name, signature, flags, doc) +1
#include "slvm/format/shadeops.def"
#undef SHADEOP
#undef GRIDOP
#undef RSLOP
#undef PENDING
    ;

struct KernelTable {
  const char* target = nullptr; ///< "AVX3" (AVX-512), "AVX2", "SSE4", "NEON", "SCALAR" (the reference)
  size_t width = 0;             ///< lanes of one vector on this target

  /// nullptr for rows that are not kernels.
  Kernel kernel[kShadeopCount] = {};

  // Lane masks and planes (slvm/wide/mask.h). Planes are aligned; `lanes` is a multiple of kMaxLanes.
  /// mask = the lanes where a plane of bools holds.
  void (*mask_of_bools)(MaskWord* mask, const float* bools, size_t lanes) = nullptr;
  void (*bools_of_mask)(float* bools, const MaskWord* mask, size_t lanes) = nullptr;
  /// target[lane] = source[lane * source_step] in the lanes of the mask, for one plane. source_step is 0
  /// or 1.
  void (*blend)(float* target, const float* source, uint32_t source_step, const MaskWord* mask,
                size_t lanes) = nullptr;

  Kernel operator[](ShadeopId id) const { return kernel[id]; }
};

/// Names of the targets this machine can run, best first.
std::span<const char* const> kernel_targets();

/// The table for the best target.
const KernelTable& kernel_table();
/// The table for a target by name, in any case; nullptr if this machine or build does not have it.
const KernelTable* find_kernel_table(std::string_view target);

} // namespace slvm
