// Semantic analysis. Read next: checker.h (types, names, overloads), contexts.h (uniform and varying, shader
// kinds).
#pragma once

#include "slc/sema/builtins.h"

namespace slc {

/// Checks and annotates `unit`: afterwards, and without errors, all that ast/*.h promises holds. `plugins`:
/// where functions of plug-ins are found; null: nowhere.
void analyse(TranslationUnit& unit, std::shared_ptr<const BuiltinLibrary> library, slvm::Diagnostics& diags,
             const slvm::PluginSource* plugins = nullptr);

} // namespace slc
