// What a program's instructions refer to by number: constants, strings, arrays, imported shadeops. They enter
// the program as instructions ask for them.
#pragma once

#include "slvm/ir/emit_internal.h"

namespace slvm::ir {

class ProgramTables {
public:
  /// Gives the program the module's slots, parameters and arrays. Both must outlive this.
  ProgramTables(const Module& m, Program& p);

  /// Operand of a constant of the module.
  LowOperand constant(uint32_t index);
  /// Operand of a number.
  LowOperand number(float x);
  /// Opcode of a call of a shadeop, which is known to the module by `shadeop_id`.
  uint16_t import(uint32_t shadeop_id);

private:
  const Module& m_;
  Program& p_;
  std::vector<uint32_t> constant_words_; ///< by constant of the module: its operand; ~0: not in the program
};

} // namespace slvm::ir
