#include "slvm/tools/sltest/bench.h"

#include "slvm/kernels/table.h"
#include "slvm/tools/sltest/obtain.h"
#include "slvm/tools/sltest/sweep.h"
#include "slvm/tools/sltest/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace slvm::sltest {
namespace {

using Clock = std::chrono::steady_clock;

/// Runs are repeated until this many seconds are over; never fewer or more than so often.
constexpr double kSeconds = 0.1;
constexpr size_t kFewest = 5, kMost = 10000;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool measure(const Case& c, ShaderLibrary& library, const RunConfig& config, BenchResult& result,
             RunError& error) {
  Prepared prepared;
  if (!prepare(c.setup, library, prepared, error)) return false;
  result.points = prepared.grid.points();

  library.forget();
  Clock::time_point start = Clock::now();
  if (!obtain(c.setup, c.setup.shader, primvar_formals(prepared.grid), library, {config.opt_level}, error))
    return false;
  result.compile = since(start);

  if (!Binding::make(c.setup, prepared, library, config, error)) return false; // lights are compiled, too
  start = Clock::now();
  auto binding = Binding::make(c.setup, prepared, library, config, error);
  result.bind = since(start);

  Worker worker(*binding);
  worker.shade(); // memory is taken, strings are known
  std::vector<double> seconds;
  start = Clock::now();
  while (seconds.size() < kFewest || (since(start) < kSeconds && seconds.size() < kMost))
    seconds.push_back(worker.shade());
  std::sort(seconds.begin(), seconds.end());
  result.runs = seconds.size();
  result.best = seconds.front();
  result.median = seconds[seconds.size() / 2];
  return true;
}

} // namespace

std::vector<BenchResult> bench_case(const Case& c, ShaderLibrary& library, const RunConfig& config) {
  std::vector<BenchResult> results;
  if (!c.bind_error.empty() || !c.compile_error.empty()) return results;
  for (const Case& swept : expand_sweeps(c)) {
    const std::vector<Case> variants = expand_table(swept);
    const Case& largest =
        *std::max_element(variants.begin(), variants.end(), [](const Case& a, const Case& b) {
          return a.setup.grid.nu * a.setup.grid.nv < b.setup.grid.nu * b.setup.grid.nv;
        });
    BenchResult& result = results.emplace_back();
    result.name = swept.name;
    result.where = c.where;
    RunConfig own = config;
    own.specialise = config.specialise && c.specialised;
    RunError error;
    if (!measure(largest, library, own, result, error)) result.error = error.text;
  }
  return results;
}

std::string bench_text(const std::vector<BenchResult>& results, const RunConfig& config) {
  const KernelTable* target = config.target.empty() ? &kernel_table() : find_kernel_table(config.target);
  std::string text =
      fmt::format("Benchmark ({}, strips of {}, -O{})\n  ns/point    points  compile ms   bind ms  case\n",
                  target->target, config.strip, config.opt_level);
  for (const BenchResult& r : results)
    if (r.error.empty())
      text += fmt::format("{:10.2f}{:10}{:12.3f}{:10.3f}  {}: {}\n", r.ns_per_point(), r.points,
                          1e3 * r.compile, 1e3 * r.bind, to_string(r.where), r.name);
    else
      text += fmt::format("  {}: {}: cannot run\n", to_string(r.where), r.name);
  return text;
}

} // namespace slvm::sltest
