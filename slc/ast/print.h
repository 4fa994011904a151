// The text of `slc --dump=ast`, which tests compare. After semantic analysis it shows types and details.
#pragma once

#include "slc/ast/unit.h"

namespace slc {

/// One node a line, children indented by two blanks.
std::string print_ast(const TranslationUnit&);
/// A single expression in the same form, at depth 0.
std::string print_ast(const Expr&);

} // namespace slc
