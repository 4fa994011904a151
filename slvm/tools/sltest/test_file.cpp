// Cases of a test file. Reading starts at read_test_file, at the end; what a setup consists of is read by
// setup_reader.cpp, expectations here.
#include "slvm/tools/sltest/test_file.h"

#include "slvm/format/shadeop_info.h"
#include "slvm/tools/sltest/setup_reader.h"
#include "slvm/tools/sltest/sweep.h"

#include <fmt/format.h>

#include <filesystem>

namespace slvm::sltest {
namespace {

void read_tolerance(TableReader& table, Tolerance& tolerance) {
  table.read("abs", tolerance.abs);
  table.read("rel", tolerance.rel);
}

void read_image_tolerance(TableReader& table, ImageTolerance& tolerance) {
  table.read("failthresh", tolerance.failthresh);
  table.read("hardfail", tolerance.hardfail);
  table.read("failpercent", tolerance.failpercent);
  table.read("failrelative", tolerance.failrelative);
}

/// "3, 1": a point of the grid.
bool parse_point(std::string_view text, int& iu, int& iv) {
  RawValue raw = parse_raw(text);
  if (raw.numbers.size() != 2) return false;
  iu = static_cast<int>(raw.numbers[0]);
  iv = static_cast<int>(raw.numbers[1]);
  return static_cast<float>(iu) == raw.numbers[0] && static_cast<float>(iv) == raw.numbers[1] && iu >= 0 &&
         iv >= 0;
}

class CaseReader {
public:
  CaseReader(const TomlSource& source, Case& target) : source_(source), case_(target) {}

  void read(TableReader& table) {
    read_setup(table, source_, case_.setup);
    if (const toml::table* t = table.table("tolerance")) {
      TableReader tolerance(*t, source_);
      read_tolerance(tolerance, case_.tolerance);
      tolerance.finish();
    }
    if (const toml::table* t = table.table("image_tolerance")) {
      TableReader tolerance(*t, source_);
      read_image_tolerance(tolerance, case_.image_tolerance);
      tolerance.finish();
    }
    if (const toml::table* t = table.table("sweep")) read_sweeps(*t, source_, case_.sweeps);
    table.read("quick", case_.quick);
    table.read("specialised", case_.specialised);
    table.read("unspecialised", case_.unspecialised);
    read_table(table);
    if (const toml::node* expect = table.get("expect")) read_expect(*expect);
  }

private:
  void add(Check check, const std::string& variable, const toml::node& node, const Tolerance& tolerance,
           int iu = 0, int iv = 0) {
    Expectation e{check, variable, {}, iu, iv, tolerance};
    if (read_raw(node, source_, e.value)) case_.expectations.push_back(std::move(e));
  }

  void read_table(TableReader& table) {
    const toml::array* columns = table.array("columns");
    const toml::array* rows = table.array("rows");
    if (!columns && !rows) return;
    Table result;
    if (!columns || !rows) return source_.error(columns ? *columns : *rows, "columns and rows go together");
    for (const toml::node& node : *columns) {
      auto d = parse_declaration(node.value_or<std::string>(""));
      if (!d) return source_.error(node, d.error());
      if (!d->type) d->type = Type::kFloat;
      if (find_global(d->name) != Global::kCount)
        return source_.error(
            node, fmt::format("'{}' is a predefined variable; give the column another name", d->name));
      result.columns.push_back(*d);
    }
    for (const toml::node& node : *rows) {
      const toml::array* cells = node.as_array();
      if (!cells || cells->size() != result.columns.size())
        return source_.error(node,
                             fmt::format("a row has {} cells, one for each column", result.columns.size()));
      result.rows.emplace_back();
      for (const toml::node& cell : *cells)
        if (!read_raw(cell, source_, result.rows.back().emplace_back())) return;
    }
    if (result.columns.empty() || result.rows.empty()) return source_.error(*columns, "an empty table");
    case_.table = std::move(result);
  }

  /// A list of texts, or one.
  std::vector<std::string> texts(const toml::node& node) {
    RawValue raw;
    read_raw(node, source_, raw);
    if (!raw.numbers.empty()) source_.error(node, "texts wanted");
    return raw.strings;
  }

  /// `expect = VALUE` is short for `expect.result = VALUE`.
  void read_expect(const toml::node& node) {
    case_.expectations.clear();
    case_.images.clear();
    const toml::table* table = node.as_table();
    if (!table) return add(Check::kAll, "result", node, case_.tolerance);
    for (const auto& [key, value] : in_file_order(*table)) {
      if (key == "predicate")
        read_predicates(*value);
      else if (key == "printf")
        case_.printed = value->value<std::string>();
      else if (key == "messages")
        case_.messages = texts(*value);
      else if (key == "warnings")
        case_.warnings = texts(*value);
      else if (key == "image")
        read_images(*value);
      else if (key == "bind_error")
        case_.bind_error = value->value_or<std::string>("");
      else if (key == "compile_error")
        case_.compile_error = value->value_or<std::string>("");
      else
        read_variable(key, *value);
    }
  }

