// Files of stdlib that the build puts into the library, so that it works wherever the program is.
#pragma once

#include <span>
#include <string_view>

namespace slc {

struct EmbeddedText {
  std::string_view name, text;
};

/// stdlib/builtins: the RSL bodies of built-in functions.
std::span<const EmbeddedText> builtin_sources();
/// stdlib/include: headers that shaders include, found where no folder of the user has one of that name.
std::span<const EmbeddedText> standard_headers();

} // namespace slc
