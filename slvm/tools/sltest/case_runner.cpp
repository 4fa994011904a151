#include "slvm/tools/sltest/case_runner.h"

#include "slvm/kernels/table.h"
#include "slvm/tools/sltest/sweep.h"
#include "slvm/tools/sltest/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace slvm::sltest {
namespace {

constexpr double kBetweenLevels = 1e-6;
constexpr uint32_t kLaneGroup = 16; // strips are multiples of it

/// Strip widths that cut a grid of so many points differently.
std::vector<uint32_t> strip_widths(size_t points) {
  const uint32_t whole = (static_cast<uint32_t>(points) + kLaneGroup - 1) / kLaneGroup * kLaneGroup;
  std::vector<uint32_t> widths;
  for (uint32_t w : {16u, 48u, 128u})
    if (w < whole) widths.push_back(w);
  widths.push_back(whole);
  return widths;
}

class Runner {
public:
  Runner(const Case& c, ShaderLibrary& library, const RunnerOptions& options, CaseReport& report)
      : case_(c), library_(library), options_(options), report_(report) {}

  void run() {
    RunError error;
    if (!prepare(case_.setup, library_, prepared_, error)) return judge(error, "");
    RunConfig config = options_.config;
    config.specialise = config.specialise && case_.specialised;
    RunResult result;
    if (!run_once(case_.setup, prepared_, library_, config, result, error)) return judge(error, "");
    ++report_.runs;
    if (!case_.bind_error.empty()) return fail("binding should fail, but it succeeds");
    if (!case_.compile_error.empty()) return fail("compiling should fail, but it succeeds");
    check_all(result, "");
    if (options_.watch)
      for (const std::string& text : options_.watch->run(case_.setup, prepared_, library_, config))
        report_.failures.push_back({Where(), text + variant("")});
    if (!report_.failures.empty() || options_.quick || case_.quick) return;
    run_same_target(config, result);
    run_other_targets(config);
  }

private:
  void check_all(const RunResult& result, const std::string& target) {
    std::vector<CheckFailure> failures = check(case_, prepared_, result, library_);
    for (CheckFailure& f : check_goldens(case_, prepared_, result, options_.goldens, report_.updated))
      failures.push_back(std::move(f));
    for (CheckFailure& f : failures) {
      f.text += variant(target);
      report_.failures.push_back(std::move(f));
    }
  }

  void fail(const std::string& text) {
    // Text that begins with a place of its own needs no other.
    const bool placed = text.starts_with(case_.where.file + ":");
    report_.failures.push_back({placed ? Where() : case_.where, text + variant("")});
  }

  /// Which variant of a table it is, and which target, in brackets.
  std::string variant(const std::string& target) const {
    std::string text = case_.name.substr(std::min(report_.test->name.size(), case_.name.size()));
    if (text.starts_with(", ")) text.erase(0, 2);
    if (!target.empty()) text += (text.empty() ? "on " : ", on ") + target;
    return text.empty() ? "" : fmt::format(" [{}]", text);
  }

  /// An error that the case may expect.
  void judge(const RunError& error, const std::string& how) {
    const std::string& expected = error.failure == Failure::kCompile ? case_.compile_error
                                  : error.failure == Failure::kBind  ? case_.bind_error
                                                                     : std::string();
    if (!expected.empty() && error.text.find(expected) != std::string::npos) return;
    std::string text = error.text;
    while (text.ends_with('\n'))
      text.pop_back();
    if (!expected.empty())
      fail(fmt::format("expected an error with \"{}\", got: {}{}", expected, text, how));
    else
      fail(text + how);
  }

  bool wants(bool specialise) const { return specialise ? case_.specialised : case_.unspecialised; }

  bool rerun(const RunConfig& config, RunResult& result) {
    RunError error;
    ++report_.runs;
    if (run_once(case_.setup, prepared_, library_, config, result, error)) return true;
    judge(error, fmt::format(" ({})", describe(config)));
    return false;
  }

  /// Each level agrees with itself to the bit; the levels agree with each other nearly.
  void run_same_target(const RunConfig& first_config, const RunResult& first) {
    for (int level : {first_config.opt_level, first_config.opt_level == 0 ? 2 : 0}) {
      RunConfig reference_config = first_config;
      reference_config.opt_level = level;
      RunResult reference = first;
      if (level != first_config.opt_level) {
        if (!rerun(reference_config, reference)) return;
        if (differs(reference_config, reference, first_config, first, kBetweenLevels)) return;
      }
      for (uint32_t strip : strip_widths(prepared_.grid.points()))
        for (bool specialise : {true, false}) {
          RunConfig config = reference_config;
          config.strip = strip;
          config.specialise = specialise;
          if (!wants(specialise)) continue;
          RunResult result;
          if (!rerun(config, result)) return;
          if (differs(config, result, reference_config, reference, 0)) return;
        }
    }
  }

  bool differs(const RunConfig& config, const RunResult& result, const RunConfig& reference_config,
               const RunResult& reference, double relative) {
    std::string text = difference(reference, result, prepared_.grid, relative);
    if (text.empty()) return false;
    fail(fmt::format("runs disagree: {}\n    ({}; {})", text, describe(reference_config), describe(config)));
    return true;
  }

  void run_other_targets(const RunConfig& first_config) {
    if (!options_.config.target.empty()) return;
    for (const char* target : kernel_targets().subspan(std::min<size_t>(1, kernel_targets().size()))) {
      RunConfig config = first_config;
      config.target = target;
      RunResult result;
      if (!rerun(config, result)) return;
      check_all(result, target);
    }
  }

  const Case& case_;
  ShaderLibrary& library_;
  const RunnerOptions& options_;
  CaseReport& report_;
  Prepared prepared_;
};

} // namespace

CaseReport run_case(const Case& c, ShaderLibrary& library, const RunnerOptions& options) {
  CaseReport report;
  report.test = &c;
  const auto start = std::chrono::steady_clock::now();
  for (const Case& swept : expand_sweeps(c))
    for (const Case& variant : expand_table(swept))
      Runner(variant, library, options, report).run();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

} // namespace slvm::sltest
