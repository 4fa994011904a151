// What the scheduler asks of instructions with all that is nested in them.
#pragma once

#include "slvm/ir/ir.h"

namespace slvm::ir {

/// True when everything in it can run strip by strip: no barrier, and no exit to a loop outside it. `depth`:
/// loops around it that are part of what is asked for.
bool can_run_in_strips(const Module&, InstId, uint32_t depth = 0);
/// True when nothing in it is varying: it runs once, at grid level.
bool is_uniform(const Module&, InstId);
/// How many ways there are to the next round of the loop around `region`.
uint32_t count_continues(const Module&, const Region& region, uint32_t depth = 0);
/// Whether lanes can leave the loop that owns `region` before its last round.
bool lanes_leave(const Module&, const Region& region, uint32_t depth = 0);

} // namespace slvm::ir
