// Shared by the steps of emission: schedule.cpp makes a list of instructions on virtual registers (grid
// level, strip blocks, masked copies at merges), coalesce.cpp saves copies, allocate.cpp gives the registers
// planes, emit.cpp encodes.
#pragma once

#include "slvm/ir/ir.h"

namespace slvm::ir {

/// An operand before allocation: a final operand word, or a virtual register.
struct LowOperand {
  enum class Kind : uint8_t {
    kWord,   ///< final: a constant, slot or array operand, or a plain number
    kReg,    ///< virtual register, as index into LowCode::regs
    kTarget, ///< jump target, as index into LowCode::insts; the address of that instruction
  };
  Kind kind = Kind::kWord;
  uint32_t value = 0;
  bool operator==(const LowOperand&) const = default;
};

constexpr LowOperand word(uint32_t w) {
  return {LowOperand::Kind::kWord, w};
}
constexpr LowOperand target(uint32_t index) {
  return {LowOperand::Kind::kTarget, index};
}

struct LowInst {
  uint16_t opcode = 0;
  uint32_t stores =
      0; ///< how many operands, from `first_store` on, are stored to (registers, variables, arrays)
  uint32_t first_store = 0;
  std::vector<LowOperand> operands;
  SourceRange where;
  /// Registers that are live from here on though nothing is stored yet: results of a block, which lanes store
  /// to in different rounds of loops inside it.
  std::vector<uint32_t> begins;
  bool removed = false; ///< a copy that proved superfluous
};

/// A virtual register: `planes` consecutive planes.
struct LowReg {
  uint32_t planes = 1;
  bool varying = false;
  // Filled in by allocation:
  Space space = Space::kUniform;
  uint32_t index = 0;
  uint32_t first = ~0u, last = 0; ///< live from and to, as indices of instructions
  int32_t block = -1;             ///< the strip block all references are in; -2: several, or grid level
};

struct LowCode {
  std::vector<LowInst> insts;
  std::vector<LowReg> regs;
  std::vector<uint32_t> sections;                   ///< indices of instructions
  std::vector<std::pair<uint32_t, uint32_t>> loops; ///< begin and end instruction of every loop
  uint32_t mask_depth = 0;
};

/// Fills imports, slots, constants, strings and arrays of the program on the way.
LowCode schedule(const Module& m, Program& program);
/// Computes results where copies would have brought them.
void coalesce(LowCode& code);
/// Gives every register a space and planes; sets the program's plane counts.
void allocate(LowCode& code, Program& program);

} // namespace slvm::ir
