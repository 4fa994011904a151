#include "slvm/ir/region_queries.h"

#include <algorithm>

namespace slvm::ir {

bool can_run_in_strips(const Module& m, InstId id, uint32_t depth) {
  const Inst& inst = m.insts[id];
  switch (inst.op) {
  case Op::kIlluminance:
  case Op::kIlluminate:
  case Op::kSolar:
  case Op::kGather: return false;
  case Op::kBreak:
  case Op::kContinue: return inst.index < depth;
  case Op::kCall: return m.called(inst).kind == ShadeopKind::kKernel;
  // Stores to what all strips share would be done once for each strip.
  case Op::kStore: return m.slots[inst.index].varying;
  case Op::kArrayStore:
  case Op::kArrayClear: return m.arrays[inst.index].varying;
  default: break;
  }
  for (const Region& r : inst.regions)
    for (InstId nested : r.body)
      if (!can_run_in_strips(m, nested, depth + is_loop(inst.op))) return false;
  return true;
}

bool is_uniform(const Module& m, InstId id) {
  const Inst& inst = m.insts[id];
  auto varying = [&](ValueId v) { return m.varying(v); };
  if (std::any_of(inst.results.begin(), inst.results.end(), varying) ||
      std::any_of(inst.args.begin(), inst.args.end(), varying))
    return false;
  for (const Region& r : inst.regions)
    for (InstId nested : r.body)
      if (!is_uniform(m, nested)) return false;
  return true;
}

uint32_t count_continues(const Module& m, const Region& region, uint32_t depth) {
  uint32_t count = 0;
  for (InstId id : region.body) {
    const Inst& inst = m.insts[id];
    count += inst.op == Op::kContinue && inst.index == depth;
    for (const Region& r : inst.regions)
      count += count_continues(m, r, depth + is_loop(inst.op));
  }
  return count;
}

bool lanes_leave(const Module& m, const Region& region, uint32_t depth) {
  for (InstId id : region.body) {
    const Inst& inst = m.insts[id];
    if (inst.op == Op::kBreak && inst.index >= depth) return true;
    if (inst.op == Op::kContinue && inst.index > depth) return true;
    for (const Region& nested : inst.regions)
      if (lanes_leave(m, nested, depth + is_loop(inst.op))) return true;
  }
  return false;
}

} // namespace slvm::ir
