// The text forms of a preprocessor run: make rules and the output of -E.
#pragma once

#include "slc/preprocess/preprocess.h"

namespace slc {

/// `targets: source header...`, long lists on several lines, blanks in names escaped.
std::string dependency_rule(const std::vector<std::string>& targets, const std::string& source,
                            const std::vector<Dependency>&, bool with_system);

/// The preprocessed text with `#line` directives wherever lines were left out.
std::string with_line_markers(const PreprocessedText&, const slvm::SourceManager&);

} // namespace slc
