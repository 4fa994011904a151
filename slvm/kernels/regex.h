// Regular expressions for match().
#pragma once

#include <string_view>

namespace slvm {

/// Whether the ECMAScript regular expression `pattern` matches anywhere in `subject`. False for patterns that
/// are not well-formed or beyond the limits in regex.cpp.
bool regex_found(std::string_view pattern, std::string_view subject);

} // namespace slvm
