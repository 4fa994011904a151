// What observers see of a step.
#include "slvm/exec/observer.h"

#include "slvm/exec/run.h"

#include <algorithm>

namespace slvm {

SourcePlace place_of(const Program& program, uint32_t code) {
  auto after = std::upper_bound(program.lines.begin(), program.lines.end(), code,
                                [](uint32_t c, const LineEntry& l) { return c < l.code; });
  if (after == program.lines.begin()) return {};
  const LineEntry& entry = *std::prev(after);
  return {entry.file < program.files.size() ? std::string_view(program.files[entry.file]) : "", entry.line,
          entry.column};
}

const Instance& ExecutionStep::instance() const {
  return run_.instance;
}

const Program& ExecutionStep::program() const {
  return run_.program;
}

const ShadeopInfo* ExecutionStep::call() const {
  const uint16_t opcode = instruction_opcode(run_.program.code[code_]);
  return opcode < kFirstShadeop ? nullptr : &shadeop(run_.program.imports[opcode - kFirstShadeop]);
}

std::vector<StepOperand> ExecutionStep::operands() const {
  const ShadeopInfo* info = call();
  if (!info) return {};
  const Program& program = run_.program;
  std::vector<CallOperand> decoded;
  uint32_t level = 0;
  decode_call(*info, {&program.code[code_ + 1], instruction_words(program.code[code_])}, decoded, level);
  std::vector<StepOperand> list;
  for (const CallOperand& o : decoded) {
    const Operand at = run_.operand(frame_, o.word);
    StepOperand& operand = list.emplace_back();
    operand.planes = {at.data, at.pitch, at.step, o.type, o.array ? at.elements : 0};
    operand.stored = o.store;
    uint32_t slot = operand_index(o.word);
    const bool array = operand_space(o.word) == Space::kArray;
    if (array) slot = program.arrays[slot].index;
    if (operand_space(o.word) == Space::kSlot ||
        (array && program.arrays[operand_index(o.word)].space == Space::kSlot))
      operand.variable = program.slots[slot].name;
  }
  return list;
}

size_t ExecutionStep::first_point() const {
  return frame_.first;
}

size_t ExecutionStep::points() const {
  return frame_.active;
}

std::span<const uint64_t> ExecutionStep::mask() const {
  return {mask_.current(), mask_.words()};
}

size_t ExecutionStep::active_points() const {
  return mask_count(mask_.current(), frame_.active);
}

const Grid& ExecutionStep::grid() const {
  return *run_.state.grid;
}

const StringPool& ExecutionStep::strings() const {
  return run_.state.machine.strings();
}

} // namespace slvm
