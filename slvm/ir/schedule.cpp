// Scheduling: registers, copies at merges, and where instructions go.
#include "slvm/ir/scheduler.h"

#include "slvm/ir/region_queries.h"

#include <algorithm>
#include <utility>

namespace slvm::ir {

Scheduler::Scheduler(const Module& m, Program& p) : m_(m), tables_(m, p) {
  locations_.assign(m.values.size(), target(0)); // a target: not located yet
  level_.assign(m.values.size(), 0);
  used_.assign(m.values.size(), false);
  lanes_off_matter_.assign(m.values.size(), true);
  for (const Inst& inst : m.insts)
    for (ValueId a : inst.args)
      used_[a] = true;
}

LowCode Scheduler::run() {
  out_.sections.push_back(0);
  emit_section(m_.body, nullptr);
  for (size_t i = 0; i < m_.inits.size(); ++i) {
    out_.sections.push_back(static_cast<uint32_t>(out_.insts.size()));
    auto param = std::find_if(m_.params.begin(), m_.params.end(),
                              [&](const Param& p) { return p.init == static_cast<int32_t>(i); });
    emit_section(m_.inits[i], param == m_.params.end() ? nullptr : &*param);
  }
  return std::move(out_);
}

LowOperand Scheduler::new_reg(Type t, bool varying) {
  LowReg reg;
  reg.planes = static_cast<uint32_t>(components(t));
  reg.varying = varying;
  out_.regs.push_back(reg);
  return {LowOperand::Kind::kReg, static_cast<uint32_t>(out_.regs.size() - 1)};
}

LowOperand Scheduler::use_uniform(ValueId v) {
  if (!m_.varying(v) || m_.values[v].array >= 0) return use(v);
  LowOperand reg = new_reg(m_.type(v), false);
  add(make(code_of(Opcode::k_first), {word(static_cast<uint32_t>(components(m_.type(v)))), reg, use(v)}, 1,
           1));
  return reg;
}

void Scheduler::flush() {
  if (in_strip_ || pending_.empty()) return;
  std::vector<InstAction> actions = std::exchange(pending_, {});
  const SourceRange where = where_; // of the instruction before which this is done
  uint32_t begin = add(Opcode::k_strip, {target(0), word(0)});
  in_strip_ = true;
  ends_.push_back({});
  for (const InstAction& action : actions)
    perform(action);
  in_strip_ = false;
  if (out_.insts.size() == begin + 1) { // all of it was copies of values to themselves
    out_.insts.pop_back();
    ends_.pop_back();
    where_ = where;
    return;
  }
  uint32_t end = add(Opcode::k_endstrip, {});
  close(end);
  where_ = where;
  out_.insts[begin].operands[0] = target(end);
  if (!levels_.empty()) levels_.back().strips.push_back(begin);
}

void Scheduler::perform(const InstAction& action) {
  where_ = action.where;
  if (action.inst != ~0u)
    emit_inst(action.inst);
  else
    copy_now(action, true);
}

void Scheduler::copy_now(const InstAction& c, bool varying) {
  struct Move {
    LowOperand to, from;
    Type type;
    bool masked;
  };
  std::vector<Move> moves;
  for (size_t i = 0; i < c.to.size(); ++i)
    if (m_.varying(c.results[i]) == varying && c.to[i] != use(c.from[i]))
      moves.push_back({c.to[i], use(c.from[i]), m_.type(c.results[i]),
                       c.masked && varying && lanes_off_matter_[c.results[i]]});
  for (size_t i = 0; i < moves.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      if (moves[j].to != moves[i].from) continue;
      LowOperand saved = new_reg(moves[i].type, varying);
      copy_one(saved, moves[i].from, moves[i].type, false);
      moves[i].from = saved;
      break;
    }
  for (const Move& move : moves)
    copy_one(move.to, move.from, move.type, move.masked);
}

void Scheduler::copy_one(LowOperand to, LowOperand from, Type t, bool masked) {
  add(make(code_of(masked ? Opcode::k_movm : Opcode::k_mov),
           {word(static_cast<uint32_t>(components(t))), to, from}, 1, 1));
}

void Scheduler::merge(std::vector<LowOperand> to, std::vector<ValueId> from,
                      const std::vector<ValueId>& results, bool masked) {
  InstAction c{~0u, std::move(to), std::move(from), results, masked, where_};
  if (in_strip_) {
    copy_now(c, true);
    copy_now(c, false);
    return;
  }
  bool some_varying = false, some_uniform = false;
  for (ValueId v : results)
    (m_.varying(v) ? some_varying : some_uniform) = true;
  if (some_varying) pending_.push_back(c);
  if (!some_uniform) return;
  flush();
  copy_now(c, false);
}

void Scheduler::merge_used(const Frame& loop, const std::vector<ValueId>& args) {
  std::vector<LowOperand> to;
  std::vector<ValueId> from, results;
  for (size_t i = 0; i < args.size(); ++i) {
    if (!used_[loop.inst->results[i]]) continue;
    to.push_back(loop.merge[i]);
    from.push_back(args[i]);
    results.push_back(loop.inst->results[i]);
  }
  merge(std::move(to), std::move(from), results, true);
}

void Scheduler::place(InstId id) {
  where_ = m_.insts[id].where;
  if (in_strip_ || is_alias(id) || is_terminator(m_.insts[id].op)) {
    emit_inst(id);
  } else if (can_overtake(id)) {
    emit_inst(id);
  } else if (!can_run_in_strips(m_, id)) {
    // Loops and light blocks begin with copies, which join the strips gathered so far.
    if (!begins_with_copies(m_.insts[id].op)) flush();
    emit_inst(id);
  } else if (is_uniform(m_, id)) {
    // A uniform value can come out of the strips being gathered, and loads of arrays stay behind stores.
    if (!args_located(id) || effect_of(m_, m_.insts[id]) != Effect::kNone) flush();
    emit_inst(id);
  } else {
    pending_.push_back({id, {}, {}, {}, false, where_});
  }
}

bool Scheduler::can_overtake(InstId id) const {
  const Inst& inst = m_.insts[id];
  if (inst.op != Op::kCall || !inst.regions.empty() || !args_located(id)) return false;
  const ShadeopInfo& info = m_.called(inst);
  if (info.kind != ShadeopKind::kGrid || info.flags & kDerivative || effect_of(m_, inst) == Effect::kWrites)
    return false;
  return std::none_of(pending_.begin(), pending_.end(), [&](const InstAction& a) {
    return a.inst == ~0u || effect_of(m_, m_.insts[a.inst]) == Effect::kWrites;
  });
}

bool Scheduler::is_alias(InstId id) const {
  const Inst& inst = m_.insts[id];
  return inst.op == Op::kConstant || inst.op == Op::kArray ||
         (inst.op == Op::kSlot && !m_.slots[inst.index].stored) ||
         (inst.op == Op::kRetype && is_located(inst.args[0]));
}

bool Scheduler::args_located(InstId id) const {
  const Inst& inst = m_.insts[id];
  return inst.regions.empty() &&
         std::all_of(inst.args.begin(), inst.args.end(), [&](ValueId v) { return is_located(v); });
}
LowCode schedule(const Module& m, Program& program) {
  return Scheduler(m, program).run();
}

} // namespace slvm::ir
