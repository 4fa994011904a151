// The text forms of a preprocessor run: make rules and the output of -E.
#pragma once

#include "slc/preprocess/preprocess.h"

namespace slc {

/// Names of files as a make rule has them: separated by blanks, and blanks in them escaped.
std::string make_names(const std::vector<std::string>& names);
/// `targets: source header...`, long lists on several lines. `targets` stand as they are.
std::string dependency_rule(const std::string& targets, const std::string& source,
                            const std::vector<Dependency>&, bool with_system);

/// The preprocessed text with `#line` directives wherever lines were left out.
std::string with_line_markers(const PreprocessedText&, const slvm::SourceManager&);

} // namespace slc
