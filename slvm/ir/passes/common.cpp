// Common subexpressions: an instruction equal to one that is visible from it gives the same value.
// Instructions that read memory or state are merged only while nothing was written in between.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

#include <map>
#include <set>
#include <tuple>

namespace slvm::ir {
namespace {

class CommonSubexpressions {
public:
  explicit CommonSubexpressions(Module& m) : m_(m) {}

  bool run() {
    replacement_.assign(m_.values.size(), kNoValue);
    for_each_root(m_, [&](Region& r) {
      available_.clear();
      visit(r);
      replace_uses(m_, r, replacement_);
    });
    return changed_;
  }

private:
  // The type tells retypes apart; the epoch counts writes.
  using Key = std::tuple<Op, uint32_t, Type, uint64_t, std::vector<ValueId>>;

  ValueId resolve(ValueId v) const {
    while (v < replacement_.size() && replacement_[v] != kNoValue)
      v = replacement_[v];
    return v;
  }

  bool is_light_slot(const Inst& inst) const {
    if (inst.op != Op::kSlot || m_.slots[inst.index].parameter) return false;
    Global g = find_global(m_.slots[inst.index].name);
    return g == Global::kL || g == Global::kCl || g == Global::kOl;
  }

  void visit(Region& region) {
    std::vector<Key> added; // taken out again at the end: not visible outside
    std::set<InstId> dead;
    for (InstId id : region.body) {
      Inst& inst = m_.insts[id];
      for (ValueId& a : inst.args)
        a = resolve(a);
      Effect effect = effect_of(m_, inst);
      if (!inst.regions.empty()) {
        // A region may run after writes of its own later part (a loop's next round), and lights change on the
        // way.
        if (effect == Effect::kWrites || is_loop(inst.op)) ++epoch_;
        for (Region& r : inst.regions)
          visit(r);
        if (effect == Effect::kWrites || is_loop(inst.op)) ++epoch_;
        continue;
      }
      if (effect == Effect::kWrites) {
        ++epoch_;
        continue;
      }
      if (inst.results.empty()) continue;
      uint64_t epoch = effect == Effect::kReads || is_light_slot(inst) ? epoch_ : 0;
      Key key{inst.op, inst.index, m_.type(inst.results[0]), epoch, inst.args};
      auto [it, is_new] = available_.try_emplace(key, id);
      if (is_new) {
        added.push_back(std::move(key));
        continue;
      }
      for (size_t i = 0; i < inst.results.size(); ++i)
        replacement_[inst.results[i]] = m_.insts[it->second].results[i];
      changed_ = true;
      dead.insert(id);
    }
    for (const Key& key : added)
      available_.erase(key);
    std::erase_if(region.body, [&](InstId id) { return dead.contains(id); });
  }

  Module& m_;
  std::map<Key, InstId> available_;
  std::vector<ValueId> replacement_;
  uint64_t epoch_ = 1;
  bool changed_ = false;
};

} // namespace

bool merge_common(Module& m) {
  return CommonSubexpressions(m).run();
}

} // namespace slvm::ir
