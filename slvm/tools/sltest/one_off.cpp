#include "slvm/tools/sltest/one_off.h"

#include "slvm/kernels/table.h"
#include "slvm/support/diagnostics.h"
#include "slvm/tools/sltest/expect.h"
#include "slvm/tools/sltest/expression.h"
#include "slvm/tools/sltest/image.h"
#include "slvm/tools/sltest/point_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace slvm::sltest {
namespace {

int status_of(Failure failure) {
  switch (failure) {
  case Failure::kMissing: return kMissing;
  case Failure::kSetup: return kUsage;
  default: return kFailed;
  }
}

/// Runs on several threads; each does its share of the iterations on a grid of its own.
struct ParallelRun {
  std::vector<RunResult> results; // one a thread
  std::vector<double> best, total;

  ParallelRun(const Binding& binding, int threads, int iterations) {
    const size_t count = static_cast<size_t>(std::clamp(threads, 1, iterations));
    results.resize(count);
    best.assign(count, INFINITY);
    total.assign(count, 0);
    std::vector<std::thread> pool;
    for (size_t t = 0; t < count; ++t)
      pool.emplace_back([&, t, n = static_cast<size_t>(iterations)] {
        Worker worker(binding);
        for (size_t i = t; i < n; i += count) {
          const double seconds = worker.shade();
          best[t] = std::min(best[t], seconds);
          total[t] += seconds;
        }
        results[t] = worker.result();
      });
    for (std::thread& thread : pool)
      thread.join();
  }
};

class OneOff {
public:
  OneOff(const Options& options, ShaderLibrary& library)
      : options_(options), library_(library), setup_(options.setup), watch_(options.watch) {}

