// Makes old source files acceptable to the preprocessor without moving a character to another line or column: CR and
// CRLF line ends, a missing final newline, `#endif NAME`, `# 12 "file"` line markers, blanks after a line's final
// backslash, control characters and a byte order mark.
#pragma once

#include <string>
#include <string_view>

namespace slc {

std::string normalise_source(std::string_view text);

} // namespace slc
