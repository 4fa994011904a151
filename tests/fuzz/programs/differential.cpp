// See differential.h. The reference is the code as written (-O0) run over the whole grid at once.
#include "tests/fuzz/programs/differential.h"

#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"
#include "slvm/machine.h"
#include "tests/fuzz/no_scene.h"
#include "tests/fuzz/programs/scene_of_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace slvm::test {
namespace {

constexpr int kNu = 17, kNv = 5; // no multiple of any vector
constexpr const char* kOutputs[] = {"of", "oc", "op", "ov", "on", "om", "oa"};

/// Three lights, three planes that rays hit, one space that is not "current"; remembers what is printed.
class Scene : public NoScene {
public:
  std::vector<const Instance*> light_list;
  std::string printed;

  bool space_to_current(const ShadingState&, std::string_view space, Matrix4& m) override {
    if (space == "tilted") m = tilted_;
    return space == "tilted";
  }
  bool current_to_space(const ShadingState&, std::string_view space, Matrix4& m) override {
    return space == "tilted" && invert(tilted_, m);
  }
  std::span<const Instance* const> lights(const ShadingState&) override { return light_list; }
  void print(const ShadingState&, std::string_view text) override { printed += text; }
  RayServices* rays() override { return &planes_; }

private:
  SceneOfPlanes planes_;
  Matrix4 tilted_ = {{0.8f, 0.6f, 0, 0, -0.6f, 0.8f, 0, 0, 0, 0, 2, 0, 1, -1, 3, 1}};
};

constexpr const char* kLights =
    "light sky() { Cl = color (0.1, 0.2, 0.3); L = 0; }\n"
    "light lamp(string __category = \"key\"; varying float w = 2;) {"
    "  float k = 0; surface(\"of\", k);"
    "  illuminate (point (0, 3, -2)) { Cl = (w + k) * color (1, s, mod(xcomp(Ps), 1)) / (L . L); } }\n"
    "light sun() { solar (vector (0, -1, 1), 0.2) { Cl = color (1, 0.5, zcomp(Ps)); } }\n";

/// Results by name: component planes one after the other.
using Results = std::map<std::string, std::vector<float>>;

struct Variant {
  const char* name;
  int level;
  MachineOptions machine;
  bool alone = false;
};

const std::vector<Variant>& variants() {
  static const std::vector<Variant> kVariants = {
      {"-O0", 0, {.strip_points = 4096, .specialise = false}},
      {"-O0 in strips of 16", 0, {.strip_points = 16, .specialise = false}},
      {"-O0 with poisoned registers", 0, {.specialise = false, .poison_registers = true}},
      {"-O1", 1, {.specialise = false}},
      {"-O2", 2, {.specialise = false}},
      {"-O2 in strips of 16", 2, {.strip_points = 16, .specialise = false}},
      {"-O2 specialised", 2, {.strip_points = 48, .specialise = true}},
      {"-O2 specialised, poisoned", 2, {.specialise = true, .poison_registers = true}},
      {"-O2, each point alone", 2, {.specialise = true}, true},
  };
  return kVariants;
}

// The part of the inputs that begins at a point: the whole grid, or one point of it.
Grid inputs(size_t first, int nu, int nv) {
  Grid grid(nu, nv);
  grid.id = 7;
  float *p = grid.varying(Global::kP), *n = grid.varying(Global::kN), *s = grid.varying(Global::ks),
        *t = grid.varying(Global::kt), *pv = grid.add_varying_primvar("pv", Type::kFloat);
  const size_t pitch = grid.pitch();
  for (size_t i = 0; i < grid.points(); ++i) {
    const auto x = static_cast<float>((first + i) % kNu), y = static_cast<float>((first + i) / kNu);
    s[i] = x / (kNu - 1);
    t[i] = y / (kNv - 1);
    p[i] = x * 0.5f - 4;
    p[pitch + i] = y - 2;
    p[2 * pitch + i] = s[i] * t[i];
    n[i] = s[i] - 0.5f;
    n[pitch + i] = 0.25f;
    n[2 * pitch + i] = -1;
    pv[i] = static_cast<float>((first + i) * 7 % 11) / 5 - 1;
  }
  return grid;
}

void collect(const Planes& planes, size_t points, std::vector<float>& out, size_t first) {
  const size_t count = static_cast<size_t>(components(planes.type)) * std::max(planes.elements, 1u);
  out.resize(count * kNu * kNv);
  for (size_t c = 0; c < count; ++c)
    for (size_t i = 0; i < points; ++i)
      out[c * kNu * kNv + first + i] = planes.get(c, i);
}

class Runner {
public:
  std::string run(const RandomProgram& program, const Variant& v, Results& results, std::string& printed) {
    Machine machine(v.machine);
    std::string error;
    std::vector<std::unique_ptr<Instance>> lights;
    Scene scene;
    std::vector<std::vector<std::byte>> emitters = compile(kLights, 2, error);
    if (!program.light.empty()) {
      for (auto& emitter : compile(program.light, v.level, error))
        emitters.push_back(std::move(emitter));
      if (!error.empty()) return error;
    }
    for (const auto& shader : emitters) {
      lights.push_back(instantiate(machine, shader, error));
      if (!lights.back()) return error;
      scene.light_list.push_back(lights.back().get());
    }
    auto shaders = compile(program.source, v.level, error);
    if (shaders.size() != 1) return error;
    auto surface = instantiate(machine, shaders[0], error);
    if (!surface) return error;
    ShadingContext context(machine, scene);
    const size_t step = v.alone ? 1 : kNu * kNv;
    for (size_t first = 0; first < kNu * kNv; first += step) {
      Grid grid = v.alone ? inputs(first, 1, 1) : inputs(0, kNu, kNv);
      context.shade({.surface = surface.get()}, grid);
      collect(grid.variable(Global::kCi), grid.points(), results["Ci"], first);
      collect(grid.variable(Global::kOi), grid.points(), results["Oi"], first);
      for (const char* name : kOutputs)
        collect(*context.output(*surface, name), grid.points(), results[name], first);
    }
    printed = scene.printed;
    return "";
  }

private:
  std::vector<std::vector<std::byte>> compile(const std::string& source, int level, std::string& error) {
    SourceManager sources;
    Diagnostics diags;
    diags.no_warnings = true;
    slc::CompileOptions options;
    options.optimise = level;
    options.evaluator = evaluator_.get();
    std::vector<std::vector<std::byte>> out;
    for (const slc::CompiledShader& s :
         compiler_.compile(sources.add("t.sl", source), options, sources, diags))
      out.push_back(write_slo(s.program));
    if (diags.has_errors()) error = format_diagnostics(diags, sources);
    return out;
  }