  Outcome run() {
    const auto start = std::chrono::steady_clock::now();
    complete_setup();
    if (!options_.expression.empty()) library_.add_source("--expr", options_.expression);
    RunError error;
    RunConfig config = options_.config;
    if (!config.target.empty() && !find_kernel_table(config.target)) return unknown_target();
    if (!prepare(setup_, library_, prepared_, error)) return failure(error);
    auto binding = Binding::make(setup_, prepared_, library_, config, error);
    if (!binding) return failure(error);
    if (!check_primvars(binding->main().shader().program())) return outcome_;
    outcome_.err += binding->warnings();
    const double setup_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    int threads = options_.threads;
    if (threads == 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    ParallelRun run(*binding, threads, options_.iterations);
    for (RunResult& result : run.results)
      result.messages = binding->messages(); // now that all have come to an end
    result_ = std::move(run.results[0]);
    for (size_t t = 1; t < run.results.size(); ++t)
      compare(run.results[t]);
    report_messages();
    outcome_.out += result_.printed;
    if (!watch(config)) return outcome_;
    store();
    const WatchOptions& w = options_.watch;
    const bool reports = options_.run_stats || w.coverage || w.profile || w.probe;
    if (options_.print || (options_.outputs.empty() && !reports)) print();
    if (w.probe && (options_.print || !stores(w.probe->name))) print_probe();
    if (options_.run_stats) print_stats(run, setup_seconds);
    outcome_.out += watch_.report();
    return outcome_;
  }

private:
  Outcome failure(const RunError& error) {
    outcome_.status = status_of(error.failure);
    outcome_.err += error.text.ends_with('\n') ? error.text : fmt::format("sltest: {}\n", error.text);
    return outcome_;
  }

  Outcome unknown_target() {
    std::string names;
    for (const char* name : kernel_targets())
      names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    return {kUsage, "",
            fmt::format("sltest: no target '{}' here; there are {}\n", options_.config.target, names)};
  }

  void complete_setup() {
    const bool code = !options_.expression.empty();
    setup_.shader.form = code ? ShaderForm::kExpression : ShaderForm::kFile;
    setup_.prelude = options_.prelude;
    setup_.shader.text = code ? options_.expression : options_.inputs.at(0);
    setup_.path = options_.path;
    setup_.path.insert(setup_.path.begin(), ".");
  }

  /// A primitive variable that nothing reads is a mistyped name.
  bool check_primvars(const Program& program) {
    for (const Setting& s : setup_.primvars) {
      auto named = [&](const Param& p) { return p.name == s.what.name; };
      const bool known = setup_.shader.form == ShaderForm::kExpression
                             ? mentions(setup_.shader.text, s.what.name)
                             : std::any_of(program.params.begin(), program.params.end(), named);
      if (known) continue;
      std::vector<std::string_view> names;
      for (int g = 0; g < kGlobalCount; ++g)
        names.push_back(global_info(static_cast<Global>(g)).name);
      for (const Param& p : program.params)
        names.push_back(p.name);
      std::string text = fmt::format("sltest: --set {}: no such variable or parameter", s.what.name);
      if (std::string_view near = nearest_name(s.what.name, names); !near.empty())
        text += fmt::format("; did you mean '{}'?", near);
      outcome_ = {kUsage, "", text + "\n"};
      return false;
    }
    return true;
  }

  void compare(const RunResult& other) {
    const std::string text = difference(result_, other, prepared_.grid, 0);
    if (text.empty()) return;
    outcome_.status = kInternal;
    outcome_.err += fmt::format("sltest: threads disagree: {}\n", text);
  }

  void report_messages() {
    for (const RuntimeMessage& m : result_.messages)
      outcome_.err += fmt::format("{}:{}: {}: {} ({}, {} of {} points)\n", m.file, m.line,
                                  m.severity == MessageSeverity::kError ? "error" : "warning", m.text,
                                  m.shader, m.points, m.total);
  }

  const Variable* variable(const std::string& name) {
    const Variable* v = result_.find(name);
    if (!v) v = prepared_.grid.find(name);
    if (v) return v;
    std::vector<std::string_view> names;
    for (const Variable& known : result_.outputs)
      names.push_back(known.name);
    outcome_.status = std::max<int>(outcome_.status, kUsage);
    outcome_.err +=
        fmt::format("sltest: -o {}: no such result; there are {}\n", name, fmt::join(names, ", "));
    return nullptr;
  }

  void store() {
    for (const auto& [name, file] : options_.outputs) {
      const Variable* v = variable(name);
      if (!v || file == "null") continue;
      auto written = write_variable(file, *v, prepared_.grid.nu, prepared_.grid.nv);
      if (written) continue;
      outcome_.status = std::max<int>(outcome_.status, kFailed);
      outcome_.err += fmt::format("sltest: {}\n", written.error());
    }
  }

  /// What is printed: the variables of -o; else the result of code, or what it sets; else all results of a
  /// shader.
  std::vector<const Variable*> printed_variables() {
    std::vector<const Variable*> list;
    for (const auto& [name, file] : options_.outputs)
      if (const Variable* v = result_.find(name) ? result_.find(name) : prepared_.grid.find(name))
        list.push_back(v);
    if (!options_.outputs.empty()) return list;
    const bool code = setup_.shader.form == ShaderForm::kExpression, has_result = result_.find(kResultName);
    for (const Variable& v : result_.outputs)
      if (!code || (has_result ? v.name == kResultName : mentions(setup_.shader.text, v.name)))
        list.push_back(&v);
    return list;
  }

  void print() {
    const std::vector<const Variable*> list = printed_variables();
    if (list.empty()) return;
    for (int y = 0; y < prepared_.grid.nv; ++y)
      for (int x = 0; x < prepared_.grid.nu; ++x) {
        outcome_.out += fmt::format("Pixel ({}, {}):\n", x, y);
        const size_t point =
            static_cast<size_t>(y) * static_cast<size_t>(prepared_.grid.nu) + static_cast<size_t>(x);
        for (const Variable* v : list)
          outcome_.out += fmt::format("  {} : {}\n", v->name,
                                      v->type == Type::kString ? fmt::format("{}", fmt::join(v->strings, " "))
                                                               : numbers_text(v->at(point)));
      }
  }

  /// The runs that are watched. False: there is nothing to probe.
  bool watch(const RunConfig& config) {
    for (const std::string& text : watch_.run(setup_, prepared_, library_, config, options_.iterations))
      bad(text);
    if (options_.watch.nan) report_bad_numbers();
    if (auto written = watch_.write_pages(); !written) bad("sltest: " + written.error());
    if (!options_.watch.probe) return true;
    RunError error;
    probe_ = watch_.probe(setup_, prepared_, library_, config, error);
    if (!probe_) {
      failure(error);
      return false;
    }
    Variable v = probe_->variable();
    std::erase_if(result_.outputs, [&](const Variable& old) { return old.name == v.name; });
    result_.outputs.push_back(std::move(v));
    return true;
  }

  void bad(const std::string& text) {
    outcome_.status = std::max<int>(outcome_.status, kFailed);
    outcome_.err += text + '\n';
  }

  /// What is not finite when all is done; where it arises was told before, unless it came out of an array.
  void report_bad_numbers() {
    for (const Variable& v : result_.outputs) {
      PointSet points;
      size_t first = 0;
      for (size_t i = v.points(); i-- > 0 && !v.numbers.empty();) {
        const std::vector<float> numbers = v.at(i);
        if (std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); })) continue;
        points.add(i, v.points());
        first = i;
      }
      if (!points.empty())
        bad(fmt::format("sltest: {}: not finite at {}; first {}", v.name,
                        points.text(static_cast<size_t>(prepared_.grid.nu)), numbers_text(v.at(first))));
    }
  }

  /// Whether -o takes this variable.
  bool stores(const std::string& name) const {
    return std::any_of(options_.outputs.begin(), options_.outputs.end(),
                       [&](const auto& output) { return output.first == name; });
  }

  void print_probe() {
    const std::string& name = options_.watch.probe->name;
    for (size_t i = 0; i < prepared_.grid.points(); ++i) {
      const size_t nu = static_cast<size_t>(prepared_.grid.nu);
      outcome_.out += fmt::format("Pixel ({}, {}):\n  {} : ", i % nu, i / nu, name);
      if (!probe_->reached(i)) {
        outcome_.out += "not reached\n";
        continue;
      }
      const std::vector<Probe::Pass>& passes = probe_->passes(i);
      std::string text;
      for (size_t k = options_.each_pass ? 0 : passes.size() - 1; k < passes.size(); ++k)
        text += (text.empty() ? "" : " | ") + numbers_text(passes[k].numbers) + passes[k].text;
      outcome_.out += text + '\n';
    }
  }

  void print_stats(const ParallelRun& run, double setup_seconds) {
    double total = 0;
    for (double t : run.total)
      total += t;
    const double mean = total / options_.iterations,
                 best = *std::min_element(run.best.begin(), run.best.end());
    const double points = static_cast<double>(prepared_.grid.points());
    const KernelTable* target =
        options_.config.target.empty() ? &kernel_table() : find_kernel_table(options_.config.target);
    outcome_.out += fmt::format("Setup    : {:.3f} ms (read or compile, bind)\n", 1e3 * setup_seconds);
    outcome_.out += fmt::format("Run      : {:.3f} ms mean, {:.3f} ms best of {} (threads: {})\n", 1e3 * mean,
                                1e3 * best, options_.iterations, run.results.size());
    outcome_.out += fmt::format("Speed    : {:.2f} million points/s ({} points)\n", points / best / 1e6,
                                prepared_.grid.points());
    outcome_.out += fmt::format("Target   : {}, strips of {}\n", target->target, options_.config.strip);
  }

  const Options& options_;
  ShaderLibrary& library_;
  Setup setup_;
  Prepared prepared_;
  RunResult result_;
  Outcome outcome_;
  Watch watch_;
  std::unique_ptr<Probe> probe_;
};

} // namespace

Outcome run_one_off(const Options& options, ShaderLibrary& library) {
  return OneOff(options, library).run();
}

} // namespace slvm::sltest
