// Shadeops that work on the whole grid: functions named in the GRIDOP rows of shadeops.def.
// Read next: run.h (what they work on); derivatives.cpp, messages.cpp, print.cpp, spaces.cpp, lights.cpp.
#pragma once

#include "slvm/format/decode.h"
#include "slvm/wide/operand.h"

#include <span>

namespace slvm {

class ShaderRun;

/// One operand of a grid op: where its planes are, and what it is.
struct GridOperand {
  Operand planes;
  Type type = Type::kFloat;
  bool array = false;
  bool store = false;
};

/// A call: the stored operands first, then the read ones, as in operand.h.
struct GridCall {
  ShaderRun& run;
  const ShadeopInfo& info;
  std::span<const GridOperand> operands;
  uint32_t level; ///< of shadeops that differentiate: which mask tells the lanes that hold a value
  uint32_t code;  ///< word of the instruction, for messages
};

using GridOp = void (*)(const GridCall&);

#define SHADEOP(name, signature, kernel, flags, ulps, doc)
#define RSLOP(name, signature, flags, doc)
#define PENDING(name, signature, flags, doc)
namespace grid_ops {
#define GRIDOP(name, signature, function, flags, doc) void function(const GridCall&);
#include "slvm/format/shadeops.def"
#undef GRIDOP
/// What a PENDING row does where its shader runs all the same: its results are 0, and it says so.
void unserved(const GridCall&);
} // namespace grid_ops
#undef SHADEOP
#undef RSLOP
#undef PENDING

/// The function of a row, or nullptr when the row is no grid op.
GridOp grid_op(ShadeopId id);

} // namespace slvm
