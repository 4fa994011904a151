// Runs that are watched: what --debugnan, --debuguninit, --coverage, --profile and --probe add to the run of
// a setup. Each is one more run with an observer; all but the profile run code at -O0, in which every
// statement is.
#pragma once

#include "slvm/exec/profiler.h"
#include "slvm/tools/sltest/coverage.h"
#include "slvm/tools/sltest/probe.h"
#include "slvm/tools/sltest/run.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slvm::sltest {

struct WatchOptions {
  bool nan = false, uninit = false, coverage = false, profile = false;
  std::string coverage_folder; ///< for pages; "": none
  std::optional<ProbeTarget> probe;
};

/// Gathers what is found over all runs of a session.
class Watch {
public:
  explicit Watch(const WatchOptions& options);

  /// Runs the setup once more for each thing that is watched. Returns what is wrong with the shaders: places
  /// where numbers are not finite, or were never set. `profiled_runs`: how often it runs for the profile.
  std::vector<std::string> run(const Setup& setup, const Prepared& prepared, ShaderLibrary& library,
                               const RunConfig& config, int profiled_runs = 1);
  /// Runs the setup for --probe. Null: `error` says why there is nothing to show.
  std::unique_ptr<Probe> probe(const Setup& setup, const Prepared& prepared, ShaderLibrary& library,
                               const RunConfig& config, RunError& error);

  const WatchOptions& options() const { return options_; }
  std::vector<FileCoverage> coverage() const { return coverage_.files(); }
  /// What was gathered, as text.
  std::string report() const;
  /// Writes the pages that were asked for.
  Result<bool> write_pages() const;

private:
  const WatchOptions options_;
  Instrumenter coverage_marks_;
  Coverage coverage_;
  Profiler profiler_;
  std::unique_ptr<Instrumenter> probe_marks_;
};

} // namespace slvm::sltest
