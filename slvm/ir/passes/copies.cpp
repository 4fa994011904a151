// Copy propagation. In SSA form copies are merges that merge nothing: lowering carries every variable through
// every loop and block, and this pass drops those that did not change.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

#include <map>

namespace slvm::ir {
namespace {

class CopyPropagation {
public:
  explicit CopyPropagation(Module& m) : m_(m) {}

  bool run() {
    replacement_.assign(m_.values.size(), kNoValue);
    for_each_root(m_, [&](Region& r) {
      visit(r);
      replace_uses(m_, r, replacement_);
    });
    return changed_;
  }

private:
  ValueId resolve(ValueId v) const {
    while (v < replacement_.size() && replacement_[v] != kNoValue)
      v = replacement_[v];
    return v;
  }
  void replace(ValueId v, ValueId by) {
    replacement_[v] = by;
    changed_ = true;
  }

  // Breaks and continues of each enclosing loop, innermost last.
  struct LoopExits {
    std::vector<InstId> breaks, continues;
  };

  void visit(Region& region) {
    for (InstId id : region.body) {
      Inst& inst = m_.insts[id];
      if (inst.op == Op::kRetype && m_.type(resolve(inst.args[0])) == m_.type(inst.results[0]))
        replace(inst.results[0], resolve(inst.args[0]));
      if (inst.op == Op::kBreak || inst.op == Op::kContinue) {
        LoopExits& exits = loops_[loops_.size() - 1 - inst.index];
        (inst.op == Op::kBreak ? exits.breaks : exits.continues).push_back(id);
      }
      if (is_loop(inst.op)) {
        loops_.emplace_back();
        visit(inst.regions[0]);
        LoopExits exits = std::move(loops_.back());
        loops_.pop_back();
        simplify_loop(id, exits);
      } else {
        for (Region& r : inst.regions)
          visit(r);
        if (inst.op == Op::kIf)
          simplify_if(id);
        else if (inst.op == Op::kIlluminate || inst.op == Op::kSolar)
          simplify_conditional(id);
      }
    }
  }

  InstId terminator(const Region& r) const { return r.body.back(); }

  template <class Keep> static void filter(std::vector<ValueId>& list, size_t offset, Keep&& keep) {
    size_t out = offset;
    for (size_t i = offset; i < list.size(); ++i)
      if (keep(i - offset)) list[out++] = list[i];
    list.resize(out);
  }

  // A result is a copy when every branch that reaches the end yields the same value.
  void simplify_if(InstId id) {
    Inst& inst = m_.insts[id];
    std::vector<InstId> yields;
    for (Region& r : inst.regions)
      if (m_.insts[terminator(r)].op == Op::kYield) yields.push_back(terminator(r));
    if (yields.size() != 2) return; // values of a lone branch are not visible outside except as results
    drop(id, yields, [&](size_t i) {
      ValueId v = resolve(m_.insts[yields[0]].args[i]);
      return v == resolve(m_.insts[yields[1]].args[i]) ? v : kNoValue;
    });
  }

  // illuminate and solar: a result is a copy when the yielded value is the one lanes have that the light
  // misses.
  void simplify_conditional(InstId id) {
    Inst& inst = m_.insts[id];
    uint32_t fixed = fixed_args(inst);
    InstId yield = terminator(inst.regions[0]);
    if (m_.insts[yield].op != Op::kYield) return;
    std::vector<bool> keep = drop(id, {yield}, [&](size_t i) {
      ValueId v = resolve(m_.insts[yield].args[i]);
      return v == resolve(inst.args[fixed + i]) ? v : kNoValue;
    });
    filter(m_.insts[id].args, fixed, [&](size_t i) { return keep[i]; });
  }

  // Removes results for which same(i) gives a value, from the instruction and from the terminators that feed
  // them.
  template <class Same> std::vector<bool> drop(InstId id, const std::vector<InstId>& feeders, Same&& same) {
    Inst& inst = m_.insts[id];
    std::vector<bool> keep(inst.results.size(), true);
    for (size_t i = 0; i < inst.results.size(); ++i) {
      ValueId v = same(i);
      if (v == kNoValue) continue;
      replace(inst.results[i], v);
      keep[i] = false;
    }
    auto kept = [&](size_t i) { return keep[i]; };
    filter(inst.results, 0, kept);
    for (InstId feeder : feeders)
      filter(m_.insts[feeder].args, 0, kept);
    return keep;
  }

  void simplify_loop(InstId id, const LoopExits& exits) {
    Inst& inst = m_.insts[id];
    Region& body = inst.regions[0];
    uint32_t fixed = fixed_args(inst);
    if (inst.op == Op::kBlock) {
      simplify_block(id, exits);
      return;
    }
    // A carried value is a copy of its initial value when every round passes on the parameter itself (or that
    // value).
    size_t n = body.params.size();
    std::vector<bool> keep(n, true);
    for (size_t i = 0; i < n; ++i) {
      ValueId initial = resolve(inst.args[fixed + i]), param = body.params[i];
      auto passes_on = [&](const std::vector<InstId>& list) {
        for (InstId t : list) {
          ValueId v = resolve(m_.insts[t].args[i]);
          if (v != param && v != initial) return false;
        }
        return true;
      };
      if (!passes_on(exits.continues) || !passes_on(exits.breaks)) continue;
      replace(param, initial);
      replace(inst.results[i], initial);
      keep[i] = false;
    }
    auto kept = [&](size_t i) { return keep[i]; };
    filter(inst.args, fixed, kept);
    filter(inst.results, 0, kept);
    filter(body.params, 0, kept);
    for (InstId t : exits.continues)
      filter(m_.insts[t].args, 0, kept);
    for (InstId t : exits.breaks)
      filter(m_.insts[t].args, 0, kept);
  }

  // A block's result is a copy when all breaks agree on a value that is visible outside the block.
  void simplify_block(InstId id, const LoopExits& exits) {
    std::map<ValueId, bool> inside;
    auto note = [&](auto&& self, const Region& r) -> void {
      for (ValueId p : r.params)
        inside[p] = true;
      for (InstId nested : r.body) {
        for (ValueId v : m_.insts[nested].results)
          inside[v] = true;
        for (const Region& deeper : m_.insts[nested].regions)
          self(self, deeper);
      }
    };
    if (!m_.insts[id].results.empty()) note(note, m_.insts[id].regions[0]);
    drop(id, exits.breaks, [&](size_t i) {
      ValueId common = kNoValue;
      for (InstId t : exits.breaks) {
        ValueId v = resolve(m_.insts[t].args[i]);
        if (inside.contains(v) || (common != kNoValue && common != v)) return kNoValue;
        common = v;
      }
      return common;
    });
  }

  Module& m_;
  std::vector<LoopExits> loops_;
  std::vector<ValueId> replacement_;
  bool changed_ = false;
};

} // namespace

bool propagate_copies(Module& m) {
  return CopyPropagation(m).run();
}

} // namespace slvm::ir
