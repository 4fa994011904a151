// Calls kernels by row: makes operands from the row's signature, fills them with values, runs a target's
// kernel and hands back what it stored. Values are kept lane by lane here; planes, steps and alignment are
// the harness' business.
#pragma once

#include "slvm/format/shadeop_info.h"
#include "slvm/kernels/table.h"
#include "slvm/support/string_pool.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace slvm::test {

/// A row as tests name it: "smoothstep float(float min, float max, float x)".
std::string row_name(ShadeopId row);
/// All rows that have kernels.
std::vector<ShadeopId> kernel_rows();
/// The row with this name and signature; fails the test if there is none.
ShadeopId row_of(std::string_view name, std::string_view signature);

/// One operand: `elements` values of a type for each lane. bits[lane][element * components + component].
struct Value {
  Type type = Type::kFloat;
  uint32_t elements = 1;
  std::vector<std::vector<uint32_t>> bits;

  size_t planes() const { return size_t(components(type)) * elements; }
  float at(size_t lane, size_t plane = 0) const;
  void set(size_t lane, size_t plane, float value);
};

/// What a kernel reads, in operand order; must_be_uniform follows the signature.
struct Arguments {
  size_t lanes = 0;
  std::vector<Value> values;
  std::vector<bool> must_be_uniform;
};

/// Which values floats get.
enum class Values {
  kModerate, ///< -10 to 10, many of them integers or halves
  kEdges,    ///< zeros, infinities, NaN, denormals, huge and tiny numbers, too
};

/// Types of what a kernel stores.
std::vector<Type> stored_types(ShadeopId row);

/// Random arguments for a row; variadic parameters and arrays get `many` values. Lane 0's value is repeated
/// in all lanes of operands that must be uniform, and of those chosen by `uniform_set` (bit i: operand i).
Arguments make_arguments(ShadeopId row, size_t lanes, Values, std::mt19937&, StringPool&,
                         uint32_t uniform_set = 0);
inline constexpr uint32_t kManyKnots = 7;

struct CallOptions {
  /// Pass operands whose lanes must be equal, and those of this set, with step 0.
  uint32_t uniform_set = 0;
  /// Store over the planes of the first read operand of the same type.
  bool in_place = false;
  uint64_t seed = 1;
  uint32_t first_point = 0;
  size_t begin = 0; ///< lanes before it are not asked for
};

/// The stored values.
std::vector<Value> call(const KernelTable&, ShadeopId row, const Arguments&, StringPool&,
                        const CallOptions& = {});

/// Bits equal, any NaN equal to any other.
bool same_bits(uint32_t a, uint32_t b, Type);
/// Units in the last place between two floats; 0 for two NaN, huge for one.
double ulps_between(float a, float b);

/// One float in the first kMaxLanes lanes for a call of plain floats: call_floats("mod", "float(...)", {7,
/// 3})[0].
std::vector<float> call_floats(std::string_view name, std::string_view signature,
                               const std::vector<float>& flat);

} // namespace slvm::test
