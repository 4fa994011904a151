// Instructions as operands with types: what verifier, disassembler and virtual machine read code with.
#pragma once

#include "slvm/format/program.h"

#include <span>
#include <vector>

namespace slvm {

/// One operand of a shadeop call.
struct CallOperand {
  uint32_t word = 0;
  Type type = Type::kFloat;
  bool store = false;
  bool array = false;    ///< must be an array operand
  bool uniform = false;  ///< must be uniform
  uint32_t elements = 0; ///< that the array must have; 0: any number
};

/// Of a mask level: what is differentiated came from a ray (kScattered), and neighbours' values say nothing
/// while rays are spread by chance.
inline constexpr uint32_t kScatteredLevel = 1u << 31;

/// Splits the operand words of a call: stored operands first, then read ones. `level`: the last word of
/// shadeops that differentiate, else 0. False: the words do not fit the shadeop's signature.
bool decode_call(const ShadeopInfo& info, std::span<const uint32_t> words, std::vector<CallOperand>& operands,
                 uint32_t& level);

constexpr uint16_t instruction_opcode(uint32_t head) {
  return static_cast<uint16_t>(head & 0xffff);
}
constexpr uint32_t instruction_words(uint32_t head) {
  return head >> 16;
}

} // namespace slvm
