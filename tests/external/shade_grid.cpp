// Using Anemone from another program: compile a shader from text, give it a parameter value, run it on a grid
// of points, read the colours. No renderer takes part: NoScene answers what a shader might ask one.
#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"
#include "slvm/machine.h"

#include <cmath>
#include <cstdio>

namespace {

constexpr const char* kSource = R"(
surface ramp(float gain = 1; color tint = color(1, 0.5, 0.25); output varying float height = 0;) {
  height = s * t;
  if (height > 0.25) height = sqrt(height);
  Ci = gain * height * tint;
  Oi = 1;
}
)";

/// A renderer without spaces, lights, attributes or options.
class NoScene : public slvm::RendererServices {
public:
  bool space_to_current(const slvm::ShadingState&, std::string_view, slvm::Matrix4&) override {
    return false;
  }
  bool current_to_space(const slvm::ShadingState&, std::string_view, slvm::Matrix4&) override {
    return false;
  }
  std::span<const slvm::Instance* const> lights(const slvm::ShadingState&) override { return {}; }
  bool attribute(const slvm::ShadingState&, std::string_view, slvm::Value&) override { return false; }
  bool option(const slvm::ShadingState&, std::string_view, slvm::Value&) override { return false; }
  bool renderer_info(const slvm::ShadingState&, std::string_view, slvm::Value&) override { return false; }
  void print(const slvm::ShadingState&, std::string_view text) override {
    std::fwrite(text.data(), 1, text.size(), stdout);
  }
};

/// The bytes of a .slo file; empty after errors, which are printed.
std::vector<std::byte> compile(const char* source) {
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  slc::Compiler compiler;
  slc::CompileOptions options;
  auto evaluator = slvm::make_kernel_evaluator(); // folds constants with the machine's own kernels
  options.evaluator = evaluator.get();
  auto shaders = compiler.compile(sources.add("ramp.sl", source), options, sources, diagnostics);
  std::fputs(slvm::format_diagnostics(diagnostics, sources).c_str(), stderr);
  return shaders.empty() ? std::vector<std::byte>() : slvm::write_slo(shaders[0].program);
}

} // namespace

int main() {
  std::vector<std::byte> slo = compile(kSource);
  if (slo.empty()) return 1;

  // Once for a program: the machine. Once for a shader: load. Once for a set of parameter values:
  // instantiate.
  slvm::Machine machine;
  auto shader = machine.load(slo);
  if (!shader) return std::fprintf(stderr, "load: %s\n", shader.error().c_str()), 1;
  slvm::ParamValue gain{"gain", {slvm::Type::kFloat, 0, {2.0f}, {}}};
  auto instance = machine.instantiate(*shader, std::span(&gain, 1));
  if (!instance) return std::fprintf(stderr, "instantiate: %s\n", instance.error().c_str()), 1;

  // Once for a thread: services and context. Once for a batch of points: the grid.
  NoScene scene;
  slvm::ShadingContext context(machine, scene);
  constexpr int kWidth = 16, kHeight = 8;
  slvm::Grid grid(kWidth, kHeight);
  float* s = grid.varying(slvm::Global::ks);
  float* t = grid.varying(slvm::Global::kt);
  for (size_t i = 0; i < grid.points(); ++i) {
    s[i] = static_cast<float>(i % kWidth) / (kWidth - 1);
    t[i] = static_cast<float>(i / kWidth) / (kHeight - 1);
  }
  slvm::ShaderSet shaders;
  shaders.surface = instance->get();
  context.shade(shaders, grid);

  const slvm::Planes& colour = grid.variable(slvm::Global::kCi);
  const slvm::Planes* height = context.output(**instance, "height");
  if (!height) return std::fputs("no output parameter 'height'\n", stderr), 1;
  int wrong = 0;
  for (size_t i = 0; i < grid.points(); ++i) {
    float expected = s[i] * t[i] > 0.25f ? std::sqrt(s[i] * t[i]) : s[i] * t[i];
    wrong +=
        std::fabs(height->get(0, i) - expected) > 1e-5f || std::fabs(colour.get(1, i) - expected) > 1e-5f;
  }
  size_t last = grid.points() - 1;
  std::printf("last of %zu points: Ci = (%g, %g, %g), height = %g; %d points wrong\n", grid.points(),
              static_cast<double>(colour.get(0, last)), static_cast<double>(colour.get(1, last)),
              static_cast<double>(colour.get(2, last)), static_cast<double>(height->get(0, last)), wrong);
  return wrong == 0 ? 0 : 1;
}
