// Using Anemone from another program: compile shaders from text, give one a parameter, run them on grids of
// points in two threads, read the colours. No renderer takes part: Scene answers what a shader might ask one.
// docs/embedding.md goes through it step by step.
#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"
#include "slvm/machine.h"

#include <cmath>
#include <cstdio>
#include <thread>

namespace {

constexpr const char* kSurface = R"(
surface ramp(float gain = 1; color tint = color(1, 0.5, 0.25); output varying float height = 0;) {
  float exposure = 0;
  if (option("user:exposure", exposure) == 0) exposure = 1;
  if (gain > 1) warning("gain is %g", gain);
  height = s * t;
  illuminance (P, N, PI / 2)
    Ci += exposure * gain * height * tint * Cl;
  Oi = 1;
}
)";
constexpr const char* kLight = R"(
light sun(float intensity = 1;) { solar(vector(0, 0, -1), 0) Cl = intensity; }
)";

/// A scene of one light and one option, whose world is the space that everything is in.
class Scene : public slvm::RendererServices {
public:
  explicit Scene(const slvm::Instance& light) : lights_{&light} {}

  bool space_to_current(const slvm::ShadingState&, std::string_view space, slvm::Matrix4& m) override {
    m = {};
    return space == "world";
  }
  bool current_to_space(const slvm::ShadingState& state, std::string_view space, slvm::Matrix4& m) override {
    return space_to_current(state, space, m);
  }
  std::span<const slvm::Instance* const> lights(const slvm::ShadingState&) override { return lights_; }
  bool attribute(const slvm::ShadingState&, std::string_view, slvm::Value&) override { return false; }
  bool option(const slvm::ShadingState&, std::string_view name, slvm::Value& out) override {
    out = {slvm::Type::kFloat, 0, {0.5f}, {}};
    return name == "user:exposure";
  }
  bool renderer_info(const slvm::ShadingState&, std::string_view, slvm::Value&) override { return false; }
  void print(const slvm::ShadingState&, std::string_view text) override {
    std::fwrite(text.data(), 1, text.size(), stdout);
  }

private:
  const slvm::Instance* lights_[1];
};

/// The bytes of a .slo file; empty after errors, which are printed.
std::vector<std::byte> compile(const char* name, const char* source) {
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  slc::Compiler compiler;
  slc::CompileOptions options;
  auto evaluator = slvm::make_kernel_evaluator(); // folds constants with the machine's own kernels
  options.evaluator = evaluator.get();
  auto shaders = compiler.compile(sources.add(name, source), options, sources, diagnostics);
  std::fputs(slvm::format_diagnostics(diagnostics, sources).c_str(), stderr);
  return shaders.empty() ? std::vector<std::byte>() : slvm::write_slo(shaders[0].program);
}

/// A shader with parameter values; null after errors, which are printed.
std::unique_ptr<slvm::Instance> instantiate(const slvm::Machine& machine, const std::vector<std::byte>& slo,
                                            std::span<const slvm::ParamValue> values) {
  auto shader = machine.load(slo);
  if (!shader) return std::fprintf(stderr, "load: %s\n", shader.error().c_str()), nullptr;
  auto instance = machine.instantiate(*shader, values);
  if (!instance) return std::fprintf(stderr, "instantiate: %s\n", instance.error().c_str()), nullptr;
  return std::move(*instance);
}

/// Shades a patch of the plane and counts the points whose values are not those expected.
int shade_patch(const slvm::Machine& machine, Scene& scene, const slvm::Instance& surface, float first_t) {
  slvm::ShadingContext context(machine, scene);
  constexpr int kWidth = 16, kHeight = 8;
  slvm::Grid grid(kWidth, kHeight);
  float* s = grid.varying(slvm::Global::ks);
  float* t = grid.varying(slvm::Global::kt);
  for (size_t i = 0; i < grid.points(); ++i) {
    s[i] = static_cast<float>(i % kWidth) / (kWidth - 1);
    t[i] = first_t + static_cast<float>(i / kWidth) / (kHeight - 1);
  }
  const float normal[] = {0, 0, 1}, black[] = {0, 0, 0};
  grid.set_uniform(slvm::Global::kN, normal);
  grid.set_uniform(slvm::Global::kCs, black);
  slvm::ShaderSet shaders;
  shaders.surface = &surface;
  context.shade(shaders, grid);

  const slvm::Planes& colour = grid.variable(slvm::Global::kCi);
  const slvm::Planes* height = context.output(surface, "height");
  if (!height) return std::fputs("no output parameter 'height'\n", stderr), 1;
  int wrong = 0;
  for (size_t i = 0; i < grid.points(); ++i) {
    float expected = s[i] * t[i]; // exposure 0.5, gain 2, tint 1
    bool fits =
        std::fabs(height->get(0, i) - expected) < 1e-5f && std::fabs(colour.get(0, i) - expected) < 1e-5f;
    wrong += fits ? 0 : 1;
  }
  return wrong;
}

} // namespace

int main() {
  // Once for a program: the machine. Once for a shader: compile, load. Once for a set of values: instantiate.
  slvm::Machine machine;
  slvm::ParamValue gain{"gain", {slvm::Type::kFloat, 0, {2.0f}, {}}};
  auto surface = instantiate(machine, compile("ramp.sl", kSurface), std::span(&gain, 1));
  auto light = instantiate(machine, compile("sun.sl", kLight), {});
  if (!surface || !light) return 1;

  // Once for a thread: a context. Once for a batch of points: a grid.
  Scene scene(*light);
  int wrong[2] = {};
  std::thread first([&] { wrong[0] = shade_patch(machine, scene, *surface, 0); });
  std::thread second([&] { wrong[1] = shade_patch(machine, scene, *surface, 1); });
  first.join();
  second.join();

  for (const slvm::RuntimeMessage& m : machine.messages())
    std::printf("%s:%u: %s (%s, %llu of %llu points)\n", m.file.c_str(), m.line, m.text.c_str(),
                m.shader.c_str(), static_cast<unsigned long long>(m.points),
                static_cast<unsigned long long>(m.total));
  std::printf("%d points wrong\n", wrong[0] + wrong[1]);
  return wrong[0] + wrong[1] == 0 ? 0 : 1;
}