  /// `image.NAME = FILE`, or a table with `file` and tolerances.
  void read_images(const toml::node& node) {
    const toml::table* images = node.as_table();
    if (!images) return source_.error(node, "write expect.image.NAME = \"FILE.exr\"");
    for (const auto& [name, value] : in_file_order(*images)) {
      ImageExpectation e{name, {}, case_.image_tolerance, source_.where(*value)};
      if (auto file = value->value_exact<std::string>()) {
        e.file = *file;
      } else if (const toml::table* t = value->as_table()) {
        TableReader table(*t, source_);
        table.read("file", e.file);
        read_image_tolerance(table, e.tolerance);
        table.finish();
      }
      if (e.file.empty()) return source_.error(*value, "the name of an image file is missing");
      case_.images.push_back(std::move(e));
    }
  }

  void read_predicates(const toml::node& node) {
    if (const toml::array* list = node.as_array())
      for (const toml::node& item : *list)
        add(Check::kPredicate, "", item, case_.tolerance);
    else
      add(Check::kPredicate, "", node, case_.tolerance);
  }

  void read_variable(const std::string& name, const toml::node& node) {
    const toml::table* t = node.as_table();
    if (!t) return add(Check::kAll, name, node, case_.tolerance);
    TableReader table(*t, source_);
    Tolerance tolerance = case_.tolerance;
    read_tolerance(table, tolerance);
    constexpr std::pair<const char*, Check> kChecks[] = {{"all", Check::kAll},   {"points", Check::kPoints},
                                                         {"mean", Check::kMean}, {"min", Check::kMin},
                                                         {"max", Check::kMax},   {"code", Check::kCode}};
    for (const auto& [key, check] : kChecks)
      if (const toml::node* value = table.get(key)) add(check, name, *value, tolerance);
    if (const toml::table* at = table.table("at")) {
      for (const auto& [key, value] : in_file_order(*at)) {
        int iu = 0, iv = 0;
        if (parse_point(key, iu, iv))
          add(Check::kAt, name, *value, tolerance, iu, iv);
        else
          source_.error(*value, fmt::format("'{}' is not a point of the grid; write \"iu, iv\"", key));
      }
    }
    table.finish();
  }

  const TomlSource& source_;
  Case& case_;
};

bool check_case(const Case& c, const toml::node& node, const TomlSource& source) {
  const bool expects = !c.expectations.empty() || !c.images.empty() || c.warnings || c.printed ||
                       c.messages || !c.bind_error.empty() || !c.compile_error.empty() || c.table;
  if (c.setup.shader.form == ShaderForm::kNone)
    source.error(node, "a case needs a shader, source or expr");
  else if (!expects)
    source.error(node, "a case needs something to expect");
  else if (c.table && c.setup.shader.form != ShaderForm::kExpression)
    source.error(node, "rows need an expr");
  else
    return true;
  return false;
}

} // namespace

TestFile read_test_file(const std::string& name, const std::string& text,
                        const std::vector<std::string>& path, SourceManager& sources, Diagnostics& diags) {
  TestFile file{name, {}};
  TomlSource source{name, sources.add(name, text), diags};
  toml::table root;
  try {
    root = toml::parse(text, name);
  } catch (const toml::parse_error& e) {
    const toml::source_position& at = e.source().begin;
    diags.error({source.file, at.line, at.column, at.column + 1}, std::string(e.description()));
    return file;
  }

  Case defaults;
  std::string folder = std::filesystem::path(name).parent_path().string();
  defaults.setup.path.push_back(folder.empty() ? "." : folder);
  defaults.setup.path.insert(defaults.setup.path.end(), path.begin(), path.end());
  TableReader top(root, source);
  if (const toml::table* t = top.table("defaults")) {
    TableReader table(*t, source);
    CaseReader(source, defaults).read(table);
    table.finish();
  }
  if (const toml::array* cases = top.array("case")) {
    for (const toml::node& node : *cases) {
      const toml::table* t = node.as_table();
      if (!t) {
        source.error(node, "each case is a table: [[case]]");
        continue;
      }
      Case c = defaults;
      c.where = source.where(node);
      c.name = fmt::format("case {}", file.cases.size() + 1);
      TableReader table(*t, source);
      table.read("name", c.name);
      CaseReader(source, c).read(table);
      table.finish();
      if (check_case(c, node, source)) file.cases.push_back(std::move(c));
    }
  } else if (!diags.has_errors()) {
    diags.error({source.file, 0, 0, 0}, "no [[case]] in this file");
  }
  top.finish();
  return file;
}

} // namespace slvm::sltest
