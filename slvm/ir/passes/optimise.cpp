// The order of passes.
#include "slvm/ir/passes/passes.h"

namespace slvm::ir {

namespace {
// Each round can only find what the one before uncovered; real shaders settle in two or three.
constexpr int kMostRounds = 4;
} // namespace

void optimise(Module& m, int level, const ConstantEvaluator* evaluator) {
  if (level >= 1) {
    for (int round = 0; round < kMostRounds; ++round) {
      bool changed = propagate_copies(m);
      changed |= fold_constants(m, evaluator);
      changed |= merge_common(m);
      changed |= drop_idle_stores(m);
      changed |= remove_dead(m);
      if (level >= 2 && round == 0) {
        changed |= reduce_strength(m);
        changed |= merge_light_loops(m);
        changed |= hoist_invariants(m);
        changed |= select_small_ifs(m);
      }
      if (!changed) break;
    }
  }
  infer_detail(m);
}

} // namespace slvm::ir
