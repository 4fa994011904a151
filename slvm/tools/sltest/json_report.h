// What a run of tests found, as JSON for programs; docs/sltest.md describes it.
#pragma once

#include "slvm/tools/sltest/coverage.h"
#include "slvm/tools/sltest/report.h"

#include <string>
#include <vector>

namespace slvm::sltest {

/// `coverage`: null where it was not asked for.
std::string json_text(const std::deque<FileReport>& reports, const std::vector<FileCoverage>* coverage);

} // namespace slvm::sltest
