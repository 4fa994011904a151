// Advice for names that other shading languages have and RSL lacks.
#pragma once

#include "slc/ast/expr.h"

#include <string_view>

namespace slc {

/// What to write instead of a call of `name`; empty when nothing is known.
std::string_view function_hint(std::string_view name);
/// The standard header that defines a function or a macro of this name; empty when none does.
std::string_view header_defining(std::string_view name);
/// The same as function_hint for variables.
std::string_view variable_hint(std::string_view name);
/// What to do instead of giving a token that its set does not have; empty when nothing is known.
std::string_view token_hint(std::string_view set, std::string_view token);

/// A copy of a number or string, placed at `range`.
ExprPtr copy_constant(const Expr&, SourceRange range);

} // namespace slc
