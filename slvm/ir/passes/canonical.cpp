// See canonicalise() in passes.h. Runs at every level, right after lowering.
#include "slvm/ir/passes/passes.h"

#include <algorithm>

namespace slvm::ir {

void canonicalise(Module& m) {
  while (propagate_copies(m)) {
  }
  infer_detail(m);
  for_each_root(m, [&](Region& root) {
    for_each_inst(m, root, [&](InstId id) {
      Inst& inst = m.insts[id];
      if (inst.op != Op::kCall || inst.args.size() < 2) return;
      if (m.called(inst).name != "printf") return;
      if (std::none_of(inst.args.begin(), inst.args.end(), [&](ValueId v) { return m.varying(v); }))
        inst.index = shadeop_overloads("printonce")[0];
    });
  });
}

} // namespace slvm::ir
