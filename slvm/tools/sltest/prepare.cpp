// prepare(): from a Setup to the grid and the scene all its runs start from.
#include "slvm/tools/sltest/expression.h"
#include "slvm/tools/sltest/obtain.h"
#include "slvm/tools/sltest/run.h"
#include "slvm/tools/sltest/shapes.h"

#include "slvm/support/diagnostics.h"

#include <fmt/format.h>

namespace slvm::sltest {
namespace {

bool fail(RunError& error, const Where& where, std::string_view name, std::string_view text) {
  error = {Failure::kSetup, fmt::format("{}: {}: {}", to_string(where), name, text)};
  return false;
}

std::string unknown_variable(std::string_view name) {
  std::vector<std::string_view> names;
  for (int i = 0; i < kGlobalCount; ++i)
    names.push_back(global_info(static_cast<Global>(i)).name);
  std::string_view near = nearest_name(name, names);
  std::string text = "not a predefined variable";
  if (!near.empty()) text += fmt::format("; did you mean '{}'?", near);
  return text + " (a primitive variable needs a type: \"varying float name\")";
}

/// Whether numbers stand for one value, not for one a point.
bool is_constant(const RawValue& raw, Type type, uint32_t elements) {
  return elements > 0 || raw.numbers.size() == 1 ||
         (raw.inner == 0 && raw.numbers.size() == static_cast<size_t>(components(type)));
}

void make_varying(Variable& v, size_t points) {
  std::vector<float> numbers;
  for (size_t k = 0; k < v.planes(); ++k)
    numbers.insert(numbers.end(), points, v.numbers[k]);
  v.numbers = std::move(numbers);
  v.varying = true;
}

struct GridBuilder {
  const Setup& setup;
  ShaderLibrary& library;
  Prepared& prepared;
  RunError& error;

  /// Sets one variable from a constant, a list or RSL code.
  bool set(const Setting& setting, const Declaration& d) {
    GridData& grid = prepared.grid;
    const RawValue& raw = setting.value;
    if (raw.is_text() && d.type != Type::kString) return set_from_code(raw, d);
    const Type type = d.type ? *d.type : number_type(raw);
    Variable v;
    if (type == Type::kString || is_constant(raw, type, d.elements)) {
      auto value = to_value(raw, type, d.elements);
      if (!value) return fail(error, raw.where, d.name, value.error());
      v = uniform_variable(d.name, *value);
      if (d.detail == Detail::kVarying && type != Type::kString) make_varying(v, grid.points());
    } else {
      auto planes = to_planes(raw, type, grid.points());
      if (!planes) return fail(error, raw.where, d.name, planes.error());
      v = {d.name, type, 0, true, *planes, {}};
    }
    grid.set(std::move(v));
    return true;
  }

  /// Sets a variable from RSL code, which sees the variables set so far.
  bool set_from_code(const RawValue& raw, const Declaration& d) {
    CodeOptions options;
    options.label = raw.where.file.empty() ? "--set" : raw.where.file;
    options.first_line = std::max(raw.where.line, 1u);
    options.first_column = std::max(raw.where.column, 1u);
    if (d.type) options.types = {*d.type};
    options.path = setup.path;
    auto result = evaluate_code(library, raw.strings[0], prepared.grid, prepared.scene, options);
    if (!result) return fail(error, raw.where, d.name, result.error());
    Variable v = *result;
    v.name = d.name;
    if (d.detail == Detail::kUniform && v.type != Type::kString) v = {d.name, v.type, 0, false, v.at(0), {}};
    prepared.grid.set(std::move(v));
    return true;
  }

  bool set_global(const Setting& setting) {
    Declaration d = setting.what;
    const Global g = find_global(d.name);
    if (g == Global::kCount) {
      if (d.type) return set(setting, d);
      return fail(error, setting.value.where, d.name, unknown_variable(d.name));
    }
    d.type = global_info(g).type;
    return set(setting, d);
  }

  Type number_type(const RawValue& raw) const {
    if (raw.inner == 3 || (!raw.inner && raw.numbers.size() == 3 && prepared.grid.points() != 3))
      return Type::kColor;
    return raw.inner == 16 ? Type::kMatrix : Type::kFloat;
  }
};

bool read_values(const std::vector<Setting>& settings, std::map<std::string, Value, std::less<>>& values,
                 RunError& error) {
  for (const Setting& s : settings) {
    Declaration d = inferred_type(s.value, s.what);
    auto value = to_value(s.value, *d.type, d.elements);
    if (!value) return fail(error, s.value.where, d.name, value.error());
    values[d.name] = *value;
  }
  return true;
}

} // namespace

bool prepare(const Setup& setup, ShaderLibrary& library, Prepared& prepared, RunError& error) {
  for (const auto& [name, matrix] : setup.spaces)
    if (name != "object") prepared.scene.spaces[name] = matrix;
  prepared.scene.textures = std::make_shared<LazyTextures>(setup.path);
  prepared.scene.clouds = std::make_shared<Clouds>(setup.path);
  if (!read_values(setup.attributes, prepared.scene.attributes, error) ||
      !read_values(setup.options, prepared.scene.options, error))
    return false;
  if (setup.shader.form != ShaderForm::kExpression) {
    ShaderPtr shader = obtain(setup, setup.shader, {}, library, {}, error);
    if (!shader) return false;
    prepared.kind = shader->program.kind;
  }
  auto shape = make_shape(setup.grid, prepared.kind);
  if (!shape) return fail(error, setup.shader.where, "grid", shape.error());
  prepared.grid = std::move(*shape);
  if (auto it = setup.spaces.find("object"); it != setup.spaces.end())
    prepared.grid.object_to_current = it->second;

  GridBuilder builder{setup, library, prepared, error};
  for (const Setting& s : setup.variables)
    if (!builder.set_global(s)) return false;
  for (const Setting& s : setup.primvars)
    if (!builder.set(s, s.what)) return false;
  return true;
}

} // namespace slvm::sltest
