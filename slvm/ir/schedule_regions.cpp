// Scheduling: ifs, loops, light blocks, and the ways out of them.
#include "slvm/ir/scheduler.h"

#include "slvm/ir/region_queries.h"

namespace slvm::ir {

void Scheduler::close(uint32_t end) {
  for (Patch p : ends_.back())
    out_.insts[p.inst].operands[p.operand] = target(end);
  ends_.pop_back();
}

void Scheduler::emit_region(const Region& region) {
  for (InstId id : region.body)
    place(id);
  flush();
}

void Scheduler::open_mask() {
  ++mask_depth_;
  out_.mask_depth = std::max(out_.mask_depth, mask_depth_);
  if (in_strip_) return;
  ++grid_depth_;
  levels_.push_back({grid_depth_, {}});
}

void Scheduler::close_mask() {
  --mask_depth_;
  if (in_strip_) return;
  --grid_depth_;
  levels_.pop_back();
}

void Scheduler::emit_section(const Region& region, const Param* param) {
  ends_.push_back({});
  init_param_ = param;
  emit_region(region);
  close(add(Opcode::k_end, {}));
}

std::vector<LowOperand> Scheduler::define_results(const Inst& inst) {
  std::vector<LowOperand> regs;
  for (ValueId r : inst.results) {
    regs.push_back(define(r));
    level_[r] = depth();
  }
  return regs;
}

bool Scheduler::emit_while(const Inst& inst) {
  if (frames_.empty() || frames_.back().inst->op != Op::kLoop || !inst.results.empty()) return false;
  const Inst& else_end = m_.insts[inst.regions[1].body.back()];
  if (inst.regions[0].body.size() != 1 || m_.insts[inst.regions[0].body[0]].op != Op::kYield) return false;
  if (inst.regions[1].body.size() != 1 || else_end.op != Op::kBreak || else_end.index != 0) return false;
  for (size_t i = 0; i < else_end.args.size(); ++i)
    if (used_[frames_.back().inst->results[i]] && use(else_end.args[i]) != frames_.back().merge[i])
      return false;
  bool varying = m_.varying(inst.args[0]);
  uint32_t at = add(varying ? Opcode::k_while : Opcode::k_uwhile, {use(inst.args[0]), target(0)});
  jump_to_end(at, 1);
  return true;
}

void Scheduler::emit_if(InstId id) {
  const Inst& inst = m_.insts[id];
  if (emit_while(inst)) return;
  bool varying = m_.varying(inst.args[0]);
  LowOperand condition = use(inst.args[0]);
  frames_.push_back({&inst, define_results(inst)});
  for (ValueId r : inst.results)
    level_[r] |= level_[inst.args[0]] & kScatteredLevel;
  uint32_t begin = add(varying ? Opcode::k_if : Opcode::k_uif, {condition, target(0)});
  if (varying) open_mask();
  ends_.push_back({});
  emit_region(inst.regions[0]);
  const Region& other = inst.regions[1];
  if (other.body.size() > 1 || !m_.insts[other.body[0]].args.empty() ||
      m_.insts[other.body[0]].op != Op::kYield) {
    uint32_t middle = add(varying ? Opcode::k_else : Opcode::k_uelse, {target(0)});
    close(middle);
    out_.insts[begin].operands[1] = target(middle);
    ends_.push_back({});
    jump_to_end(middle, 0);
    emit_region(other);
  } else {
    jump_to_end(begin, 1);
  }
  uint32_t end = add(varying ? Opcode::k_endif : Opcode::k_uendif, {target(0)});
  close(end);
  jump_to_end(end, 0);
  if (varying) close_mask();
  frames_.pop_back();
}

std::vector<LowOperand> Scheduler::begin_carried(const Inst& inst) {
  const std::vector<ValueId>& params = inst.regions[0].params;
  uint32_t fixed = fixed_args(inst);
  std::vector<LowOperand> regs = define_results(inst);
  std::vector<ValueId> initial(inst.args.begin() + fixed, inst.args.end());
  if (!params.empty()) merge(regs, initial, inst.results, false);
  flush();
  for (size_t i = 0; i < params.size(); ++i)
    locations_[params[i]] = regs[i];
  return regs;
}

void Scheduler::emit_loop(InstId id) {
  const Inst& inst = m_.insts[id];
  frames_.push_back({&inst, begin_carried(inst)});
  bool is_block = inst.op == Op::kBlock;
  // Where all lanes go to the next round together, the others have left the loop.
  if (!is_block && count_continues(m_, inst.regions[0]) == 1)
    for (ValueId r : inst.results)
      lanes_off_matter_[r] = used_[r];
  uint32_t begin = add(is_block ? Opcode::k_block : Opcode::k_loop, {target(0)});
  if (is_block)
    for (const LowOperand& r : frames_.back().merge)
      out_.insts[begin].begins.push_back(r.value);
  emit_rounds(inst, begin, is_block ? Opcode::k_endblock : Opcode::k_endloop);
}

void Scheduler::emit_rounds(const Inst& inst, uint32_t begin, Opcode end_opcode) {
  const bool once = end_opcode == Opcode::k_endblock;
  open_mask();
  for (ValueId p : inst.regions[0].params)
    level_[p] = depth();
  ends_.push_back({});
  emit_region(inst.regions[0]);
  where_ = inst.where;
  uint32_t end = once ? add(end_opcode, {target(0)}) : add(end_opcode, {target(begin + 1), target(0)});
  close(end);
  out_.insts[begin].operands[0] = target(end);
  jump_to_end(end, once ? 0 : 1);
  if (!once) out_.loops.emplace_back(begin, end);
  close_mask();
  frames_.pop_back();
}

void Scheduler::emit_illuminance(InstId id) {
  const Inst& inst = m_.insts[id];
  frames_.push_back({&inst, begin_carried(inst)});
  std::vector<LowOperand> fixed{use_uniform(inst.args[0])};
  for (uint32_t i = 1; i < 4; ++i)
    fixed.push_back(use(inst.args[i]));
  uint32_t begin =
      add(Opcode::k_illuminance, {target(0), word(inst.index), fixed[0], fixed[1], fixed[2], fixed[3]});
  emit_rounds(inst, begin, Opcode::k_endilluminance);
}

void Scheduler::emit_gather(InstId id) {
  const Inst& inst = m_.insts[id];
  frames_.push_back({&inst, begin_carried(inst)});
  emit_call(inst);
  uint32_t begin = add(Opcode::k_gather, {target(0), word(lanes_leave(m_, inst.regions[0]))});
  emit_rounds(inst, begin, Opcode::k_endgather);
}

void Scheduler::emit_emitter(InstId id) {
  const Inst& inst = m_.insts[id];
  uint32_t fixed_count = fixed_args(inst);
  std::vector<LowOperand> regs = define_results(inst);
  std::vector<ValueId> otherwise(inst.args.begin() + fixed_count, inst.args.end());
  merge(regs, otherwise, inst.results, false);
  flush();
  std::vector<LowOperand> operands{target(0), word(inst.index)};
  for (uint32_t i = 0; i < fixed_count; ++i)
    operands.push_back(use(inst.args[i]));
  frames_.push_back({&inst, regs});
  bool cone = inst.op == Op::kIlluminate;
  uint32_t begin = add(cone ? Opcode::k_illuminate : Opcode::k_solar, operands);
  open_mask();
  ends_.push_back({});
  emit_region(inst.regions[0]);
  uint32_t end = add(cone ? Opcode::k_endilluminate : Opcode::k_endsolar, {target(0)});
  close(end);
  out_.insts[begin].operands[0] = target(end);
  jump_to_end(end, 0);
  close_mask();
  frames_.pop_back();
}

void Scheduler::emit_exit(const Inst& inst) {
  uint32_t level = inst.index;
  size_t f = frames_.size();
  while (true) {
    --f;
    if (is_loop(frames_[f].inst->op) && level-- == 0) break;
  }
  const Frame loop = frames_[f]; // a copy: what flush() performs opens frames of its own
  if (inst.op == Op::kContinue)
    merge(loop.merge, inst.args, loop.inst->results, true);
  else
    merge_used(loop, inst.args);
  flush();
  // The end of the body is the next round by itself.
  if (f == frames_.size() - 1 && inst.op == Op::kContinue) return;
  if (f == frames_.size() - 1 && inst.op == Op::kBreak && loop.inst->op == Op::kBlock) return;
  uint32_t at =
      add(inst.op == Op::kBreak ? Opcode::k_break : Opcode::k_continue, {word(inst.index + 1), target(0)});
  jump_to_end(at, 1);
}

void Scheduler::emit_yield(const Inst& inst) {
  if (frames_.empty()) {
    if (init_param_) emit_init_result(inst);
    return;
  }
  const Inst& owner = *frames_.back().inst;
  bool masked = owner.op != Op::kIf || m_.varying(owner.args[0]);
  for (size_t i = 0; i < inst.args.size(); ++i)
    level_[owner.results[i]] |= level_[inst.args[i]] & kScatteredLevel;
  merge(frames_.back().merge, inst.args, owner.results, masked);
}

void Scheduler::emit_init_result(const Inst& inst) {
  auto slot = static_cast<uint32_t>(init_param_->slot);
  auto planes = static_cast<uint32_t>(components(init_param_->type));
  flush();
  if (init_param_->elements == 0) {
    add(make(code_of(Opcode::k_mov),
             {word(planes), word(make_operand(Space::kSlot, slot)), use(inst.args[0])}, 1, 1));
    return;
  }
  uint32_t array = 0;
  while (m_.arrays[array].slot != init_param_->slot)
    ++array;
  for (size_t i = 0; i < inst.args.size(); ++i)
    add(make(code_of(Opcode::k_astore),
             {word(planes), word(make_operand(Space::kArray, array)), tables_.number(static_cast<float>(i)),
              use(inst.args[i])},
             1, 1));
}
} // namespace slvm::ir
