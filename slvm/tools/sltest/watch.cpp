#include "slvm/tools/sltest/watch.h"

#include "slvm/format/slo.h"
#include "slvm/tools/sltest/hunters.h"

#include <fmt/format.h>

#include <algorithm>

namespace slvm::sltest {
namespace {

/// Lines of the profile that are shown.
constexpr size_t kShownLines = 20;

bool run_marked(const Setup& setup, const Prepared& prepared, ShaderLibrary& library, RunConfig config,
                Instrumenter& marks, ExecutionObserver& observer, RunError& error) {
  config.opt_level = 0;
  config.specialise = false;
  config.instrumenter = &marks;
  auto binding = Binding::make(setup, prepared, library, config, error);
  if (!binding) return false;
  Worker worker(*binding);
  worker.observe(&observer);
  worker.shade();
  return true;
}

template <class Hunter>
void hunt(const Setup& setup, const Prepared& prepared, ShaderLibrary& library, const RunConfig& config,
          const InstrumentOptions& options, std::vector<std::string>& findings) {
  Instrumenter marks(options);
  Hunter hunter(marks);
  RunError error;
  if (!run_marked(setup, prepared, library, config, marks, hunter, error))
    return findings.push_back(error.text);
  if (options.reads && !marks.met_sources())
    findings.push_back("--debuguninit: the shader is compiled; only sources (.sl) can be followed");
  for (std::string& text : hunter.findings())
    findings.push_back(std::move(text));
}

/// A line of a source file, or "".
std::string source_line(const std::string& file, uint32_t line) {
  auto bytes = read_file(file);
  if (!bytes || !line) return "";
  const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  size_t at = 0;
  while (--line && at != std::string::npos)
    at = text.find('\n', at) == std::string::npos ? std::string::npos : text.find('\n', at) + 1;
  if (at == std::string::npos) return "";
  const size_t first = std::min(text.find_first_not_of(" \t", at), text.size());
  return text.substr(first, std::max(text.find('\n', at), first) - first);
}

std::string profile_text(const std::vector<ProfileLine>& lines) {
  double total = 0;
  for (const ProfileLine& l : lines)
    total += l.seconds;
  std::string text =
      fmt::format("Profile: {:.3f} ms\n        ms      %      points  instr.  line\n", 1e3 * total);
  for (size_t i = 0; i < lines.size() && i < kShownLines; ++i) {
    const ProfileLine& l = lines[i];
    const std::string place = l.line ? fmt::format("{}:{}", l.file, l.line) : "(no line)";
    text += fmt::format("  {:8.3f}  {:5.1f}  {:10}  {:6}  {}  {}", 1e3 * l.seconds,
                        total > 0 ? 100 * l.seconds / total : 0, l.points, l.instructions, place,
                        source_line(l.file, l.line));
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  if (lines.size() > kShownLines) text += fmt::format("  and {} lines more\n", lines.size() - kShownLines);
  return text;
}

} // namespace

Watch::Watch(const WatchOptions& options)
    : options_(options), coverage_marks_({.statements = true, .conditions = true}),
      coverage_(coverage_marks_) {}

std::vector<std::string> Watch::run(const Setup& setup, const Prepared& prepared, ShaderLibrary& library,
                                    const RunConfig& config, int profiled_runs) {
  std::vector<std::string> findings;
  RunError error;
  if (options_.nan) hunt<NanHunter>(setup, prepared, library, config, {.statements = true}, findings);
  if (options_.uninit) hunt<UninitHunter>(setup, prepared, library, config, {.reads = true}, findings);
  if (options_.coverage) {
    RunConfig tested = config;
    tested.instrument_all = false;
    if (!run_marked(setup, prepared, library, tested, coverage_marks_, coverage_, error))
      findings.push_back(error.text);
  }
  if (options_.profile) {
    auto binding = Binding::make(setup, prepared, library, config, error);
    if (!binding) {
      findings.push_back(error.text);
      return findings;
    }
    Worker worker(*binding);
    worker.shade(); // memory is taken, strings are known
    Profiler profiler;
    worker.observe(&profiler);
    for (int i = 0; i < profiled_runs; ++i)
      worker.shade();
    profiler_.merge(profiler);
  }
  return findings;
}

std::unique_ptr<Probe> Watch::probe(const Setup& setup, const Prepared& prepared, ShaderLibrary& library,
                                    const RunConfig& config, RunError& error) {
  probe_marks_ = std::make_unique<Instrumenter>(InstrumentOptions{.probe = options_.probe});
  auto probe = std::make_unique<Probe>(*probe_marks_);
  if (!run_marked(setup, prepared, library, config, *probe_marks_, *probe, error)) return nullptr;
  std::string problem = probe_marks_->probe_problem();
  if (problem.empty() && !probe_marks_->met_sources())
    problem = "the shader is compiled; only sources (.sl) can be probed";
  if (problem.empty()) return probe;
  error = {Failure::kSetup, "--probe: " + problem};
  return nullptr;
}

std::string Watch::report() const {
  std::string text;
  if (options_.profile) text += profile_text(profiler_.lines());
  if (options_.coverage) text += coverage_text(coverage_.files());
  return text;
}

Result<bool> Watch::write_pages() const {
  if (options_.coverage_folder.empty()) return true;
  return write_coverage_pages(options_.coverage_folder, coverage_.files());
}

} // namespace slvm::sltest
