// What slc --explain-varying prints.
#pragma once

#include "slc/ast/unit.h"
#include "slvm/support/source.h"

#include <string>

namespace slc {

/// For each shader its heading, then the answers for the variables of this name, a step a line:
///
///   surface "wood"
///   wood.sl:4:13: 'r' is varying: it is set from 'p' here
///   wood.sl:3:13: ...
///
/// "" when no shader of the unit has such a variable.
std::string explanation(TranslationUnit& unit, std::string_view name, const slvm::SourceManager& sources);

/// "slc: wood.sl has no variable 'rinks'; did you mean 'rings'?".
std::string no_such_variable(const TranslationUnit& unit, std::string_view name, std::string_view file);

} // namespace slc
