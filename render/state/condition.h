// Expressions of conditional RIB: IfBegin "$user:pass == 'shadow' && !defined(user:quick)". From loosest to
// tightest: || && (== != =~) (< <= > >=) (+ -) (* /) (! -). Values are numbers, 'strings', $name, ${name},
// $(expression that gives a name) and bare words, which are strings. Functions: defined(name),
// concat(a, b, ...), matches(text, pattern). Patterns, also of =~, are POSIX extended regular expressions.
#pragma once

#include "slvm/support/result.h"
#include "slvm/value.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace render {

/// The value of a state variable; nothing when there is none of that name.
using StateLookup = std::function<std::optional<slvm::Value>(std::string_view name)>;

/// Whether the condition holds. The error says what is wrong and where in the expression.
slvm::Result<bool> evaluate_condition(std::string_view expression, const StateLookup& lookup);

struct Substituted {
  std::string text;
  std::string unknown; ///< the first variable that does not exist; it stays as it is written
};

/// Replaces $name and ${name} by the values of state variables; `$$` is a dollar sign. `marks` are the
/// characters that count as the dollar.
Substituted substitute_variables(std::string_view text, std::string_view marks, const StateLookup& lookup);

} // namespace render
