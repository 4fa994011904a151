// Copies that end a computation: in strip blocks, an instruction whose only use is a copy of its result
// stores to the copy's target itself. Where the target is still read in between, the instruction moves down
// to the copy.
#include "slvm/ir/emit_internal.h"

#include <algorithm>

namespace slvm::ir {
namespace {

bool is_control(const LowInst& inst) {
  auto op = static_cast<Opcode>(inst.opcode);
  bool plain = inst.opcode >= kFirstShadeop || op == Opcode::k_mov || op == Opcode::k_movm ||
               op == Opcode::k_aload || op == Opcode::k_astore || op == Opcode::k_astart ||
               op == Opcode::k_first;
  return !plain;
}

bool is_slot(const LowOperand& o) {
  return o.kind == LowOperand::Kind::kWord && operand_space(o.value) == Space::kSlot;
}

class Coalescer {
public:
  explicit Coalescer(LowCode& code) : code_(code), defs_(code.regs.size()), uses_(code.regs.size()) {}

  void run() {
    for (const LowInst& inst : code_.insts)
      for (uint32_t i = 0; i < inst.operands.size(); ++i)
        if (inst.operands[i].kind == LowOperand::Kind::kReg)
          ++(stores(inst, i) ? defs_ : uses_)[inst.operands[i].value];
    bool in_strip = false;
    uint32_t straight = 0; // first instruction since the last one of control flow
    for (uint32_t i = 0; i < code_.insts.size(); ++i) {
      auto op = static_cast<Opcode>(code_.insts[i].opcode);
      if (op == Opcode::k_strip) in_strip = true;
      if (op == Opcode::k_endstrip) in_strip = false;
      if (is_control(code_.insts[i]))
        straight = i + 1;
      else if (in_strip && op == Opcode::k_mov)
        try_copy(straight, i);
    }
  }

private:
  static bool stores(const LowInst& inst, uint32_t operand) {
    return operand >= inst.first_store && operand < inst.first_store + inst.stores;
  }

  void try_copy(uint32_t straight, uint32_t copy) {
    LowOperand to = code_.insts[copy].operands[1], from = code_.insts[copy].operands[2];
    if (from.kind != LowOperand::Kind::kReg || defs_[from.value] != 1 || uses_[from.value] != 1) return;
    const LowReg& source = code_.regs[from.value];
    if (to.kind == LowOperand::Kind::kReg ? code_.regs[to.value].varying != source.varying
                                          : !is_slot(to) || !source.varying)
      return;
    uint32_t def = copy;
    while (def-- > straight && !defines(code_.insts[def], from)) {
    }
    if (def + 1 <= straight) return; // not here: it was defined before a branch
    LowInst& inst = code_.insts[def];
    if (inst.opcode < kFirstShadeop || inst.stores != 1) return;
    bool move = false;
    for (uint32_t i = def + 1; i < copy; ++i)
      move |= refers_to(code_.insts[i], to);
    if (move && !can_move(def, copy)) return;
    inst.operands[inst.first_store] = to;
    if (move) {
      code_.insts[copy] = std::move(inst);
      code_.insts[def].removed = true;
      code_.insts[def].operands.clear();
      code_.insts[def].stores = 0;
    } else {
      code_.insts[copy].removed = true;
      code_.insts[copy].operands.clear();
      code_.insts[copy].stores = 0;
    }
  }

  static bool defines(const LowInst& inst, const LowOperand& reg) {
    return inst.stores == 1 && inst.operands[inst.first_store] == reg;
  }
  static bool refers_to(const LowInst& inst, const LowOperand& o) {
    return std::find(inst.operands.begin(), inst.operands.end(), o) != inst.operands.end();
  }

  /// Nothing up to `copy` stores to what the instruction reads. Two variables may be the same planes.
  bool can_move(uint32_t def, uint32_t copy) const {
    const LowInst& moved = code_.insts[def];
    bool reads_slot = std::any_of(moved.operands.begin(), moved.operands.end(), is_slot);
    for (uint32_t i = def + 1; i < copy; ++i) {
      const LowInst& passed = code_.insts[i];
      for (uint32_t k = 0; k < passed.operands.size(); ++k)
        if (stores(passed, k) &&
            (refers_to(moved, passed.operands[k]) || (reads_slot && is_slot(passed.operands[k]))))
          return false;
    }
    return true;
  }

  LowCode& code_;
  std::vector<uint32_t> defs_, uses_; // by register
};

} // namespace

void coalesce(LowCode& code) {
  Coalescer(code).run();
}

} // namespace slvm::ir
