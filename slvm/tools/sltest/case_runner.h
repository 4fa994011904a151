// Runs a case: once to check what is expected, then in all the other ways in which the results must be the
// same.
#pragma once

#include "slvm/tools/sltest/bench.h"
#include "slvm/tools/sltest/golden.h"
#include "slvm/tools/sltest/watch.h"

#include <string>
#include <vector>

namespace slvm::sltest {

struct RunnerOptions {
  bool quick = false; ///< one configuration only
  RunConfig config;   ///< the one that expectations are checked in
  Watch* watch = nullptr;
  GoldenOptions goldens;
};

/// Failures without a place (an empty file name) name one in their text.
struct CaseReport {
  const Case* test = nullptr;
  std::vector<CheckFailure> failures;
  size_t runs = 0;
  double seconds = 0;
  std::vector<std::string> updated; ///< pictures that were written
  std::vector<BenchResult> bench;   ///< where times were asked for

  bool passed() const { return failures.empty(); }
};

/// Strip widths 16, 48, 128 and the whole grid, with and without specialisation, must give the same bits; -O0
/// and -O2 numbers that differ by at most 1e-6; other instruction sets must meet the expectations too.
CaseReport run_case(const Case& c, ShaderLibrary& library, const RunnerOptions& options);

} // namespace slvm::sltest
