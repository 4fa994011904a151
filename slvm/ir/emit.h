// Bytecode from IR: placement into strip blocks, registers, code, line table.
#pragma once

#include "slvm/ir/ir.h"

namespace slvm::ir {

/// Fills the code part of a program (imports to lines, params' slots, mask_depth) from an optimised module
/// whose detail is inferred. The rest of `program` (name, annotations, facts, ir) is left alone.
void emit(const Module& m, Program& program);

} // namespace slvm::ir
