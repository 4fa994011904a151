#include "slvm/tools/sltest/setup_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace slvm::sltest {
namespace {

/// More points than any test needs; a slip of the finger shall not take all memory.
constexpr double kMaxResolution = 4096;

void read_settings(const toml::table& table, const TomlSource& source, std::vector<Setting>& settings) {
  for (const auto& [key, node] : in_file_order(table)) {
    auto declaration = parse_declaration(key);
    if (!declaration) {
      source.error(*node, declaration.error());
      continue;
    }
    Setting s{*declaration, {}};
    if (!read_raw(*node, source, s.value)) continue;
    std::erase_if(settings, [&](const Setting& old) { return old.what.name == s.what.name; });
    settings.push_back(std::move(s));
  }
}

Matrix4 rotation(float degrees, float x, float y, float z) {
  const double angle = degrees * 3.14159265358979323846 / 180, length = std::hypot(x, y, z);
  const double a = x / length, b = y / length, c = z / length, s = std::sin(angle), k = 1 - std::cos(angle);
  const double rows[3][3] = {{1 - k * (b * b + c * c), k * a * b + s * c, k * a * c - s * b},
                             {k * a * b - s * c, 1 - k * (a * a + c * c), k * b * c + s * a},
                             {k * a * c + s * b, k * b * c - s * a, 1 - k * (a * a + b * b)}};
  Matrix4 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m(i, j) = static_cast<float>(rows[i][j]);
  return m;
}

/// `{translate = [x, y, z]}`, `{scale = [x, y, z]}`, `{rotate = [degrees, x, y, z]}` or `{matrix = [16
/// numbers]}`.
bool read_step(const toml::table& t, const TomlSource& source, Matrix4& m) {
  TableReader table(t, source);
  RawValue raw;
  auto numbers = [&](const char* key, size_t count) {
    const toml::node* node = table.get(key);
    if (!node || !read_raw(*node, source, raw)) return false;
    if (raw.numbers.size() == count) return true;
    source.error(*node, fmt::format("{} takes {} numbers", key, count));
    return false;
  };
  Matrix4 step;
  if (numbers("translate", 3))
    for (int i = 0; i < 3; ++i)
      step(3, i) = raw.numbers[static_cast<size_t>(i)];
  else if (numbers("scale", 3))
    for (int i = 0; i < 3; ++i)
      step(i, i) = raw.numbers[static_cast<size_t>(i)];
  else if (numbers("rotate", 4))
    step = rotation(raw.numbers[0], raw.numbers[1], raw.numbers[2], raw.numbers[3]);
  else if (numbers("matrix", 16))
    std::copy(raw.numbers.begin(), raw.numbers.end(), step.m.begin());
  table.finish();
  m = m * step;
  return true;
}

/// 16 numbers, one step, or a list of steps that are applied to a point in this order.
bool read_matrix(const toml::node& node, const TomlSource& source, Matrix4& m) {
  m = Matrix4();
  if (const toml::table* t = node.as_table()) return read_step(*t, source, m);
  const toml::array* list = node.as_array();
  if (list && !list->empty() && list->get(0)->is_table())
    return std::all_of(list->begin(), list->end(), [&](const toml::node& item) {
      return item.is_table() && read_step(*item.as_table(), source, m);
    });
  RawValue raw;
  if (!read_raw(node, source, raw)) return false;
  if (raw.numbers.size() != 16) {
    source.error(
        node,
        "a space is 16 numbers, {translate = [...]}, {rotate = [...]}, {scale = [...]} or a list of these");
    return false;
  }
  std::copy(raw.numbers.begin(), raw.numbers.end(), m.m.begin());
  return true;
}

/// The three ways to give a shader. True if one of them is there.
bool read_shader_text(TableReader& table, const TomlSource& source, ShaderRef& ref, bool allow_expr) {
  constexpr std::pair<const char*, ShaderForm> kForms[] = {
      {"shader", ShaderForm::kFile}, {"source", ShaderForm::kSource}, {"expr", ShaderForm::kExpression}};
  int given = 0;
  for (const auto& [key, form] : kForms) {
    if (form == ShaderForm::kExpression && !allow_expr) continue;
    const toml::node* node = table.get(key);
    if (!node || !table.read(key, ref.text)) continue;
    ref.form = form;
    ref.where = source.where(*node);
    if (++given > 1) source.error(*node, "only one of shader, source and expr can be given");
  }
  return given > 0;
}

/// Where the origin of a light's "shader" space is.
void read_position(const toml::node& node, const TomlSource& source, Matrix4& space) {
  RawValue raw;
  if (!read_raw(node, source, raw)) return;
  if (raw.numbers.size() != 3) return source.error(node, "a position is three numbers");
  for (int i = 0; i < 3; ++i)
    space(3, i) = raw.numbers[static_cast<size_t>(i)];
}

/// A shader beside the one under test: its name, or a table.
ShaderRef read_ref(const toml::node& node, const TomlSource& source) {
  ShaderRef ref;
  ref.where = source.where(node);
  if (auto name = node.value_exact<std::string>()) {
    ref.form = ShaderForm::kFile;
    ref.text = *name;
    return ref;
  }
  const toml::table* t = node.as_table();
  if (!t) {
    source.error(node, "a shader is a name, or a table with shader or source, params, position and space");
    return ref;
  }
  TableReader table(*t, source);
  if (!read_shader_text(table, source, ref, false)) source.error(node, "shader or source is missing");
  if (const toml::table* params = table.table("params")) read_settings(*params, source, ref.params);
  if (const toml::node* space = table.get("space")) read_matrix(*space, source, ref.space);
  if (const toml::node* position = table.get("position")) read_position(*position, source, ref.space);
  table.finish();
  return ref;
}

void read_resolution(const toml::node& node, const TomlSource& source, GridSpec& grid) {
  RawValue raw;
  if (!read_raw(node, source, raw)) return;
  if (raw.numbers.size() == 1) raw.numbers.push_back(raw.numbers[0]);
  auto whole = [](float x) { return x >= 1 && x <= kMaxResolution && x == std::floor(x); };
  if (raw.numbers.size() != 2 || !std::all_of(raw.numbers.begin(), raw.numbers.end(), whole))
    return source.error(node, fmt::format("res is [nu, nv], whole numbers from 1 to {}", kMaxResolution));
  grid.nu = static_cast<int>(raw.numbers[0]);
  grid.nv = static_cast<int>(raw.numbers[1]);
}

void read_ray(const toml::table& t, const TomlSource& source, RayFacts& ray) {
  TableReader table(t, source);
  table.read("type", ray.type);
  table.read("label", ray.label);
  for (auto [key, value] :
       {std::pair("depth", &ray.depth), std::pair("speculardepth", &ray.specular_depth),
        std::pair("diffusedepth", &ray.diffuse_depth), std::pair("shadowdepth", &ray.shadow_depth)}) {
    double number = static_cast<double>(*value);
    if (table.read(key, number)) *value = static_cast<float>(number);
  }
  table.finish();
}

void read_grid(const toml::table& t, const TomlSource& source, Setup& setup) {
  TableReader table(t, source);
  table.read("shape", setup.grid.shape);
  if (const toml::node* res = table.get("res")) read_resolution(*res, source, setup.grid);
  table.read("center", setup.grid.center);
  table.read("derivatives", setup.grid.derivatives);
  table.read("flip_normals", setup.grid.flip_normals);
  if (const toml::table* ray = table.table("ray")) read_ray(*ray, source, setup.grid.ray);
  table.finish();
}

void read_path(const toml::node& node, const TomlSource& source, Setup& setup) {
  RawValue raw;
  if (!read_raw(node, source, raw)) return;
  const std::string base = setup.path.front();
  for (const std::string& dir : raw.strings)
    setup.path.push_back(dir.starts_with('/') ? dir : base + "/" + dir);
}

} // namespace

