// How long a case takes: to compile, to bind, and for each point.
#pragma once

#include "slvm/tools/sltest/run.h"
#include "slvm/tools/sltest/test_case.h"

#include <string>
#include <vector>

namespace slvm::sltest {

struct BenchResult {
  std::string name; ///< of the case, with the values of its sweeps
  Where where;
  size_t points = 0, runs = 0;
  double compile = 0;          ///< seconds, of the shader under test; for a .slo: reading it
  double bind = 0;             ///< seconds, of all shaders: verifying and specialising them
  double median = 0, best = 0; ///< seconds a run
  std::string error;           ///< why there are no times

  double ns_per_point() const { return 1e9 * median / static_cast<double>(points); }
};

/// One result for each combination of the sweeps; of a table only the variant with the most points.
std::vector<BenchResult> bench_case(const Case& c, ShaderLibrary& library, const RunConfig& config);

std::string bench_text(const std::vector<BenchResult>& results, const RunConfig& config);

} // namespace slvm::sltest
