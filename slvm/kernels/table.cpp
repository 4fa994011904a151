// Assembles the kernel tables from the families, for each SIMD target of this build.
#include "slvm/kernels/table.h"

#include "slvm/kernels/strings.h"
#include "slvm/wide/targets.h"

#include <array>

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
    const int64_t supported = supported_targets();
    for (const Target& target : kTargets) {
      if ((supported & target.bit) == 0) continue;
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