void read_setup(TableReader& table, const TomlSource& source, Setup& setup) {
  read_shader_text(table, source, setup.shader, true);
  if (const toml::table* t = table.table("params")) read_settings(*t, source, setup.shader.params);
  if (const toml::table* t = table.table("grid")) read_grid(*t, source, setup);
  if (const toml::table* t = table.table("set")) read_settings(*t, source, setup.variables);
  if (const toml::table* t = table.table("primvars")) read_settings(*t, source, setup.primvars);
  if (const toml::table* t = table.table("attributes")) read_settings(*t, source, setup.attributes);
  if (const toml::table* t = table.table("options")) read_settings(*t, source, setup.options);
  for (const char* role : {"surface", "displacement", "atmosphere", "interior", "exterior"})
    if (const toml::node* node = table.get(role)) setup.companions[role] = read_ref(*node, source);
  if (const toml::array* lights = table.array("lights")) {
    setup.lights.clear();
    for (const toml::node& node : *lights)
      setup.lights.push_back(read_ref(node, source));
  }
  if (const toml::table* spaces = table.table("spaces"))
    for (const auto& [name, node] : in_file_order(*spaces)) {
      Matrix4 m;
      if (!read_matrix(*node, source, m)) continue;
      if (name == "shader")
        setup.shader.space = m;
      else
        setup.spaces[name] = m;
    }
  if (const toml::node* node = table.get("scene"); node && table.read("scene", setup.scene))
    setup.scene_where = source.where(*node);
  table.read("prelude", setup.prelude);
  if (const toml::node* node = table.get("path")) read_path(*node, source, setup);
}

} // namespace slvm::sltest
