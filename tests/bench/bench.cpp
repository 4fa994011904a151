// What running shaders costs: each benchmark shader on a grid by the virtual machine and by a hand-written
// loop (by_hand.cpp), as nanoseconds per point and their ratio, taken in one run; first their results are
// compared. Shaders that shoot rays stand beside tracing the same rays without the machine (rays.cpp). Also
// compiling and binding. Usage: anemone_bench [--benchmark_...]
#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"
#include "slvm/kernels/table.h"
#include "slvm/machine.h"
#include "tests/bench/by_hand.h"
#include "tests/bench/rays.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

namespace {

constexpr int kSide = 32;   // points a side: a grid of a typical size
constexpr float kRays = 64; // a point, in the benchmarks of rays

/// A scene of lights and of balls that rays hit.
class LitScene : public slvm::RendererServices {
public:
  std::vector<const slvm::Instance*> list;
  bench::BallScene balls;

  bool space_to_current(const slvm::ShadingState&, std::string_view, slvm::Matrix4&) override {
    return false;
  }
  bool current_to_space(const slvm::ShadingState&, std::string_view, slvm::Matrix4&) override {
    return false;
  }
  std::span<const slvm::Instance* const> lights(const slvm::ShadingState&) override { return list; }
  bool attribute(const slvm::ShadingState&, std::string_view, slvm::Value&) override { return false; }
  bool option(const slvm::ShadingState&, std::string_view, slvm::Value&) override { return false; }
  bool renderer_info(const slvm::ShadingState&, std::string_view, slvm::Value&) override { return false; }
  void print(const slvm::ShadingState&, std::string_view) override {}
  slvm::RayServices* rays() override { return &balls; }
};

[[noreturn]] void fail(const std::string& text) {
  fmt::print(stderr, "anemone_bench: {}\n", text);
  std::exit(1);
}

std::string read_text(const std::string& path) {
  std::ifstream in(path);
  if (!in) fail("cannot read " + path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<slc::CompiledShader> compile(const slc::Compiler& compiler, const std::string& name,
                                         const std::string& text) {
  static const auto kEvaluator = slvm::make_kernel_evaluator();
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  slc::CompileOptions options;
  options.evaluator = kEvaluator.get();
  auto shaders = compiler.compile(sources.add(name, text), options, sources, diagnostics);
  if (shaders.empty()) fail(slvm::format_diagnostics(diagnostics, sources));
  return shaders;
}

/// Everything the benchmarks share: machine, lights, a curved grid.
class Setup {
public:
  Setup() : context(machine, scene), grid(kSide, kSide) {
    float* p = grid.varying(slvm::Global::kP);
    float* n = grid.varying(slvm::Global::kN);
    float* ng = grid.varying(slvm::Global::kNg);
    float* i = grid.varying(slvm::Global::kI);
    float* s = grid.varying(slvm::Global::ks);
    float* t = grid.varying(slvm::Global::kt);
    size_t pitch = grid.pitch();
    for (size_t k = 0; k < grid.points(); ++k) {
      s[k] = static_cast<float>(k % kSide) / (kSide - 1);
      t[k] = static_cast<float>(k / kSide) / (kSide - 1);
      float x = 2 * s[k] - 1, y = 2 * t[k] - 1, z = 0.3f * (x * x + y * y);
      float position[3] = {x, y, z + 5}, normal[3] = {0.6f * x, 0.6f * y, -1};
      for (size_t c = 0; c < 3; ++c) {
        p[c * pitch + k] = i[c * pitch + k] = position[c];
        n[c * pitch + k] = ng[c * pitch + k] = normal[c];
      }
    }
    for (size_t c = 0; c < 3; ++c)
      by_hand[c].resize(pitch + 16);
    point_light = light("pointlight", {number("intensity", 20), point("from", {2, 3, 1})});
    distant_light =
        light("distantlight", {number("intensity", 0.6f), point("from", {0, 0, 0}), point("to", {1, -1, 2})});
  }

  std::unique_ptr<slvm::Instance> instance(const std::string& path,
                                           std::vector<slvm::ParamValue> values = {}) {
    auto shaders = compile(compiler, path, read_text(path));
    auto shader = machine.load(slvm::write_slo(shaders[0].program));
    if (!shader) fail(shader.error());
    auto instance = machine.instantiate(*shader, values);
    if (!instance) fail(instance.error());
    return std::move(*instance);
  }

  bench::Points points() {
    bench::Points out;
    out.count = grid.points();
    auto planes = [&](slvm::Global g, size_t c) { return grid.variable(g).data + c * grid.pitch(); };
    for (size_t c = 0; c < 3; ++c) {
      out.p[c] = planes(slvm::Global::kP, c);
      out.n[c] = planes(slvm::Global::kN, c);
      out.i[c] = planes(slvm::Global::kI, c);
      auto address = reinterpret_cast<uintptr_t>(by_hand[c].data());
      out.ci[c] = by_hand[c].data() + (64 - address % 64) % 64 / sizeof(float);
    }
    out.s = planes(slvm::Global::ks, 0);
    out.t = planes(slvm::Global::kt, 0);
    return out;
  }

  slc::Compiler compiler;
  slvm::Machine machine;
  LitScene scene;
  slvm::ShadingContext context;
  slvm::Grid grid;
  std::unique_ptr<slvm::Instance> point_light, distant_light;
  bench::Lights lights{{2, 3, 1}, 20, {1, -1, 2}, 0.6f};

private:
  static slvm::ParamValue number(const char* name, float x) {
    return {name, {slvm::Type::kFloat, 0, {x}, {}}};
  }
  static slvm::ParamValue point(const char* name, std::vector<float> x) {
    return {name, {slvm::Type::kPoint, 0, std::move(x), {}}};
  }
  std::unique_ptr<slvm::Instance> light(const std::string& name, std::vector<slvm::ParamValue> values) {
    return instance(fmt::format("{}/shaders/standard/{}.sl", SOURCE_FOLDER, name), std::move(values));
  }

  std::vector<float> by_hand[3];
};

struct Case {
  std::string name, path;
  bool lit = false;
  std::function<void(Setup&, const bench::Points&)> by_hand;
  std::shared_ptr<slvm::Instance> surface;
  bool shoots = false; ///< by hand the same rays are traced without the virtual machine
};

void shade(Setup& setup, const Case& c) {
  slvm::ShaderSet set;
  set.surface = c.surface.get();
  setup.context.shade(set, setup.grid);
}

/// Runs the shader; the scene keeps its rays.
void shade_keeping_rays(Setup& setup, const Case& c) {
  setup.scene.balls.kept.clear();
  setup.scene.balls.keeps = true;
  shade(setup, c);
  setup.scene.balls.keeps = false;
}

/// Both versions once; the greatest difference must be that of rounding.
void check(Setup& setup, const Case& c) {
  shade_keeping_rays(setup, c);
  bench::Points points = setup.points();
  c.by_hand(setup, points);
  const slvm::Planes& ci = setup.grid.variable(slvm::Global::kCi);
  size_t different = 0;
  float greatest = 0;
  for (size_t i = 0; i < points.count; ++i)
    for (size_t k = 0; k < 3; ++k) {
      float difference = std::fabs(ci.get(k, i) - points.ci[k][i]);
      greatest = std::max(greatest, difference);
      different += !(difference < 1e-4f);
    }
  if (different > 0) fail(fmt::format("{}: {} values differ, by up to {}", c.name, different, greatest));
}

/// Keeps the time of each benchmark for the table at the end.
class Collector : public benchmark::BenchmarkReporter {
public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration) {
        double& best = seconds.try_emplace(run.benchmark_name(), 1e9).first->second;
        best = std::min(best, run.real_accumulated_time / static_cast<double>(run.iterations));
      }
  }
  std::map<std::string, double> seconds;
};

void print_table(const std::vector<Case>& cases, const Collector& times, const char* target) {
  fmt::print("{} x {} points, one thread, {}; best of the repetitions\n\n", kSide, kSide, target);
  fmt::print("{:<12} {:>14} {:>14} {:>8}\n", "shader", "VM ns/point", "by hand", "ratio");
  for (const Case& c : cases) {
    auto vm = times.seconds.find("vm/" + c.name), hand = times.seconds.find("by_hand/" + c.name);
    if (vm == times.seconds.end() || hand == times.seconds.end()) continue;
    constexpr double kPoints = kSide * kSide;
    fmt::print("{:<12} {:>14.2f} {:>14.2f} {:>8.2f}\n", c.name, vm->second * 1e9 / kPoints,
               hand->second * 1e9 / kPoints, vm->second / hand->second);
  }
  fmt::print("\n");
  for (auto& [name, seconds] : times.seconds)
    if (!name.starts_with("vm/") && !name.starts_with("by_hand/"))
      fmt::print("{:<40} {:>10.3f} ms\n", name, seconds * 1e3);
}

void register_benchmarks(Setup& setup, std::vector<Case>& cases) {
  for (Case& c : cases) {
    benchmark::RegisterBenchmark(("vm/" + c.name).c_str(), [&setup, &c](benchmark::State& state) {
      setup.scene.list.clear();
      if (c.lit) setup.scene.list = {setup.point_light.get(), setup.distant_light.get()};
      for (auto _ : state)
        shade(setup, c);
    });
    benchmark::RegisterBenchmark(("by_hand/" + c.name).c_str(), [&setup, &c](benchmark::State& state) {
      bench::Points points = setup.points();
      if (c.shoots) shade_keeping_rays(setup, c);
      for (auto _ : state) {
        c.by_hand(setup, points);
        benchmark::ClobberMemory();
      }
    });
  }
  std::string text = read_text(SOURCE_FOLDER "/tests/bench/shaders/hundred_lines.sl");
  benchmark::RegisterBenchmark("compile 100 lines", [&setup, text](benchmark::State& state) {
    for (auto _ : state)
      benchmark::DoNotOptimize(compile(setup.compiler, "hundred_lines.sl", text));
  });
  auto shaders = compile(setup.compiler, "hundred_lines.sl", text);
  auto slo = slvm::write_slo(shaders[0].program);
  benchmark::RegisterBenchmark("load 100 lines", [&setup, slo](benchmark::State& state) {
    for (auto _ : state)
      benchmark::DoNotOptimize(setup.machine.load(slo));
  });
  auto shader = *setup.machine.load(slo);
  benchmark::RegisterBenchmark("bind 100 lines", [&setup, shader](benchmark::State& state) {
    for (auto _ : state)
      benchmark::DoNotOptimize(setup.machine.instantiate(shader, {}));
  });
}

} // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Setup setup;
  const std::string own = SOURCE_FOLDER "/tests/bench/shaders/";
  std::vector<Case> cases = {
      {"plastic", SOURCE_FOLDER "/shaders/standard/plastic.sl", true,
       [](Setup& s, const bench::Points& p) { bench::plastic_by_hand(p, s.lights); }, nullptr},
      {"fbm", own + "fbm.sl", false, [](Setup&, const bench::Points& p) { bench::fbm_by_hand(p); }, nullptr},
      {"marble", own + "marble.sl", false, [](Setup&, const bench::Points& p) { bench::marble_by_hand(p); },
       nullptr},
      {"divergent", own + "divergent.sl", false,
       [](Setup&, const bench::Points& p) { bench::divergent_by_hand(p); }, nullptr},
      {"rays: hit?", own + "rays_occlusion.sl", false,
       [](Setup& s, const bench::Points& p) {
         bench::occlusion_by_hand(s.scene.balls, kRays, p.count, p.ci);
       },
       nullptr, true},
      {"rays: Ci", own + "rays_bleeding.sl", false,
       [](Setup& s, const bench::Points& p) { bench::bleeding_by_hand(s.scene.balls, kRays, p.count, p.ci); },
       nullptr, true}};
  for (Case& c : cases) {
    c.surface = setup.instance(c.path);
    setup.scene.list.clear();
    if (c.lit) setup.scene.list = {setup.point_light.get(), setup.distant_light.get()};
    check(setup, c);
  }
  register_benchmarks(setup, cases);
  Collector times;
  benchmark::RunSpecifiedBenchmarks(&times);
  print_table(cases, times, setup.machine.kernels().target);
  return 0;
}
