// The command line: what to test, or the one-off form spelled like OSL's testshade.
#pragma once

#include "slvm/tools/sltest/golden.h"
#include "slvm/tools/sltest/run.h"
#include "slvm/tools/sltest/setup.h"
#include "slvm/tools/sltest/watch.h"

#include <string>
#include <utility>
#include <vector>

namespace slvm::sltest {

/// Exit statuses, the same for all of Anemone's tools.
enum ExitStatus : int { kOk = 0, kFailed = 1, kUsage = 2, kMissing = 3, kInternal = 4 };

struct Options {
  std::vector<std::string> inputs; ///< test files, or one shader
  std::string expression, prelude;
  // Test files
  std::string filter, junit, json;
  bool list = false, verbose = false, quick = false, bench = false;
  GoldenOptions goldens;
  // The one-off form
  Setup setup;                                              ///< without the shader
  std::vector<std::pair<std::string, std::string>> outputs; ///< variable, file or "null"
  bool no_specialise = false;
  bool print = false, run_stats = false, each_pass = false;
  int iterations = 1, threads = 1;
  // Both
  WatchOptions watch;
  RunConfig config;
  std::vector<std::string> path; ///< of --path
};

struct ParseOutcome {
  bool done = false; ///< nothing to run: exit with `status` after printing
  int status = kOk;
  std::string out, err;
};
ParseOutcome parse_options(int argc, const char* const* argv, Options& options);

} // namespace slvm::sltest
