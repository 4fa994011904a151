#include "slvm/tools/sltest/table.h"

#include "slvm/tools/sltest/expression.h"

#include <fmt/format.h>

#include <algorithm>

namespace slvm::sltest {
namespace {

/// More than two strips of the usual width, and not a multiple of any vector width.
constexpr size_t kPoints = 301;
constexpr float kUntouched = -77;
constexpr int kRounds = 3;

bool must_be_uniform(const Declaration& column) {
  return column.detail == Detail::kUniform || column.type == Type::kString || column.elements > 0;
}

/// The code as statements that set `result`.
std::string assignment(const std::string& code) {
  return is_statements(code) ? code : fmt::format("{} = {};", kResultName, code);
}

enum class Flow : uint8_t { kStraight, kMasked, kLoop };

std::string wrapped(const std::string& code, Flow flow) {
  const std::string set = assignment(code);
  if (flow == Flow::kMasked)
    return fmt::format("result = {};\nif (table_even == 1) {{\n{}\n}}", static_cast<int>(kUntouched), set);
  if (flow == Flow::kLoop)
    return fmt::format(
        "float table_k;\nfor (table_k = 0; table_k < {}; table_k += 1) {{\nif (table_k == table_round) "
        "{{\n{}\nbreak;\n}}\n}}",
        kRounds, set);
  return set;
}

/// All components of a cell: a single number stands for three.
std::vector<float> cell_numbers(const RawValue& cell, Type type) {
  auto value = to_value(cell, type, 0);
  return value ? value->numbers : std::vector<float>(static_cast<size_t>(components(type)));
}

/// A list with one value a point: rows[i % size] of a column.
RawValue tile(const Table& table, std::span<const size_t> rows, size_t column, size_t points) {
  RawValue list;
  list.list = true;
  list.where = table.rows[rows[0]][column].where;
  const Type type = *table.columns[column].type;
  for (size_t i = 0; i < points; ++i)
    for (float x : cell_numbers(table.rows[rows[i % rows.size()]][column], type))
      list.numbers.push_back(x);
  list.inner = static_cast<uint32_t>(components(type));
  return list;
}

Setting varying_float(const char* name, size_t points, float (*value)(size_t)) {
  Setting s{{name, Detail::kVarying, Type::kFloat, 0}, {}};
  s.value.list = true;
  for (size_t i = 0; i < points; ++i)
    s.value.numbers.push_back(value(i));
  return s;
}

class Expander {
public:
  explicit Expander(const Case& c) : case_(c), table_(*c.table), result_(c.table->columns.size() - 1) {}

  std::vector<Case> run() {
    for (size_t row = 0; row < table_.rows.size(); ++row)
      add_uniform(row);
    const bool any_varying = std::any_of(table_.columns.begin(), table_.columns.end() - 1,
                                         [](const Declaration& d) { return !must_be_uniform(d); });
    if (!any_varying || must_be_uniform(table_.columns[result_])) return std::move(cases_);
    std::vector<size_t> all(table_.rows.size());
    for (size_t i = 0; i < all.size(); ++i)
      all[i] = i;
    const bool together = std::none_of(table_.columns.begin(), table_.columns.end() - 1, must_be_uniform);
    for (Flow flow : {Flow::kStraight, Flow::kMasked, Flow::kLoop}) {
      if (together)
        add_varying(all, flow);
      else
        for (size_t row : all)
          add_varying({&row, 1}, flow);
    }
    return std::move(cases_);
  }

private:
  Case base(const Where& where, std::string_view suffix) const {
    Case c = case_;
    c.table.reset();
    c.where = where;
    c.name += fmt::format(", {}", suffix);
    c.setup.shader.result = table_.columns[result_].type;
    c.setup.grid.nu = c.setup.grid.nv = 1;
    return c;
  }

  void set_uniform(Case& c, size_t row, size_t column) const {
    Setting s{table_.columns[column], table_.rows[row][column]};
    s.what.detail = Detail::kUniform;
    c.setup.shader.params.push_back(std::move(s));
  }

  Expectation expectation(Check check, const RawValue& value) const {
    return {check, kResultName, value, 0, 0, case_.tolerance};
  }

  void add_uniform(size_t row) {
    const RawValue& wanted = table_.rows[row][result_];
    Case c = base(wanted.where, "uniform arguments");
    for (size_t column = 0; column < result_; ++column)
      set_uniform(c, row, column);
    c.expectations.push_back(expectation(Check::kAll, wanted));
    cases_.push_back(std::move(c));
  }

  void add_varying(std::span<const size_t> rows, Flow flow) {
    constexpr std::string_view kNames[] = {"varying arguments", "varying arguments under a mask",
                                           "varying arguments in a loop"};
    const size_t points = rows.size() == 1 ? 37 : std::max(kPoints, rows.size());
    Case c = base(table_.rows[rows[0]][result_].where, kNames[static_cast<size_t>(flow)]);
    c.setup.grid.nu = static_cast<int>(points);
    c.setup.shader.text = wrapped(c.setup.shader.text, flow);
    for (size_t column = 0; column < result_; ++column) {
      if (must_be_uniform(table_.columns[column])) {
        set_uniform(c, rows[0], column);
        continue;
      }
      Setting s{table_.columns[column], tile(table_, rows, column, points)};
      s.what.detail = Detail::kVarying;
      c.setup.primvars.push_back(std::move(s));
    }
    RawValue wanted = tile(table_, rows, result_, points);
    if (flow == Flow::kMasked) {
      c.setup.primvars.push_back(
          varying_float("table_even", points, [](size_t i) { return i % 2 == 0 ? 1.0f : 0.0f; }));
      clear_odd(wanted, points);
    }
    if (flow == Flow::kLoop)
      c.setup.primvars.push_back(
          varying_float("table_round", points, [](size_t i) { return static_cast<float>(i % kRounds); }));
    c.expectations.push_back(expectation(Check::kPoints, wanted));
    cases_.push_back(std::move(c));
  }

  /// Every other point keeps what it had.
  void clear_odd(RawValue& wanted, size_t points) const {
    const size_t width = wanted.inner;
    for (size_t i = 1; i < points; i += 2)
      for (size_t k = 0; k < width; ++k)
        wanted.numbers[i * width + k] = width == 16 && k % 5 != 0 ? 0 : kUntouched;
  }

  const Case& case_;
  const Table& table_;
  size_t result_;
  std::vector<Case> cases_;
};

} // namespace

std::vector<Case> expand_table(const Case& c) {
  return c.table ? Expander(c).run() : std::vector<Case>{c};
}

} // namespace slvm::sltest
