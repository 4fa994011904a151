// Reading test files. Unknown keys, wrong types and missing parts are errors with their place in the file.
#pragma once

#include "slvm/support/diagnostics.h"
#include "slvm/tools/sltest/test_case.h"

namespace slvm::sltest {

/// Reads `text`, the test file `name`. `path` is searched for shaders after the file's own folder. On errors
/// the result is incomplete, and `diags` says why.
TestFile read_test_file(const std::string& name, const std::string& text,
                        const std::vector<std::string>& path, SourceManager& sources, Diagnostics& diags);

} // namespace slvm::sltest
