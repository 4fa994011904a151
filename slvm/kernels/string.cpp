// Functions of strings (RISpec 3.2, 15.4). All are uniform: they run once for a grid and see ids and texts,
// no lanes; they are compiled per target all the same, so that the table is filled in one way.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/string.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"

#include "slvm/kernels/regex.h"
#include "slvm/kernels/rows.h"
#include "slvm/kernels/strings.h"

#include <string>

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

inline void concat_s(const Operand* operands, uint32_t count, size_t lanes, const KernelContext& context) {
  std::string text;
  for (uint32_t i = 1; i < count; ++i)
    text += string_operand(operands[i], context);
  store_string(operands[0], lanes, text, context);
}

inline void match_ss(const Operand* operands, uint32_t, size_t lanes, const KernelContext& context) {
  bool found = regex_found(string_operand(operands[1], context), string_operand(operands[2], context));
  for (size_t lane = 0; lane < lanes; lane += kWidth)
    store(operands[0], lane, Float(found ? 1.0f : 0.0f));
}

#define SL_FAMILY fill_string
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
