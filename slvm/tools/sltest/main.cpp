// sltest: runs shaders on sample grids, and test files that say what they should compute. The one place that
// prints and decides the exit status. Read options.cpp for the command line, then one_off.cpp or
// case_runner.cpp.
#include "slvm/format/slo.h"
#include "slvm/tools/sltest/json_report.h"
#include "slvm/tools/sltest/one_off.h"
#include "slvm/tools/sltest/options.h"
#include "slvm/tools/sltest/report.h"
#include "slvm/tools/sltest/test_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <regex>

namespace slvm::sltest {
namespace {

void print(std::FILE* stream, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stream);
}

/// The folder of this program; shaders lie beside it, installed or freshly built.
std::filesystem::path program_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

std::vector<std::string> standard_folders() {
  const std::filesystem::path root = program_folder().parent_path();
  return {(root / "share/anemone/shaders").string(), (root / "shaders").string()};
}

/// Reads a test file and runs its cases. False: it could not be read.
bool run_file(const std::string& name, const std::string& text, const Options& options,
              ShaderLibrary& library, Watch& watch, std::deque<FileReport>& reports) {
  SourceManager sources;
  Diagnostics diags;
  FileReport& report = reports.emplace_back();
  report.file = read_test_file(name, text, options.path, sources, diags);
  print(stderr, format_diagnostics(diags, sources));
  if (diags.has_errors()) {
    report.unreadable = true;
    return false;
  }
  library.add_source(name, text);
  const std::regex filter(options.filter);
  for (const Case& c : report.file.cases) {
    if (!options.filter.empty() && !std::regex_search(c.name, filter)) continue;
    if (options.list) {
      print(stdout, fmt::format("{}: {}\n", to_string(c.where), c.name));
      continue;
    }
    const bool once = options.quick || options.bench;
    report.cases.push_back(run_case(c, library, {once, options.config, &watch, options.goldens}));
    if (options.bench) report.cases.back().bench = bench_case(c, library, options.config);
  }
  print(stdout, report_text(report, options.verbose));
  return true;
}

std::string bench_text(const std::deque<FileReport>& reports, const RunConfig& config) {
  std::vector<BenchResult> all;
  for (const FileReport& file : reports)
    for (const CaseReport& r : file.cases)
      all.insert(all.end(), r.bench.begin(), r.bench.end());
  return bench_text(all, config);
}

/// Writes what was asked for beside the text on the terminal.
int write_reports(const Options& options, const Watch& watch, const std::deque<FileReport>& reports) {
  int status = kOk;
  auto check = [&](const Result<bool>& written, ExitStatus failure) {
    if (written) return;
    print(stderr, fmt::format("sltest: {}\n", written.error()));
    status = std::max<int>(status, failure);
  };
  auto write = [&](const std::string& file, const std::string& text) {
    check(write_file(file, std::as_bytes(std::span(text.data(), text.size()))), kMissing);
  };
  check(watch.write_pages(), kFailed);
  if (!options.junit.empty()) write(options.junit, junit_text(reports));
  if (!options.json.empty()) {
    const std::vector<FileCoverage> coverage = watch.coverage();
    write(options.json, json_text(reports, options.watch.coverage ? &coverage : nullptr));
  }
  return status;
}

int run_tests(const Options& options, ShaderLibrary& library) {
  int status = kOk;
  std::deque<FileReport> reports;
  Watch watch(options.watch);
  for (const std::string& name : options.inputs) {
    auto bytes = read_file(name);
    if (!bytes) {
      print(stderr, fmt::format("sltest: {}\n", bytes.error()));
      reports.push_back({{name, {}}, true, {}});
      status = kMissing;
      continue;
    }
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    if (!run_file(name, text, options, library, watch, reports)) status = std::max<int>(status, kFailed);
  }
  if (options.list) return status;
  print(stdout, watch.report());
  if (options.bench) print(stdout, bench_text(reports, options.config));
  const auto empty = [](const FileReport& r) { return r.cases.empty(); };
  if (status == kOk || !std::all_of(reports.begin(), reports.end(), empty))
    print(stdout, summary_text(reports));
  status = std::max(status, write_reports(options, watch, reports));
  return all_passed(reports) ? status : std::max<int>(status, kFailed);
}

int run(int argc, const char* const* argv) {
  Options options;
  ParseOutcome parsed = parse_options(argc, argv, options);
  print(stdout, parsed.out);
  print(stderr, parsed.err);
  if (parsed.done) return parsed.status;
  for (std::string& folder : standard_folders())
    options.path.push_back(std::move(folder));
  ShaderLibrary library(options.config.plugin_folders);
  if (!options.inputs.empty() && options.inputs[0].ends_with(".toml")) return run_tests(options, library);
  Outcome outcome = run_one_off(options, library);
  print(stdout, outcome.out);
  print(stderr, outcome.err);
  return outcome.status;
}

} // namespace
} // namespace slvm::sltest

int main(int argc, char** argv) {
  try {
    return slvm::sltest::run(argc, argv);
  } catch (const std::regex_error& e) {
    slvm::sltest::print(stderr, fmt::format("sltest: --filter: {}\n", e.what()));
    return slvm::sltest::kUsage;
  } catch (const std::exception& e) {
    slvm::sltest::print(stderr, fmt::format("sltest: internal error: {}\n", e.what()));
    return slvm::sltest::kInternal;
  }
}
