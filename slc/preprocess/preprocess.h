// The preprocessor: source file in, one text without directives out, with the place every piece of it came
// from. Read next: normalise.h (what happens to the text before), preprocess.cpp (the wrapper around
// Boost.Wave).
//
// Only `#pragma` lines survive in the output; the lexer reads those. Text out of a macro's body is placed
// where the macro is used: a diagnostic about it points at the use.
#pragma once

#include "slc/embedded.h"
#include "slvm/support/diagnostics.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace slc {

/// Reads a whole file; nothing when there is none. Tests pass files in memory.
using FileReader = std::function<std::optional<std::string>(const std::string& path)>;
/// The reader for files on disk.
std::optional<std::string> read_file(const std::string& path);

/// What names of files begin with that the library brings along.
inline constexpr std::string_view kStandardFolder = "<anemone>/";

struct PreprocessOptions {
  std::vector<std::string> include_dirs; ///< in search order, after the including file's own folder for "..."
  std::vector<std::string> system_dirs;  ///< searched next: what is found there, -MM leaves out
  std::vector<std::string> defines;      ///< NAME or NAME=VALUE
  std::vector<std::string> undefines;    ///< win over defines, in any order
  FileReader read = read_file;
  std::span<const EmbeddedText> standard_headers; ///< searched last, by name
};

struct Dependency {
  std::string path;
  bool system = false; ///< found in a system folder, or included from such a file
};

/// A stretch of PreprocessedText::text that begins at `offset`.
struct Piece {
  size_t offset = 0;
  slvm::SourceRange at; ///< place of its first character
  bool exact =
      true; ///< the following characters stand side by side in the source too; false: all belong to `at`
};

/// A use of a macro, and where the macro is defined.
struct Expansion {
  std::string macro;
  slvm::SourceRange use, definition;
};

struct PreprocessedText {
  std::string text;
  std::vector<Piece> pieces;            ///< by offset
  std::vector<Expansion> expansions;    ///< the outermost ones
  std::vector<Dependency> dependencies; ///< files included, in order of first inclusion
};

/// Preprocesses file `main`, which is in `sources` already; included files are added there. Errors go to
/// `diags`; what could be preprocessed is returned all the same.
PreprocessedText preprocess(slvm::FileId main, const PreprocessOptions&, slvm::SourceManager& sources,
                            slvm::Diagnostics& diags);

} // namespace slc
