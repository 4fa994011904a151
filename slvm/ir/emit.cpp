// Encoding: addresses, operand words, the line table.
#include "slvm/ir/emit.h"

#include "slvm/ir/emit_internal.h"

namespace slvm::ir {
namespace {

uint32_t encode_operand(const LowOperand& o, const LowCode& code, const std::vector<uint32_t>& address) {
  switch (o.kind) {
  case LowOperand::Kind::kWord: return o.value;
  case LowOperand::Kind::kTarget: return address[o.value];
  case LowOperand::Kind::kReg: return make_operand(code.regs[o.value].space, code.regs[o.value].index);
  }
  return 0;
}

} // namespace

void emit(const Module& m, Program& program) {
  program.imports.clear();
  program.slots.clear();
  program.constants.clear();
  program.strings.clear();
  program.string_constants.clear();
  program.arrays.clear();
  program.uniform_planes = program.strip_planes = program.grid_planes = 0;
  LowCode code = schedule(m, program);
  coalesce(code);
  allocate(code, program);
  program.mask_depth = code.mask_depth;
  program.files = m.files;
  program.code.clear();
  program.lines.clear();
  program.sections.clear();

  std::vector<uint32_t> address(code.insts.size());
  uint32_t at = 0;
  for (size_t i = 0; i < code.insts.size(); ++i) {
    address[i] = at;
    if (!code.insts[i].removed) at += 1 + static_cast<uint32_t>(code.insts[i].operands.size());
  }
  program.code.reserve(at);
  for (size_t i = 0; i < code.insts.size(); ++i) {
    const LowInst& inst = code.insts[i];
    if (inst.removed) continue;
    const SourceRange& where = inst.where;
    if (where.valid() &&
        (program.lines.empty() || program.lines.back().line != where.line ||
         program.lines.back().column != where.column || program.lines.back().file != where.file))
      program.lines.push_back({address[i], where.file, where.line, where.column});
    program.code.push_back(inst.opcode | static_cast<uint32_t>(inst.operands.size()) << 16);
    for (const LowOperand& o : inst.operands)
      program.code.push_back(encode_operand(o, code, address));
  }
  for (uint32_t section : code.sections)
    program.sections.push_back(address[section]);
}

} // namespace slvm::ir
