// Source files, positions in them, and ranges: what every diagnostic and every line table points at.
// PUBLIC. Read next: diagnostics.h.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace slvm {

/// Index of a file in its SourceManager. 0 means "no file": a position made by the compiler itself.
using FileId = uint32_t;

/// A stretch of one source line. Lines and columns count from 1; columns count bytes; `end` is one past the
/// last column. line 0: nowhere.
struct SourceRange {
  FileId file = 0;
  uint32_t line = 0;
  uint32_t column = 0;
  uint32_t end = 0;

  bool valid() const { return line != 0; }
  bool operator==(const SourceRange&) const = default;
};

/// The smallest range covering both; when they are on different lines, `first` to the end of its own.
SourceRange join(SourceRange first, SourceRange last);

/// The text of all files one compilation looked at. File names are as the user or the #include wrote them.
class SourceManager {
public:
  SourceManager();
  FileId add(std::string name, std::string text);
  /// The id of the file of this name, if it was added.
  FileId find(std::string_view name) const;
  /// The #include by which a file came in; nowhere for others.
  void set_included_from(FileId file, SourceRange where) { files_[file].included_from = where; }
  SourceRange included_from(FileId file) const {
    return file < files_.size() ? files_[file].included_from : SourceRange{};
  }
  /// Ids in use are 1 to count() - 1.
  size_t count() const { return files_.size(); }
  std::string_view name(FileId) const;
  std::string_view text(FileId) const;
  /// Line `line` (from 1) without its line end; empty when there is none. LF, CR and CRLF all end lines.
  std::string_view line(FileId, uint32_t line) const;

private:
  struct File {
    std::string name, text;
    std::deque<uint32_t> line_starts;
    SourceRange included_from;
  };
  std::deque<File> files_;
};

} // namespace slvm
