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
  return opcode < kFirstShadeop ? nullptr
                                : &run_.program.plugins.info(run_.program.imports[opcode - kFirstShadeop]);
}

StepOperand ExecutionStep::operand_of(uint32_t word) const {
  const Program& program = run_.program;
  const Operand at = run_.operand(frame_, word);
  StepOperand operand;
  operand.planes = {at.data, at.pitch, at.step, Type::kFloat, 0};
  uint32_t slot = operand_index(word);
  bool external = operand_space(word) == Space::kSlot;
  if (operand_space(word) == Space::kArray) {
    const ArrayInfo& array = program.arrays[operand_index(word)];
    operand.planes.type = array.type;
    operand.planes.elements = array.elements;
    external = array.space == Space::kSlot;
    slot = array.index;
  }
  if (external) operand.variable = program.slots[slot].name;
  return operand;
}

std::vector<StepOperand> ExecutionStep::operands() const {
  const Program& program = run_.program;
  const uint32_t *head = &program.code[code_], *words = head + 1;
  std::vector<StepOperand> list;
  const ShadeopInfo* info = call();
  if (!info) {
    if (static_cast<Opcode>(instruction_opcode(*head)) != Opcode::k_aload) return list;
    list.push_back(operand_of(words[1]));
    list.back().planes.elements = words[0];
    list.back().stored = true;
    list.push_back(operand_of(words[2]));
    return list;
  }
  std::vector<CallOperand> decoded;
  uint32_t level = 0;
  decode_call(*info, {words, instruction_words(*head)}, decoded, level);
  for (const CallOperand& o : decoded) {
    list.push_back(operand_of(o.word));
    list.back().planes.type = o.type;
    list.back().stored = o.store;
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
