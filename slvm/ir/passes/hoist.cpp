// Loop invariants: a computation in a loop whose arguments come from outside is done once, before the loop.
// Kernels compute all lanes without harm, so that this is right even for loops that no lane enters.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

namespace slvm::ir {
namespace {

class Hoist {
public:
  explicit Hoist(Module& m) : m_(m) {}

  bool run() {
    depth_.assign(m_.values.size(), 0);
    for_each_root(m_, [&](Region& r) { visit(r, 0); });
    return changed_;
  }

private:
  bool invariant(const Inst& inst, uint32_t loop_depth) const {
    if (inst.regions.size() || inst.results.empty() || effect_of(m_, inst) != Effect::kNone) return false;
    if (inst.op == Op::kSlot) { // L, Cl, Ol change from light to light
      Global g = m_.slots[inst.index].parameter ? Global::kCount : find_global(m_.slots[inst.index].name);
      if (g == Global::kL || g == Global::kCl || g == Global::kOl) return false;
    }
    if (inst.op == Op::kCall && m_.called(inst).kind != ShadeopKind::kKernel) return false;
    for (ValueId a : inst.args)
      if (depth_[a] >= loop_depth) return false;
    return true;
  }

  // depth: loops around the region. Returns what moves out in front of the loop that owns the region.
  std::vector<InstId> visit(Region& region, uint32_t depth) {
    for (ValueId p : region.params)
      depth_[p] = depth;
    std::vector<InstId> body, out;
    for (InstId id : region.body) {
      if (depth > 0 && invariant(m_.insts[id], depth)) {
        for (ValueId v : m_.insts[id].results)
          depth_[v] = depth - 1;
        out.push_back(id);
        changed_ = true;
        continue;
      }
      bool loop = is_loop(m_.insts[id].op) && m_.insts[id].op != Op::kBlock;
      for (size_t i = 0; i < m_.insts[id].regions.size(); ++i) {
        for (InstId moved : visit(m_.insts[id].regions[i], depth + loop)) {
          // Out of an if inside a loop: on in the same direction.
          if (!loop) {
            out.push_back(moved);
            continue;
          }
          if (depth > 0 && invariant(m_.insts[moved], depth)) {
            for (ValueId v : m_.insts[moved].results)
              depth_[v] = depth - 1;
            out.push_back(moved);
          } else {
            body.push_back(moved);
          }
        }
      }
      for (ValueId v : m_.insts[id].results)
        depth_[v] = depth;
      body.push_back(id);
    }
    region.body = std::move(body);
    return out;
  }

  Module& m_;
  std::vector<uint32_t> depth_; // by value: loops around its definition
  bool changed_ = false;
};

} // namespace

bool hoist_invariants(Module& m) {
  return Hoist(m).run();
}

} // namespace slvm::ir
