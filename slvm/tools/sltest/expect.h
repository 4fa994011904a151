// Checking what a run computed against what a case expects, and saying clearly what is off and where.
#pragma once

#include "slvm/tools/sltest/library.h"
#include "slvm/tools/sltest/run.h"
#include "slvm/tools/sltest/test_case.h"

#include <string>
#include <vector>

namespace slvm::sltest {

struct CheckFailure {
  Where where;
  std::string text;
};

/// Checks values, predicates, printed text and run-time messages.
std::vector<CheckFailure> check(const Case& c, const Prepared& prepared, const RunResult& result,
                                ShaderLibrary& library);

/// The first difference between two runs of a case, or "". `relative` 0 asks for the same bits (any NaN
/// equals any other); else numbers may differ by that much, relatively and absolutely.
std::string difference(const RunResult& a, const RunResult& b, const GridData& grid, double relative);

} // namespace slvm::sltest
