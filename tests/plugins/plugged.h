// Compiles shaders that call functions of the plug-ins beside, and shades small grids with them.
#pragma once

#include "slvm/plugin/finder.h"
#include "tests/unit/exec/shading.h"

#include <filesystem>
#include <gmock/gmock.h>

namespace slvm::test {

/// A folder of plug-ins as the build makes them: "good", "broken/NAME".
inline std::string plugin_folder(const std::string& name) {
  return std::string(PLUGINS) + "/" + name;
}

struct Plugged {
  explicit Plugged(std::vector<std::string> folders = {plugin_folder("good")})
      : finder(folders), machine({.plugin_folders = std::move(folders)}) {}

  /// The .slo bytes, empty with what the compiler says in `diagnostics`.
  std::vector<std::byte> compile(const std::string& source, int level = 2) {
    static const slc::Compiler compiler;
    SourceManager sources;
    Diagnostics diags;
    slc::CompileOptions options;
    options.optimise = level;
    options.plugins = &finder;
    auto shaders = compiler.compile(sources.add("test.sl", source), options, sources, diags);
    diagnostics = format_diagnostics(diags, sources);
    return shaders.size() == 1 ? write_slo(shaders[0].program) : std::vector<std::byte>();
  }

  std::unique_ptr<Instance> bind(const std::string& source, int level = 2) {
    std::vector<std::byte> bytes = compile(source, level);
    EXPECT_FALSE(bytes.empty()) << diagnostics;
    auto shader = machine.load(bytes);
    EXPECT_TRUE(shader) << (shader ? "" : shader.error());
    if (!shader) return nullptr;
    auto instance = machine.instantiate(*shader, {});
    EXPECT_TRUE(instance) << (instance ? "" : instance.error());
    return instance ? std::move(*instance) : nullptr;
  }

  /// Why the shader cannot be bound.
  std::string refusal(const std::vector<std::byte>& bytes) {
    auto shader = machine.load(bytes);
    if (!shader) return "not loaded: " + shader.error();
    auto instance = machine.instantiate(*shader, {});
    return instance ? "" : instance.error();
  }

  /// One component of Ci on a row of n points, x from 0 to 1.
  std::vector<float> shade(const std::string& statements, int n = 4, size_t component = 0, int level = 2) {
    auto surface = bind("surface s() { " + statements + " }", level);
    Grid grid = square(n, 1);
    ShadingContext context(machine, services);
    if (!surface) return {};
    context.shade({.surface = surface.get()}, grid);
    return red(grid, component);
  }

  /// Run-time messages, "line: text (points)" each.
  std::vector<std::string> messages() const {
    std::vector<std::string> out;
    for (const RuntimeMessage& m : machine.messages())
      out.push_back(std::to_string(m.line) + ": " + m.text + " (" + std::to_string(m.points) + ")");
    return out;
  }

  PluginFinder finder;
  Machine machine;
  TableServices services;
  std::string diagnostics;
};

} // namespace slvm::test
