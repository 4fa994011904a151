// What stands in for functions that this build knows but cannot serve.
#include "slvm/exec/rays/call_tokens.h"
#include "slvm/exec/run.h"

#include <fmt/format.h>

namespace slvm::grid_ops {

void unserved(const GridCall& call) {
  for (const GridOperand& o : call.operands.first(count_stores(call)))
    fill(call.run, o, 0);
  call.run.report(call.code, MessageSeverity::kWarning,
                  fmt::format("{}: this version cannot carry it out; its results are 0", call.info.name),
                  mask_count(call.run.mask.current(), call.run.points));
}

} // namespace slvm::grid_ops
