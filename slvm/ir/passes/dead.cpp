// Dead code: marks what is needed by something that must happen, sweeps the rest. Works down to single
// results and carried values: a counter that only counts itself is not needed.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

namespace slvm::ir {
namespace {

class DeadCode {
public:
  explicit DeadCode(Module& m) : m_(m) {}

  bool run() {
    info_.assign(m_.insts.size(), {});
    definition_.assign(m_.values.size(), {});
    needed_.assign(m_.values.size(), false);
    array_read_.assign(m_.arrays.size(), false);
    for_each_root(m_, [&](Region& r) { index(r, kNone); });
    for_each_root(m_, [&](Region& r) { mark_roots(r); });
    drain();
    bool changed = false;
    for_each_root(m_, [&](Region& r) { changed |= sweep(r); });
    return changed;
  }

private:
  static constexpr InstId kNone = ~0u;
  struct Info {
    InstId parent = kNone; // the instruction whose region holds this one
    std::vector<InstId>
        feeders; // yields, breaks and continues that give this instruction its results and parameters
    bool live = false;
  };
  struct Definition {
    InstId inst = kNone;
    uint32_t position = 0; // among results or parameters
  };

  void index(Region& region, InstId owner) {
    for (size_t i = 0; i < region.params.size(); ++i)
      definition_[region.params[i]] = {owner, static_cast<uint32_t>(i)};
    for (InstId id : region.body) {
      Inst& inst = m_.insts[id];
      info_[id].parent = owner;
      for (size_t i = 0; i < inst.results.size(); ++i)
        definition_[inst.results[i]] = {id, static_cast<uint32_t>(i)};
      if (inst.op == Op::kBreak || inst.op == Op::kContinue)
        info_[loops_[loops_.size() - 1 - inst.index]].feeders.push_back(id);
      if (inst.op == Op::kYield && owner != kNone) info_[owner].feeders.push_back(id);
      if (is_loop(inst.op)) loops_.push_back(id);
      for (Region& r : inst.regions)
        index(r, id);
      if (is_loop(inst.op)) loops_.pop_back();
    }
  }

  // What must happen: effects that reach outside, and stores to arrays that something reads (marked as loads
  // appear).
  void mark_roots(Region& region) {
    for (InstId id : region.body) {
      Inst& inst = m_.insts[id];
      bool local_array =
          (inst.op == Op::kArrayStore || inst.op == Op::kArrayClear) && m_.arrays[inst.index].slot < 0;
      if (local_array)
        array_writes_.push_back(id);
      else if (inst.op == Op::kYield && info_[id].parent != kNone)
        ; // only for the results that are needed
      else if (inst.op == Op::kYield)
        mark_args(inst); // the value of an init
      else if ((inst.op == Op::kBreak || inst.op == Op::kContinue))
        ; // alive with the loop it belongs to
      else if (inst.regions.empty() && effect_of(m_, inst) == Effect::kWrites)
        mark(id);
      else if (inst.op == Op::kIlluminate || inst.op == Op::kSolar)
        mark(id);
      for (Region& r : inst.regions)
        mark_roots(r);
    }
  }

  void mark_args(const Inst& inst) {
    for (ValueId a : inst.args)
      need(a);
  }

  void need(ValueId v) {
    if (needed_[v]) return;
    needed_[v] = true;
    work_.push_back(v);
  }

  // The instruction runs: so does what encloses it, with the conditions that lead to it.
  void mark(InstId id) {
    if (info_[id].live) return;
    info_[id].live = true;
    Inst& inst = m_.insts[id];
    if (info_[id].parent != kNone) mark(info_[id].parent);
    if (inst.op == Op::kArrayLoad || inst.op == Op::kArray) read_array(inst.index);
    if (inst.regions.empty()) {
      mark_args(inst);
      return;
    }
    uint32_t fixed = inst.op == Op::kIf ? 1 : fixed_args(inst);
    for (uint32_t i = 0; i < fixed; ++i)
      need(inst.args[i]);
    // How lanes leave a loop that runs decides what runs after it and how often.
    if (is_loop(inst.op))
      for (InstId t : info_[id].feeders)
        mark_exit(t);
  }

  void mark_exit(InstId terminator) {
    if (info_[terminator].live) return;
    info_[terminator].live = true; // its arguments are needed one by one
    if (info_[terminator].parent != kNone) mark(info_[terminator].parent);
  }

  void read_array(uint32_t array) {
    if (array_read_[array]) return;
    array_read_[array] = true;
    arrays_.push_back(array);
  }

  void drain() {
    while (!work_.empty() || !arrays_.empty()) {
      while (!work_.empty()) {
        ValueId v = work_.back();
        work_.pop_back();
        need_definition(definition_[v]);
      }
      while (!arrays_.empty()) {
        uint32_t array = arrays_.back();
        arrays_.pop_back();
        for (InstId id : array_writes_)
          if (m_.insts[id].index == array) mark(id);
      }
    }
  }

  void need_definition(Definition d) {
    if (d.inst == kNone) return;
    mark(d.inst);
    Inst& inst = m_.insts[d.inst];
    if (inst.regions.empty()) return;
    // A result or parameter of a region: needed from every terminator that feeds it, and from the initial
    // values.
    for (InstId t : info_[d.inst].feeders) {
      need(m_.insts[t].args[d.position]);
      mark_exit(t);
    }
    if (inst.op == Op::kIf || inst.op == Op::kBlock) return;
    need(inst.args[fixed_args(inst) + d.position]);
    // Result and parameter of a loop are one carried value: they stay together.
    if (d.position < inst.results.size()) need(inst.results[d.position]);
    if (d.position < inst.regions[0].params.size()) need(inst.regions[0].params[d.position]);
  }

  bool sweep(Region& region) {
    size_t before = region.body.size();
    std::erase_if(region.body, [&](InstId id) {
      const Inst& inst = m_.insts[id];
      if (is_terminator(inst.op)) return false;
      if (info_[id].live) return false;
      return true;
    });
    bool changed = region.body.size() != before;
    for (InstId id : region.body) {
      Inst& inst = m_.insts[id];
      if (inst.regions.empty()) continue;
      changed |= prune(id);
      for (Region& r : inst.regions)
        changed |= sweep(r);
    }
    return changed;
  }

  // Drops the results nobody needs, with what feeds them.
  bool prune(InstId id) {
    Inst& inst = m_.insts[id];
    std::vector<bool> keep(inst.results.size());
    bool all = true;
    for (size_t i = 0; i < keep.size(); ++i)
      all &= keep[i] = needed_[inst.results[i]];
    if (all) return false;
    auto filter = [&](std::vector<ValueId>& list, size_t offset) {
      size_t out = offset;
      for (size_t i = offset; i < list.size(); ++i)
        if (keep[i - offset]) list[out++] = list[i];
      list.resize(out);
    };
    if (inst.op != Op::kIf && inst.op != Op::kBlock) filter(inst.args, fixed_args(inst));
    filter(inst.results, 0);
    if (!inst.regions[0].params.empty()) filter(inst.regions[0].params, 0);
    for (InstId t : info_[id].feeders)
      filter(m_.insts[t].args, 0);
    return true;
  }

  Module& m_;
  std::vector<Info> info_;
  std::vector<Definition> definition_;
  std::vector<bool> needed_, array_read_;
  std::vector<InstId> loops_, array_writes_;
  std::vector<ValueId> work_;
  std::vector<uint32_t> arrays_;
};

} // namespace

bool remove_dead(Module& m) {
  return DeadCode(m).run();
}

} // namespace slvm::ir
