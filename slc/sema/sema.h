// Semantic analysis. Read next: checker.h (types, names, overloads), contexts.h (uniform and varying, shader
// kinds).
#pragma once

#include "slc/sema/builtins.h"

namespace slc {

/// Checks and annotates `unit`: afterwards, and without errors, all that ast/*.h promises holds.
void analyse(TranslationUnit& unit, std::shared_ptr<const BuiltinLibrary> library, slvm::Diagnostics& diags);

} // namespace slc
