// Uniform or varying: an optimistic fixpoint. Everything starts uniform; a value becomes varying when it
// depends on a varying one, by data, or by control: merges after a varying condition, and whatever a loop
// carries that lanes leave or continue at different rounds.
#include "slvm/ir/passes/passes.h"

namespace slvm::ir {
namespace {

class DetailInference {
public:
  explicit DetailInference(Module& m) : m_(m) {}

  void run() {
    for (ValueInfo& v : m_.values)
      v.varying = false;
    for (Array& a : m_.arrays)
      a.varying = a.slot >= 0 && m_.slots[static_cast<size_t>(a.slot)].varying;
    divergent_.assign(m_.insts.size(), false);
    do {
      changed_ = false;
      for_each_root(m_, [&](Region& r) { visit(r); });
    } while (changed_);
  }

private:
  // An enclosing region: whether its mask differs from lane to lane, and if it is a loop, which one.
  struct Frame {
    InstId inst;
    bool varying_control;
  };

  void make_varying(ValueId v) {
    if (m_.values[v].varying) return;
    m_.values[v].varying = true;
    changed_ = true;
  }
  void flow(ValueId from, ValueId to) {
    if (m_.values[from].varying) make_varying(to);
  }
  void make_divergent(InstId loop) {
    if (divergent_[loop]) return;
    divergent_[loop] = true;
    changed_ = true;
  }
  bool masked(const Frame& f) const { return f.varying_control || divergent_[f.inst]; }
  bool under_varying_control() const {
    for (const Frame& f : frames_)
      if (masked(f)) return true;
    return false;
  }

  void visit(Region& region) {
    for (InstId id : region.body)
      visit_inst(id);
  }

  void visit_inst(InstId id) {
    Inst& inst = m_.insts[id];
    switch (inst.op) {
    case Op::kSlot:
      if (m_.slots[inst.index].varying) make_varying(inst.results[0]);
      break;
    case Op::kRetype: flow(inst.args[0], inst.results[0]); break;
    case Op::kCall: visit_call(inst); break;
    case Op::kArray:
      if (m_.arrays[inst.index].varying) make_varying(inst.results[0]);
      break;
    case Op::kArrayLoad:
      if (m_.arrays[inst.index].varying) make_varying(inst.results[0]);
      flow(inst.args[0], inst.results[0]);
      break;
    case Op::kArrayStore: {
      Array& a = m_.arrays[inst.index];
      bool varying = m_.varying(inst.args[0]) || m_.varying(inst.args[1]) || under_varying_control();
      if (varying && !a.varying) a.varying = changed_ = true;
      break;
    }
    case Op::kBreak:
    case Op::kContinue: visit_exit(inst); break;
    case Op::kYield: visit_yield(inst); break;
    case Op::kIf:
    case Op::kLoop:
    case Op::kBlock:
    case Op::kIlluminance:
    case Op::kGather:
    case Op::kIlluminate:
    case Op::kSolar: visit_region_inst(id); break;
    case Op::kConstant:
    case Op::kStore:
    case Op::kArrayClear: break;
    }
  }

  void visit_call(const Inst& inst) {
    const ShadeopInfo& info = m_.called(inst);
    bool varying = info.flags & kHiddenVarying;
    for (ValueId a : inst.args)
      varying |= m_.varying(a);
    if (info.kind == ShadeopKind::kPlugin) return visit_plugin_call(inst, info.signature, varying);
    if (!varying) return;
    for (size_t i = 0; i < inst.results.size(); ++i) {
      bool is_result = i == 0 && info.signature.result != Type::kVoid;
      bool uniform =
          (is_result && info.signature.uniform_result) || m_.type(inst.results[i]) == Type::kString;
      if (!uniform) make_varying(inst.results[i]);
    }
  }

  // What a plug-in declares uniform is; strings may differ from point to point. Lanes that are off keep the
  // elements of an array.
  void visit_plugin_call(const Inst& inst, const Signature& s, bool varying) {
    size_t next = 0;
    if (s.result != Type::kVoid && next < inst.results.size()) {
      if (varying && !s.uniform_result) make_varying(inst.results[next]);
      ++next;
    }
    for (int i = 0; i < s.param_count; ++i) {
      if (!s.param(i).output || next == inst.results.size()) continue;
      const ValueId stored = inst.results[next++];
      bool stored_varying = varying && !s.param(i).uniform;
      if (m_.values[stored].array >= 0) {
        Array& a = m_.arrays[static_cast<size_t>(m_.values[stored].array)];
        stored_varying |= under_varying_control();
        if (stored_varying && !a.varying) a.varying = changed_ = true;
        stored_varying = a.varying;
      }
      if (stored_varying) make_varying(stored);
    }
  }

  void visit_exit(const Inst& inst) {
    // Everything between the exit and its loop, and the loop itself, loses some lanes and keeps others.
    size_t to_pass = inst.index;
    bool varying = false;
    std::vector<InstId> passed;
    InstId target = 0;
    for (size_t i = frames_.size(); i-- > 0;) {
      const Frame& f = frames_[i];
      if (!is_loop(m_.insts[f.inst].op)) {
        varying |= masked(f);
        continue;
      }
      if (to_pass-- == 0) {
        target = f.inst;
        break;
      }
      varying |= masked(f);
      passed.push_back(f.inst);
    }
    if (varying) {
      make_divergent(target);
      for (InstId loop : passed)
        make_divergent(loop);
    }
    const Inst& loop = m_.insts[target];
    for (size_t i = 0; i < inst.args.size(); ++i) {
      flow(inst.args[i], loop.results[i]);
      if (inst.op == Op::kContinue) flow(inst.args[i], loop.regions[0].params[i]);
    }
  }

  void visit_yield(const Inst& inst) {
    if (frames_.empty()) return;
    const Inst& owner = m_.insts[frames_.back().inst];
    for (size_t i = 0; i < inst.args.size(); ++i)
      flow(inst.args[i], owner.results[i]);
  }

  void visit_region_inst(InstId id) {
    Inst& inst = m_.insts[id];
    bool condition = inst.op == Op::kIf && m_.varying(inst.args[0]);
    bool by_lane =
        is_light_statement(inst.op) || inst.op == Op::kGather; // lights and rays choose their lanes
    frames_.push_back({id, condition || by_lane});
    for (Region& r : inst.regions)
      visit(r);
    frames_.pop_back();
    if (condition || by_lane || divergent_[id])
      for (ValueId v : inst.results)
        make_varying(v);
    uint32_t fixed = fixed_args(inst);
    if (is_loop(inst.op) && inst.op != Op::kBlock) {
      const std::vector<ValueId>& params = inst.regions[0].params;
      for (size_t i = 0; i < params.size(); ++i) {
        flow(inst.args[fixed + i], params[i]);
        flow(params[i], inst.results[i]);
        if (divergent_[id] || by_lane) make_varying(params[i]);
        // Initial value, parameter and result share a register: they agree.
        flow(inst.results[i], params[i]);
      }
    } else if (inst.op != Op::kIf && inst.op != Op::kBlock) {
      for (size_t i = 0; i < inst.results.size(); ++i)
        flow(inst.args[fixed + i], inst.results[i]);
    }
  }

  Module& m_;
  std::vector<bool> divergent_; // by loop instruction
  std::vector<Frame> frames_;
  bool changed_ = false;
};

} // namespace

void infer_detail(Module& m) {
  DetailInference(m).run();
}

} // namespace slvm::ir
