// Assembles the kernel tables from the families, for each SIMD target of this build.
#include "slvm/kernels/table.h"

#include "slvm/kernels/strings.h"

#include <array>

#include <hwy/highway.h>

// Runs of the list of families: X(function) for each. A new family is one line here and one in
// CMakeLists.txt.
#define SL_FAMILIES(X)                                                                                       \
  X(fill_color)                                                                                              \
  X(fill_compare)                                                                                            \
  X(fill_geometric)                                                                                          \
  X(fill_math)                                                                                               \
  X(fill_matrix)                                                                                             \
  X(fill_noise)                                                                                              \
  X(fill_random)                                                                                             \
  X(fill_spline)                                                                                             \
  X(fill_string)

// Runs of the list of targets: X(target, namespace, name) for each this build has code for.
#if HWY_TARGETS & HWY_AVX3
#define SL_AVX3(X) X(HWY_AVX3, N_AVX3, "AVX3")
#else
#define SL_AVX3(X)
#endif
#if HWY_TARGETS & HWY_AVX2
#define SL_AVX2(X) X(HWY_AVX2, N_AVX2, "AVX2")
#else
#define SL_AVX2(X)
#endif
#if HWY_TARGETS & HWY_SSE4
#define SL_SSE4(X) X(HWY_SSE4, N_SSE4, "SSE4")
#else
#define SL_SSE4(X)
#endif
#if HWY_TARGETS & HWY_NEON
#define SL_NEON(X) X(HWY_NEON, N_NEON, "NEON")
#else
#define SL_NEON(X)
#endif
#if HWY_TARGETS & HWY_EMU128
#define SL_EMU128(X) X(HWY_EMU128, N_EMU128, "EMU128")
#else
#define SL_EMU128(X)
#endif
#if HWY_TARGETS & HWY_SCALAR
#define SL_SCALAR(X) X(HWY_SCALAR, N_SCALAR, "SCALAR")
#else
#define SL_SCALAR(X)
#endif
#define SL_TARGETS(X) SL_AVX3(X) SL_AVX2(X) SL_SSE4(X) SL_NEON(X) SL_EMU128(X) SL_SCALAR(X)

namespace slvm {

#define SL_DECLARE_FAMILY(function) void function(Kernel* table);
#define SL_DECLARE(target, namespace_name, name)                                                             \
  namespace namespace_name {                                                                                 \
  SL_FAMILIES(SL_DECLARE_FAMILY)                                                                             \
  void fill_masks(KernelTable& table);                                                                       \
  }
SL_TARGETS(SL_DECLARE)

namespace {

struct Target {
  int64_t bit;
  const char* name;
  void (*fill)(KernelTable& table);
};

#define SL_FILL_FAMILY(function) function(table.kernel);
#define SL_TARGET_ROW(target, namespace_name, name)                                                          \
  Target{target, name, [](KernelTable& table) {                                                              \
           using namespace namespace_name;                                                                   \
           SL_FAMILIES(SL_FILL_FAMILY)                                                                       \
           fill_masks(table);                                                                                \
         }},
constexpr Target kTargets[] = {SL_TARGETS(SL_TARGET_ROW)};
constexpr size_t kTargetCount = std::size(kTargets);

/// The tables of the targets this machine can run, best first.
struct Tables {
  size_t count = 0;
  std::array<KernelTable, kTargetCount> table{};
  std::array<const char*, kTargetCount> name{};

  Tables() {
    for (const Target& target : kTargets) {
      if ((hwy::SupportedTargets() & target.bit) == 0) continue;
      target.fill(table[count]);
      table[count].target = name[count] = target.name;
      ++count;
    }
  }
};

const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

} // namespace

std::span<const char* const> kernel_targets() {
  return {tables().name.data(), tables().count};
}

const KernelTable& kernel_table() {
  return tables().table[0];
}

const KernelTable* find_kernel_table(std::string_view target) {
  for (size_t i = 0; i < tables().count; ++i)
    if (same_letters(tables().name[i], target)) return &tables().table[i];
  return nullptr;
}

} // namespace slvm
