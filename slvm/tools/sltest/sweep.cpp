#include "slvm/tools/sltest/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace slvm::sltest {
namespace {

/// More runs than anybody waits for.
constexpr size_t kMostCombinations = 10000;
constexpr double kMostSteps = 1000;

constexpr std::pair<std::string_view, SweepTarget> kTargets[] = {{"params", SweepTarget::kParam},
                                                                 {"set", SweepTarget::kVariable},
                                                                 {"attributes", SweepTarget::kAttribute},
                                                                 {"options", SweepTarget::kOption}};

/// `{ from, to, steps }`: so many numbers, the ends among them.
bool read_range(const toml::table& t, const toml::node& node, const TomlSource& source, Sweep& sweep) {
  TableReader table(t, source);
  double from = 0, to = 1, steps = 0;
  const bool complete = table.read("from", from) && table.read("to", to) && table.read("steps", steps);
  table.finish();
  if (!complete || steps < 2 || steps > kMostSteps || steps != std::floor(steps)) {
    source.error(node, fmt::format("a sweep is a list of values, or {{from, to, steps}} with 2 to {} steps",
                                   kMostSteps));
    return false;
  }
  for (double i = 0; i < steps; ++i) {
    RawValue& value = sweep.values.emplace_back();
    value.numbers.push_back(static_cast<float>(from + (to - from) * i / (steps - 1)));
    value.where = source.where(node);
  }
  return true;
}

void read_sweep(const std::string& name, const toml::node& node, SweepTarget target, const TomlSource& source,
                std::vector<Sweep>& sweeps) {
  auto declaration = parse_declaration(name);
  if (!declaration) return source.error(node, declaration.error());
  Sweep sweep{target, *declaration, {}};
  if (target == SweepTarget::kParam && find_global(declaration->name) != Global::kCount)
    sweep.target = SweepTarget::kVariable;
  if (const toml::table* t = node.as_table()) {
    if (!read_range(*t, node, source, sweep)) return;
  } else if (const toml::array* list = node.as_array(); list && !list->empty()) {
    for (const toml::node& item : *list)
      if (!read_raw(item, source, sweep.values.emplace_back())) return;
  } else {
    return source.error(node, "a sweep is a list of values, or {from, to, steps}");
  }
  std::erase_if(sweeps, [&](const Sweep& old) {
    return old.target == sweep.target && old.what.name == sweep.what.name;
  });
  sweeps.push_back(std::move(sweep));
  size_t combinations = 1;
  for (const Sweep& s : sweeps)
    combinations *= s.values.size();
  if (combinations > kMostCombinations)
    source.error(node, fmt::format("{} combinations, more than {}", combinations, kMostCombinations));
}

void apply(const Sweep& sweep, const RawValue& value, Case& c) {
  std::vector<Setting>& list = sweep.target == SweepTarget::kParam       ? c.setup.shader.params
                               : sweep.target == SweepTarget::kVariable  ? c.setup.variables
                               : sweep.target == SweepTarget::kAttribute ? c.setup.attributes
                                                                         : c.setup.options;
  const std::string& name = sweep.what.name;
  c.name += fmt::format(", {} = {}", name,
                        value.is_text() ? fmt::format("{}", fmt::join(value.strings, " "))
                                        : numbers_text(value.numbers));
  auto known = std::find_if(list.begin(), list.end(), [&](const Setting& s) { return s.what.name == name; });
  if (known == list.end())
    list.push_back({sweep.what, value});
  else
    known->value = value; // variables are set in the order of the file
}

} // namespace

void read_sweeps(const toml::table& table, const TomlSource& source, std::vector<Sweep>& sweeps) {
  for (const auto& [key, node] : in_file_order(table)) {
    const std::string& name = key;
    auto target = std::find_if(std::begin(kTargets), std::end(kTargets),
                               [&](const auto& t) { return t.first == name; });
    if (target == std::end(kTargets)) {
      read_sweep(name, *node, SweepTarget::kParam, source, sweeps);
    } else if (const toml::table* inner = node->as_table()) {
      for (const auto& [inner_name, inner_node] : in_file_order(*inner))
        read_sweep(inner_name, *inner_node, target->second, source, sweeps);
    } else {
      source.error(*node, fmt::format("'{}' must be a table", name));
    }
  }
}

std::vector<Case> expand_sweeps(const Case& c) {
  std::vector<Case> cases{c};
  for (const Sweep& sweep : c.sweeps) {
    std::vector<Case> more;
    for (const Case& base : cases)
      for (const RawValue& value : sweep.values)
        apply(sweep, value, more.emplace_back(base));
    cases = std::move(more);
  }
  return cases;
}

} // namespace slvm::sltest