  std::unique_ptr<Instance> instantiate(const Machine& machine, const std::vector<std::byte>& slo,
                                        std::string& error) {
    auto shader = machine.load(slo);
    if (!shader) return error = shader.error(), nullptr;
    std::vector<ParamValue> params;
    if ((*shader)->name() == "t")
      params = {{"pf", {Type::kFloat, 0, {1.5f}, {}}}, {"ps", {Type::kString, 0, {}, {"xay"}}}};
    auto instance = machine.instantiate(*shader, params, {.may_vary = {"pv"}});
    if (!instance) return error = instance.error(), nullptr;
    return std::move(*instance);
  }

  slc::Compiler compiler_;
  std::unique_ptr<ir::ConstantEvaluator> evaluator_ = make_kernel_evaluator();
};

bool same(float a, float b) {
  return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}

std::string compare(const Results& expected, const Results& got) {
  for (const auto& [name, values] : expected)
    for (size_t k = 0; k < values.size(); ++k)
      if (float other = got.at(name)[k]; !same(values[k], other)) {
        const size_t point = k % (kNu * kNv);
        return fmt::format("{}[{}] at point {}, {} is {} instead of {}", name, k / (kNu * kNv), point % kNu,
                           point / kNu, other, values[k]);
      }
  return "";
}

// The first line in which two texts differ.
std::string first_difference(const std::string& expected, const std::string& got) {
  const size_t at = static_cast<size_t>(
      std::mismatch(got.begin(), got.end(), expected.begin(), expected.end()).first - got.begin());
  auto line = [&](const std::string& text) {
    const size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1; // npos + 1 is 0
    return text.substr(begin, text.find('\n', at) - begin);
  };
  return fmt::format("prints \"{}\" instead of \"{}\", {} characters, not {}", line(got), line(expected),
                     got.size(), expected.size());
}

} // namespace

std::string disagreement(const RandomProgram& program) {
  static Runner runner; // compiling the bodies of built-in functions once
  Results expected;
  std::string expected_text;
  for (const Variant& v : variants()) {
    if (v.alone && !program.pointwise) continue;
    Results got;
    std::string text;
    if (std::string error = runner.run(program, v, got, text); !error.empty())
      return fmt::format("{}: {}", v.name, error);
    if (expected.empty()) {
      expected = std::move(got);
      expected_text = std::move(text);
      continue;
    }
    if (std::string difference = compare(expected, got); !difference.empty())
      return fmt::format("{}: {}", v.name, difference);
    // Alone, a text with a uniform value is printed by each point.
    if (!v.alone && text != expected_text)
      return fmt::format("{}: {}", v.name, first_difference(expected_text, text));
  }
  return "";
}

std::vector<uint8_t> shrink(std::vector<uint8_t> bytes) {
  auto fails = [](const std::vector<uint8_t>& candidate) {
    Choices choices(candidate);
    return !disagreement(random_program(choices)).empty();
  };
  for (bool progress = true; progress;) {
    progress = false;
    for (size_t size = bytes.size() / 2; size > 0; size /= 2)
      for (size_t at = 0; at + size <= bytes.size();) {
        std::vector<uint8_t> shorter = bytes;
        shorter.erase(shorter.begin() + static_cast<ptrdiff_t>(at),
                      shorter.begin() + static_cast<ptrdiff_t>(at + size));
        if (fails(shorter)) {
          bytes = std::move(shorter);
          progress = true;
        } else {
          at += size;
        }
      }
    for (uint8_t& b : bytes) {
      const uint8_t old = std::exchange(b, 0);
      if (old == 0) continue;
      if (fails(bytes))
        progress = true;
      else
        b = old;
    }
  }
  return bytes;
}

} // namespace slvm::test
