// The passes over IR. Each is a free function in its own file; optimise() runs them in the order that slc and
// bind-time specialisation use.
#pragma once

#include "slvm/ir/ir.h"

#include <span>

namespace slvm::ir {

/// Computes shadeops of constants. slc and the optimiser know no kernels: whoever has them passes this in, so
/// that constant folding and execution run the same code and agree to the last bit.
class ConstantEvaluator {
public:
  virtual ~ConstantEvaluator() = default;
  /// Evaluates a pure shadeop for constant arguments. False: cannot; results are then untouched.
  virtual bool evaluate(ShadeopId id, std::span<const Constant* const> args,
                        std::vector<Constant>& results) const = 0;
};

/// What must hold before any other pass, so that what a program does depends on no pass: merges that merge
/// nothing are gone (whether a derivative sees a point's neighbours depends on where a value was made), and
/// printf is split into what prints for each point and what prints once.
void canonicalise(Module&);
/// Replaces calls with constant arguments by their results, and ifs with constant conditions by the branch
/// taken. `evaluator` may be null: then only the structure is folded.
bool fold_constants(Module&, const ConstantEvaluator* evaluator);
/// Removes merges that merge nothing: results and carried values that are the same on every way, retypes to
/// the type a value has.
bool propagate_copies(Module&);
/// Merges equal computations where one is visible from the other.
bool merge_common(Module&);
/// Removes what has no effect and is not used, down to single carried values.
bool remove_dead(Module&);
/// Moves computations out of loops that do not change there.
bool hoist_invariants(Module&);
/// Removes stores to variables that only ever store what was there.
bool drop_idle_stores(Module&);
/// The same values by cheaper calls: products for squares, floats instead of triples made of them.
bool reduce_strength(Module&);
/// Makes one loop of two light loops with the same rounds.
bool merge_light_loops(Module&);
/// Turns small ifs without effects into selections of both sides' values.
bool select_small_ifs(Module&);

/// Puts what derivatives are taken of in front, and behind that the derivatives: at hits of rays only this
/// part runs for the points beside them. Once, at the end; false: nothing has changed.
bool derivatives_first(Module&);

/// Computes sums of products in one instruction. Just before emission: other passes, those of bind-time
/// specialisation too, know no fused ones.
bool fuse_products(Module&);

/// Decides which values and arrays are uniform: those that depend on nothing varying, by data or by control.
/// Fills ValueInfo::varying and Array::varying.
void infer_detail(Module&);

/// 0: nothing; 1: fold, copies, common, dead; 2: all, until nothing changes (at most a few rounds).
void optimise(Module&, int level, const ConstantEvaluator* evaluator);

} // namespace slvm::ir
