// Scheduling: one instruction without regions.
#include "slvm/ir/scheduler.h"

#include <algorithm>

namespace slvm::ir {

namespace {

/// The mask that tells the lanes where both hold a value.
uint32_t common_level(uint32_t a, uint32_t b) {
  return std::max(a & ~kScatteredLevel, b & ~kScatteredLevel) | ((a | b) & kScatteredLevel);
}

} // namespace

void Scheduler::emit_inst(InstId id) {
  const Inst& inst = m_.insts[id];
  switch (inst.op) {
  case Op::kConstant: locations_[inst.results[0]] = tables_.constant(inst.index); break;
  case Op::kSlot: emit_slot(inst); break;
  case Op::kStore: emit_store(inst); break;
  case Op::kCall: emit_call(inst); break;
  case Op::kRetype:
    locations_[inst.results[0]] = use(inst.args[0]);
    level_[inst.results[0]] = level_[inst.args[0]];
    break;
  case Op::kArray: locations_[inst.results[0]] = word(make_operand(Space::kArray, inst.index)); break;
  case Op::kArrayClear:
    add(make(code_of(Opcode::k_astart), {word(make_operand(Space::kArray, inst.index))}, 0, 1));
    break;
  case Op::kArrayLoad: {
    level_[inst.results[0]] = depth();
    LowOperand subscript = use(inst.args[0]);
    auto planes = static_cast<uint32_t>(components(m_.type(inst.results[0])));
    add(make(
        code_of(Opcode::k_aload),
        {word(planes), define(inst.results[0]), word(make_operand(Space::kArray, inst.index)), subscript}, 1,
        1));
    break;
  }
  case Op::kArrayStore: {
    auto planes = static_cast<uint32_t>(components(m_.arrays[inst.index].type));
    add(make(
        code_of(Opcode::k_astore),
        {word(planes), word(make_operand(Space::kArray, inst.index)), use(inst.args[0]), use(inst.args[1])},
        1, 1));
    break;
  }
  case Op::kIf: emit_if(id); break;
  case Op::kLoop:
  case Op::kBlock: emit_loop(id); break;
  case Op::kIlluminance: emit_illuminance(id); break;
  case Op::kIlluminate:
  case Op::kSolar: emit_emitter(id); break;
  case Op::kGather: emit_gather(id); break;
  case Op::kBreak:
  case Op::kContinue: emit_exit(inst); break;
  case Op::kYield: emit_yield(inst); break;
  }
}

void Scheduler::emit_slot(const Inst& inst) {
  LowOperand slot = word(make_operand(Space::kSlot, inst.index));
  if (!m_.slots[inst.index].stored) {
    locations_[inst.results[0]] = slot;
    return;
  }
  // The variable is stored to somewhere: take its value now.
  auto planes = static_cast<uint32_t>(components(m_.type(inst.results[0])));
  add(make(code_of(Opcode::k_mov), {word(planes), define(inst.results[0]), slot}, 1, 1));
}

void Scheduler::emit_store(const Inst& inst) {
  const Slot& slot = m_.slots[inst.index];
  bool masked = slot.varying && mask_depth_ > 0;
  add(make(code_of(masked ? Opcode::k_movm : Opcode::k_mov),
           {word(static_cast<uint32_t>(components(slot.type))), word(make_operand(Space::kSlot, inst.index)),
            slot.varying ? use(inst.args[0]) : use_uniform(inst.args[0])},
           1, 1));
}

void Scheduler::emit_call(const Inst& inst) {
  const ShadeopInfo& info = m_.called(inst);
  const std::span<const ValueId> args(inst.args.data(),
                                      inst.op == Op::kGather ? fixed_args(inst) : inst.args.size());
  uint32_t level = 0;
  for (ValueId a : args)
    level = common_level(level, level_[a]);
  std::vector<LowOperand> reads, operands;
  const Signature& signature = info.signature;
  size_t positional = 0; // arguments before token-value pairs
  for (int i = 0; i < signature.param_count; ++i)
    positional += signature.param(i).input;
  int param = 0;
  for (size_t i = 0; i < args.size(); ++i, ++param) {
    while (param < signature.param_count && !signature.param(param).input)
      ++param;
    bool is_token_value = !signature.variadic() && i >= positional && (i - positional) % 2 == 1;
    bool is_positional = signature.variadic() || i < positional;
    if (is_token_value || (is_positional && signature.param(param).any))
      reads.push_back(word(static_cast<uint32_t>(m_.type(args[i]))));
    bool must_be_uniform = is_positional && signature.param(param).uniform;
    reads.push_back(must_be_uniform ? use_uniform(args[i]) : use(args[i]));
  }
  size_t result = 0;
  auto store = [&](bool any) {
    ValueId r = inst.results[result++];
    if (any) operands.push_back(word(static_cast<uint32_t>(m_.type(r))));
    // An array that a call stores to is one operand, written and read in place.
    operands.push_back(m_.values[r].array >= 0
                           ? word(make_operand(Space::kArray, static_cast<uint32_t>(m_.values[r].array)))
                           : define(r));
    const bool everywhere = info.flags & kDerivative && !(info.flags & (kTexture | kRays));
    level_[r] = info.kind == ShadeopKind::kKernel || everywhere ? level : depth();
    if (info.flags & kScattered) level_[r] |= kScatteredLevel;
  };
  if (signature.result != Type::kVoid) store(false);
  for (int i = 0; i < signature.param_count; ++i)
    if (signature.param(i).output) store(signature.param(i).any);
  uint32_t token_outputs = 0;
  for (; info.flags & kTokenOut && result < inst.results.size(); ++token_outputs)
    store(true);
  auto stores = static_cast<uint32_t>(operands.size());
  operands.insert(operands.end(), reads.begin(), reads.end());
  if (info.flags & kTokenOut) operands.push_back(word(token_outputs));
  if (info.flags & kDerivative) {
    operands.push_back(word(level));
    keep_strips_below(level & ~kScatteredLevel);
  }
  add(make(tables_.import(inst.index), std::move(operands), 0, stores));
}

void Scheduler::keep_strips_below(uint32_t level) {
  for (Level& l : levels_)
    if (l.depth > level)
      for (uint32_t strip : l.strips)
        out_.insts[strip].operands[1] = word(1);
}
} // namespace slvm::ir
