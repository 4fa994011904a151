#include "slvm/tools/sltest/predicate.h"

#include <fmt/format.h>

namespace slvm::sltest {
namespace {

/// Where the shader's outputs stand as primitive variables.
constexpr const char* kOutputPrefix = "out_";
constexpr const char* kInputPrefix = "in_";
constexpr const char* kHolds = "predicate_holds";

GridData with_outputs(const Prepared& prepared, const RunResult& result) {
  GridData grid = prepared.grid;
  for (const Variable& output : result.outputs) {
    if (const Variable* input = prepared.grid.find(output.name)) {
      Variable copy = *input;
      copy.name = kInputPrefix + output.name;
      grid.set(std::move(copy));
    }
    Variable copy = output;
    copy.name = kOutputPrefix + output.name;
    grid.set(std::move(copy));
  }
  return grid;
}

std::string output_macros(const RunResult& result) {
  std::string text;
  for (const Variable& v : result.outputs)
    text += fmt::format("#define {} {}{}\n", v.name, kOutputPrefix, v.name);
  return text;
}

/// Declares a float that is one component of `value`, under the name by which the predicate knows it.
std::string component_variable(const std::string& name, const std::string& value, int component) {
  return fmt::format("float component_{0} = comp({1}, {2});\n#define {0} component_{0}\n", name, value,
                     component);
}

/// Outputs, and with `inputs` all other triples too, stand for one of their components, color(a, b, c) for
/// one of its arguments. Functions that look at whole triples then make no sense, and become errors.
std::string component_macros(const GridData& grid, const RunResult& result, int component, bool inputs) {
  std::string text;
  for (const Variable& v : grid.variables)
    if (inputs && is_triple(v.type) && !v.elements && !result.find(v.name) &&
        !v.name.starts_with(kOutputPrefix))
      text += component_variable(v.name, v.name, component);
  for (const Variable& v : result.outputs)
    text += is_triple(v.type) && !v.elements ? component_variable(v.name, kOutputPrefix + v.name, component)
                                             : fmt::format("#define {0} {1}{0}\n", v.name, kOutputPrefix);
  for (const char* type : {"color", "point", "vector", "normal"})
    text += fmt::format("#define {}(a, b, c) ({})\n", type, "abc"[component]);
  if (inputs)
    for (const char* name :
         {"xcomp", "ycomp", "zcomp", "comp", "length", "normalize", "distance", "transform"})
      text += fmt::format("#define {0} {0}_of_a_component\n", name);
  return text;
}

} // namespace

CodeOptions code_options(const RawValue& code, const std::vector<std::string>& path) {
  CodeOptions options;
  options.label = code.where.file.empty() ? "--expr" : code.where.file;
  options.first_line = std::max(code.where.line, 1u);
  options.first_column = std::max(code.where.column, 1u);
  options.path = path;
  return options;
}

Result<std::vector<bool>> evaluate_predicate(ShaderLibrary& library, const RawValue& condition,
                                             const Prepared& prepared, const RunResult& result,
                                             const std::vector<std::string>& path) {
  if (condition.strings.size() != 1) return Error{"a predicate is a text"};
  const GridData grid = with_outputs(prepared, result);
  const std::string code = fmt::format("if ({}) {} = 1;", condition.strings[0], kHolds);
  CodeOptions options = code_options(condition, path);
  options.types = {Type::kFloat};
  options.first_column = std::max(options.first_column, 5u) - 4; // for "if ("
  options.result = kHolds;
  options.macros = output_macros(result);

  std::vector<bool> holds(grid.points(), true);
  auto merge = [&](const Variable& v) {
    for (size_t i = 0; i < holds.size(); ++i)
      holds[i] = holds[i] && v.get(0, i) == 1;
  };
  auto whole = evaluate_code(library, code, grid, prepared.scene, options);
  if (whole) {
    merge(*whole);
    return holds;
  }
  // By component: first the outputs alone, then all triples.
  for (bool inputs : {false, true}) {
    int done = 0;
    for (; done < 3; ++done) {
      options.macros = component_macros(grid, result, done, inputs);
      auto part = evaluate_code(library, code, grid, prepared.scene, options);
      if (!part) break;
      merge(*part);
    }
    if (done == 3) return holds;
  }
  return Error{whole.error()};
}

} // namespace slvm::sltest
