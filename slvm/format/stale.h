// Whether a .slo file still is what its source says: the hashes of sources stored in it, compared with the
// files that lie there now. PUBLIC. All programs that load .slo files ask here.
//
// A source with an absolute name is looked for there; any other beside the .slo, under the name the compiler
// was given and without its folders, then where that name leads from the current folder. Included files are
// looked for relative to it. What is not found says nothing: shaders travel without their sources.
#pragma once

#include "slvm/format/program.h"

#include <string>
#include <vector>

namespace slvm {

enum class SourceState : uint8_t { kSame, kChanged, kMissing };

struct SourceCheck {
  std::string name; ///< as in Program::sources
  std::string path; ///< where it was found; "" when it was not
  SourceState state = SourceState::kMissing;
};

/// One entry for each of program.sources. `slo_path`: the file the program was read from.
std::vector<SourceCheck> check_sources(const Program& program, const std::string& slo_path);

/// "plastic.slo is older than its source: plastic.sl has changed; compile it again with slc", or "" when no
/// source is known to have changed. `source_taken`: the program compiles the source instead, and the text
/// says so.
std::string stale_warning(const Program& program, const std::string& slo_path, bool source_taken = false);

/// Where a file of the source lies that is not necessarily one of program.sources: for showing its lines. ""
/// when it is not found.
std::string find_source(const Program& program, const std::string& slo_path, const std::string& name);

} // namespace slvm
