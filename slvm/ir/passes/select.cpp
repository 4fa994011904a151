// If-conversion: where both branches are short and pure, computing both and choosing by lane is cheaper than
// two passes under masks.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

#include <algorithm>

namespace slvm::ir {
namespace {

// Instructions in both branches together, up to which selection pays. Measured with tests/bench (divergent):
// a masked branch costs about four instructions of stack and copies.
constexpr size_t kMostInstructions = 8;

bool cheap(const Module& m, const Inst& inst) {
  switch (inst.op) {
  case Op::kConstant:
  case Op::kRetype: return true;
  case Op::kSlot: return effect_of(m, inst) == Effect::kNone;
  case Op::kCall: {
    const ShadeopInfo& info = m.called(inst);
    if (info.kind != ShadeopKind::kKernel || effect_of(m, inst) != Effect::kNone) return false;
    // Operators, conversions and the like; not noise or transcendentals, which are worth skipping.
    return (info.flags & kInternal) || info.name == "min" || info.name == "max" || info.name == "abs" ||
           info.name == "clamp" || info.name == "mix" || info.name == "step";
  }
  default: return false;
  }
}

bool convertible(const Module& m, const Inst& inst) {
  if (inst.op != Op::kIf || inst.results.empty()) return false;
  size_t count = 0;
  for (const Region& r : inst.regions) {
    if (m.insts[r.body.back()].op != Op::kYield) return false;
    for (size_t i = 0; i + 1 < r.body.size(); ++i) {
      const Inst& nested = m.insts[r.body[i]];
      if (!cheap(m, nested)) return false;
      count += nested.op == Op::kCall;
    }
  }
  auto selectable = [&](ValueId v) { return m.type(v) != Type::kString && m.type(v) != Type::kMatrix; };
  return count + inst.results.size() <= kMostInstructions &&
         std::all_of(inst.results.begin(), inst.results.end(), selectable);
}

ShadeopId select_for(Type t) {
  for (ShadeopId id : shadeop_overloads("operator?:"))
    if (shadeop(id).signature.result == t) return id;
  return 0;
}

bool visit(Module& m, Region& region) {
  bool changed = false;
  std::vector<InstId> body;
  for (InstId id : region.body) {
    for (size_t i = 0; i < m.insts[id].regions.size(); ++i) {
      Region nested = std::move(m.insts[id].regions[i]);
      changed |= visit(m, nested);
      m.insts[id].regions[i] = std::move(nested);
    }
    if (!convertible(m, m.insts[id])) {
      body.push_back(id);
      continue;
    }
    changed = true;
    Inst old = std::move(m.insts[id]);
    for (const Region& r : old.regions)
      body.insert(body.end(), r.body.begin(), r.body.end() - 1);
    const Inst& then_yield = m.insts[old.regions[0].body.back()];
    const Inst& else_yield = m.insts[old.regions[1].body.back()];
    std::vector<Inst> selections;
    for (size_t i = 0; i < old.results.size(); ++i)
      selections.push_back({Op::kCall,
                            select_for(m.type(old.results[i])),
                            old.where,
                            {old.args[0], then_yield.args[i], else_yield.args[i]},
                            {old.results[i]},
                            {}});
    for (Inst& s : selections) {
      m.insts.push_back(std::move(s));
      body.push_back(static_cast<InstId>(m.insts.size() - 1));
    }
  }
  region.body = std::move(body);
  return changed;
}

} // namespace

bool select_small_ifs(Module& m) {
  bool changed = false;
  for_each_root(m, [&](Region& r) { changed |= visit(m, r); });
  return changed;
}

} // namespace slvm::ir
