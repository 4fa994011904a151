// A compiled shader with all that sloinfo tells of it, whatever it was read from.
#pragma once

#include "slc/lower/uses.h"
#include "slvm/format/program.h"
#include "slvm/format/stale.h"
#include "slvm/support/result.h"
#include "slvm/support/source.h"

#include <map>
#include <string>

namespace slc {

/// The lines of a shader's source, where its files are found: beside the shader, where they were, or in the
/// compiler.
class SourceLines {
public:
  SourceLines(const slvm::Program& program, const std::string& path);
  /// Without leading blanks; "" when the file is not found. `file`: index into Program::files.
  std::string text(uint32_t file, uint32_t line) const;

private:
  slvm::SourceManager sources_;
  std::vector<slvm::FileId> ids_; // by index into Program::files; 0: not found
};

struct Inspected {
  slvm::Program program;
  std::string path; ///< of the .slo or .sl
  Uses uses;

  std::string file_name(uint32_t file) const {
    return file < program.files.size() ? program.files[file] : std::string();
  }
};

/// Without `with_uses` these stay empty, and the IR unread. The error is for files whose IR is damaged.
slvm::Result<Inspected> inspect(slvm::Program program, std::string path, bool with_uses);

} // namespace slc
