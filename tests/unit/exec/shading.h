// Compiles RSL and shades a small grid with it: what the tests of the virtual machine share.
#pragma once

#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"
#include "slvm/machine.h"

#include <gtest/gtest.h>
#include <map>

namespace slvm::test {

/// Answers from tables; all spaces but those given are unknown.
class TableServices : public RendererServices {
public:
  std::map<std::string, Matrix4, std::less<>> spaces;
  std::map<std::string, Value, std::less<>> attributes;
  std::vector<const Instance*> light_list;
  std::string printed;

  bool space_to_current(const ShadingState&, std::string_view space, Matrix4& m) override {
    auto it = spaces.find(space);
    if (it != spaces.end()) m = it->second;
    return it != spaces.end();
  }
  bool current_to_space(const ShadingState&, std::string_view space, Matrix4& m) override {
    auto it = spaces.find(space);
    return it != spaces.end() && invert(it->second, m);
  }
  std::span<const Instance* const> lights(const ShadingState&) override { return light_list; }
  bool attribute(const ShadingState&, std::string_view name, Value& out) override {
    auto it = attributes.find(name);
    if (it != attributes.end()) out = it->second;
    return it != attributes.end();
  }
  bool option(const ShadingState&, std::string_view, Value&) override { return false; }
  bool renderer_info(const ShadingState&, std::string_view, Value&) override { return false; }
  void print(const ShadingState&, std::string_view text) override { printed += text; }
};

/// The .slo bytes of the only shader in `source`.
inline std::vector<std::byte> compile(const std::string& source, int level = 2) {
  static const slc::Compiler compiler;
  auto evaluator = make_kernel_evaluator();
  SourceManager sources;
  Diagnostics diags;
  slc::CompileOptions options;
  options.optimise = level;
  options.evaluator = evaluator.get();
  auto shaders = compiler.compile(sources.add("test.sl", source), options, sources, diags);
  EXPECT_FALSE(diags.has_errors()) << format_diagnostics(diags, sources);
  return shaders.size() == 1 ? write_slo(shaders[0].program) : std::vector<std::byte>();
}

inline std::unique_ptr<Instance> instantiate(const Machine& machine, const std::string& source,
                                             std::vector<ParamValue> params = {},
                                             const InstanceOptions& options = {}) {
  auto shader = machine.load(compile(source));
  EXPECT_TRUE(shader) << (shader ? "" : shader.error());
  if (!shader) return nullptr;
  auto instance = machine.instantiate(*shader, params, options);
  EXPECT_TRUE(instance) << (instance ? "" : instance.error());
  return instance ? std::move(*instance) : nullptr;
}

inline ParamValue number(std::string name, float x) {
  return {std::move(name), {Type::kFloat, 0, {x}, {}}};
}

/// The square 0..1 in x and y, at z = 1, facing the viewer.
inline Grid square(int nu, int nv) {
  Grid grid(nu, nv);
  float *p = grid.varying(Global::kP), *n = grid.varying(Global::kN);
  size_t pitch = grid.pitch();
  for (int j = 0, i = 0; j < nv; ++j)
    for (int k = 0; k < nu; ++k, ++i) {
      p[i] = nu > 1 ? static_cast<float>(k) / static_cast<float>(nu - 1) : 0;
      p[pitch + static_cast<size_t>(i)] = nv > 1 ? static_cast<float>(j) / static_cast<float>(nv - 1) : 0;
      p[2 * pitch + static_cast<size_t>(i)] = 1;
      n[2 * pitch + static_cast<size_t>(i)] = -1;
    }
  return grid;
}

/// Ci at each point, as triples of three numbers.
template <class Triple> std::vector<Triple> colours_of(const Grid& grid) {
  const Planes& Ci = grid.variable(Global::kCi);
  std::vector<Triple> out;
  for (size_t i = 0; i < grid.points(); ++i)
    out.push_back({Ci.get(0, i), Ci.get(1, i), Ci.get(2, i)});
  return out;
}

/// Ci of a surface on a grid, red first.
inline std::vector<float> red(const Grid& grid, size_t component = 0) {
  std::vector<float> out;
  for (size_t i = 0; i < grid.points(); ++i)
    out.push_back(grid.variable(Global::kCi).get(component, i));
  return out;
}

} // namespace slvm::test
