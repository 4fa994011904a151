// Makes old source files acceptable to the preprocessor without moving a character to another line or column:
// CR and CRLF line ends, a missing final newline, `#endif NAME`, `# 12 "file"` line markers, blanks after a
// line's final backslash, control characters, a byte order mark, and `#pragma` without a word.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slc {

/// What a text begins and never ends, and other slips: line numbers from 1, 0 for none.
struct OpenEnds {
  size_t comment = 0;           ///< a `/*`; the end of the text closes it
  size_t conditional = 0;       ///< the innermost #if, #ifdef or #ifndef without #endif
  std::string conditional_word; ///< which of them
  size_t conditionals = 0;      ///< how many have none
  /// Directives that do not exist, by line, blanked. Those within conditionals may be meant for others.
  std::vector<std::pair<size_t, std::string>> unknown;
};

std::string normalise_source(std::string_view text, OpenEnds* open = nullptr);

} // namespace slc
