// Makes old source files acceptable to the preprocessor without moving a character to another line or column:
// CR and CRLF line ends, a missing final newline, `#endif NAME`, `# 12 "file"` line markers, blanks after a
// line's final backslash, control characters, a byte order mark, and `#pragma` without a word.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace slc {

/// `open_comment`, if given: the line (from 1) of a `/*` that is never closed, or 0. The end of the text
/// closes it.
std::string normalise_source(std::string_view text, size_t* open_comment = nullptr);

} // namespace slc
