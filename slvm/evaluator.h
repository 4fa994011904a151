// Constant folding with the virtual machine's own kernels. PUBLIC. Tools hand it to slc, binding uses it
// itself, so that a folded call and an executed one agree to the last bit.
#pragma once

#include "slvm/ir/passes/passes.h"

#include <memory>

namespace slvm {

/// `target`: instruction set by name, as in MachineOptions; empty for the best. The evaluator is thread-safe.
std::unique_ptr<ir::ConstantEvaluator> make_kernel_evaluator(const std::string& target = {});

} // namespace slvm
