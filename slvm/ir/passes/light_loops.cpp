// Light loops over the same lights: diffuse() and specular() of one surface are two loops, whose rounds are
// the same. One loop does the work of both, and what they have in common (light directions, cone tests) is
// done once.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

#include <algorithm>

namespace slvm::ir {
namespace {

class LightLoopMerger {
public:
  explicit LightLoopMerger(Module& m) : m_(m) {}

  bool run() {
    for_each_root(m_, [&](Region& r) { visit(r); });
    return changed_;
  }

private:
  void visit(Region& region) {
    for (InstId id : region.body)
      for (Region& nested : m_.insts[id].regions)
        visit(nested);
    for (size_t i = 0; i < region.body.size(); ++i)
      for (size_t k = i + 1; k < region.body.size() && mergeable(region, i); ++k) {
        if (effect_of(m_, m_.insts[region.body[k]]) == Effect::kWrites) break;
        if (same_rounds(m_.insts[region.body[i]], m_.insts[region.body[k]]) && mergeable(region, k) &&
            bring_forward(region, i, k)) {
          merge(m_.insts[region.body[i]], m_.insts[region.body[k]]);
          region.body.erase(region.body.begin() + static_cast<std::ptrdiff_t>(k));
          changed_ = true;
          break; // the loop now stands behind what was moved: it comes round again
        }
      }
  }

  // ---- Which loops may be merged.

  /// Every lane takes part in every round that reaches it, and nothing but the results tells that it did.
  bool mergeable(const Region& region, size_t at) const {
    const Inst& inst = m_.insts[region.body[at]];
    return inst.op == Op::kIlluminance && effect_of(m_, inst) != Effect::kWrites &&
           exits(inst.regions[0], 0) == 1 && m_.insts[inst.regions[0].body.back()].op == Op::kContinue;
  }

  size_t exits(const Region& region, uint32_t depth) const {
    size_t count = 0;
    for (InstId id : region.body) {
      const Inst& inst = m_.insts[id];
      count += (inst.op == Op::kBreak || inst.op == Op::kContinue) && inst.index >= depth;
      for (const Region& nested : inst.regions)
        count += exits(nested, depth + is_loop(inst.op));
    }
    return count;
  }

  static bool same_rounds(const Inst& a, const Inst& b) {
    return b.op == Op::kIlluminance && a.index == b.index &&
           std::equal(a.args.begin(), a.args.begin() + fixed_args(a), b.args.begin());
  }

  // ---- Merging.

  /// Moves what loop `second` needs and stands between the two in front of `first`. False: it needs the first
  /// one's results.
  bool bring_forward(Region& region, size_t& first, size_t& second) {
    std::vector<bool> needed(m_.values.size(), false);
    need(m_.insts[region.body[second]], needed);
    std::vector<InstId> moved, kept;
    for (size_t i = second; i-- > first + 1;) {
      const Inst& inst = m_.insts[region.body[i]];
      bool move = std::any_of(inst.results.begin(), inst.results.end(), [&](ValueId v) { return needed[v]; });
      if (move) need(inst, needed);
      (move ? moved : kept).push_back(region.body[i]);
    }
    const Inst& loop = m_.insts[region.body[first]];
    if (std::any_of(loop.results.begin(), loop.results.end(), [&](ValueId v) { return needed[v]; }))
      return false;
    auto at = region.body.begin() + static_cast<std::ptrdiff_t>(first);
    InstId first_id = *at, second_id = region.body[second];
    at = std::copy(moved.rbegin(), moved.rend(), at);
    first = static_cast<size_t>(at - region.body.begin());
    *at++ = first_id;
    second = first + 1;
    *at++ = second_id;
    std::copy(kept.rbegin(), kept.rend(), at);
    return true;
  }

  void need(const Inst& inst, std::vector<bool>& needed) const {
    for (ValueId a : inst.args)
      needed[a] = true;
    for (const Region& r : inst.regions)
      for_each_inst(m_, r, [&](InstId id) {
        for (ValueId a : m_.insts[id].args)
          needed[a] = true;
      });
  }

  /// `second`, which follows at once, becomes the second half of `first`.
  void merge(Inst& first, Inst& second) {
    auto append = [](auto& to, const auto& from, size_t skip = 0) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(skip), from.end());
    };
    append(first.args, second.args, fixed_args(second));
    append(first.results, second.results);
    Region &a = first.regions[0], &b = second.regions[0];
    append(a.params, b.params);
    Inst& end = m_.insts[b.body.back()];
    std::vector<ValueId> carried = m_.insts[a.body.back()].args;
    append(carried, end.args);
    end.args = std::move(carried);
    a.body.pop_back();
    append(a.body, b.body);
  }

  Module& m_;
  bool changed_ = false;
};

} // namespace

bool merge_light_loops(Module& m) {
  return LightLoopMerger(m).run();
}

} // namespace slvm::ir
