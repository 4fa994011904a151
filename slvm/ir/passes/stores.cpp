// Idle stores: lowering stores every variable that might have changed. Where all stores to a variable store
// the value it had from the start, there is nothing to store.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

namespace slvm::ir {

bool drop_idle_stores(Module& m) {
  std::vector<int64_t> slot_read(m.values.size(), -1); // by value: the slot it is a read of
  std::vector<bool> changes(m.slots.size(), false);
  for_each_root(m, [&](Region& root) {
    for_each_inst(m, root, [&](InstId id) {
      const Inst& inst = m.insts[id];
      if (inst.op == Op::kSlot) slot_read[inst.results[0]] = inst.index;
    });
  });
  for_each_root(m, [&](Region& root) {
    for_each_inst(m, root, [&](InstId id) {
      const Inst& inst = m.insts[id];
      if (inst.op == Op::kStore && slot_read[inst.args[0]] != inst.index) changes[inst.index] = true;
      if (inst.op == Op::kArrayStore && m.arrays[inst.index].slot >= 0)
        changes[static_cast<size_t>(m.arrays[inst.index].slot)] = true;
      for (ValueId r : inst.results) // arrays that calls store to
        if (m.values[r].array >= 0 && inst.op == Op::kCall &&
            m.arrays[static_cast<size_t>(m.values[r].array)].slot >= 0)
          changes[static_cast<size_t>(m.arrays[static_cast<size_t>(m.values[r].array)].slot)] = true;
    });
  });
  bool changed = false;
  auto visit = [&](auto&& self, Region& region) -> void {
    changed |= std::erase_if(region.body, [&](InstId id) {
                 return m.insts[id].op == Op::kStore && !changes[m.insts[id].index];
               }) > 0;
    for (InstId id : region.body)
      for (Region& nested : m.insts[id].regions)
        self(self, nested);
  };
  for_each_root(m, [&](Region& root) { visit(visit, root); });
  for (size_t i = 0; i < m.slots.size(); ++i)
    m.slots[i].stored = changes[i];
  return changed;
}

} // namespace slvm::ir
