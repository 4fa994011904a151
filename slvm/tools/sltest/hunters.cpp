#include "slvm/tools/sltest/hunters.h"

#include "slvm/tools/sltest/value.h"

#include <cmath>

namespace slvm::sltest {
namespace {

bool holds_numbers(const StepOperand& o) {
  return o.planes.type != Type::kString && o.planes.type != Type::kBool;
}

size_t planes_of(const StepOperand& o) {
  return static_cast<size_t>(components(o.planes.type)) * std::max(o.planes.elements, 1u);
}

bool finite_at(const StepOperand& o, size_t point) {
  for (size_t k = 0; k < planes_of(o); ++k)
    if (!std::isfinite(o.planes.get(k, point))) return false;
  return true;
}

std::string value_text(const StepOperand& o, size_t point) {
  std::vector<float> numbers;
  for (size_t k = 0; k < planes_of(o); ++k) {
    const float x = o.planes.get(k, point);
    numbers.push_back(std::isnan(x) ? std::abs(x) : x); // its sign depends on the processor
  }
  return numbers.size() == 1 ? numbers_text(numbers) : fmt::format("({})", numbers_text(numbers));
}

/// As it stands in source: "'/'", "'sqrt'", "a conversion".
std::string operation_name(std::string_view name) {
  if (name.starts_with("operator")) name.remove_prefix(8);
  return name == "convert" ? "a conversion" : fmt::format("'{}'", name);
}

} // namespace

NanHunter::Finding& NanHunter::finding(const ExecutionStep& step, const std::string& what) {
  const SourcePlace place = step.place();
  const std::string head = fmt::format("{}:{}: {} \"{}\": {}", place.file, place.line,
                                       shader_kind_name(step.program().kind), step.program().name, what);
  auto [it, is_new] = known_.try_emplace(head, findings_.size());
  if (is_new) findings_.push_back({head, "", {}, static_cast<size_t>(step.grid().nu())});
  return findings_[it->second];
}

void NanHunter::read(const ExecutionStep& step, std::string_view variable, const StepOperand& value) {
  const bool parameter = find_global(variable) == Global::kCount;
  const size_t points = step.grid().points();
  for_each_active(step, [&](size_t point, size_t i) {
    if (finite_at(value, i)) return;
    Finding& f = finding(step, fmt::format("{} '{}' is not finite where it is read",
                                           parameter ? "parameter" : "variable", variable));
    if (f.points.empty()) f.tail = fmt::format("; first {}", value_text(value, i));
    f.points.add(point, points);
  });
}

void NanHunter::after(const ExecutionStep& step) {
  const std::vector<StepOperand> operands = step.operands();
  const size_t points = step.grid().points();
  if (!step.call()) { // an element of an array
    if (!operands[1].variable.empty() && holds_numbers(operands[1]))
      read(step, operands[1].variable, operands[0]);
    return;
  }
  const ShadeopInfo& call = *step.call();
  for (const StepOperand& o : operands)
    if (!o.stored && !o.variable.empty() && holds_numbers(o)) read(step, o.variable, o);

  // Differences see neighbours: one point that is not finite explains all.
  auto explained = [&](size_t i) {
    for (const StepOperand& o : operands) {
      if (o.stored || !holds_numbers(o)) continue;
      const bool everywhere = (call.flags & kDerivative) && o.planes.step;
      for (size_t k = everywhere ? 0 : i; k < (everywhere ? step.points() : i + 1); ++k)
        if (!finite_at(o, k)) return true;
    }
    return false;
  };
  for (const StepOperand& o : operands) {
    if (!o.stored || !holds_numbers(o)) continue;
    for_each_active(step, [&](size_t point, size_t i) {
      if (finite_at(o, i) || explained(i)) return;
      const SourcePlace place = step.place();
      std::string variable = o.variable.empty()
                                 ? instrumenter_.variable_at(place.file, place.line, place.column)
                                 : std::string(o.variable);
      if (!variable.empty() && !variable.starts_with("the ")) variable = fmt::format("'{}'", variable);
      Finding& f =
          finding(step, fmt::format("{}{}{} gives a number that is not finite", operation_name(call.name),
                                    variable.empty() ? "" : " for ", variable));
      if (f.points.empty()) {
        std::string given;
        for (const StepOperand& in : operands)
          if (!in.stored && holds_numbers(in) && !in.planes.elements)
            given += fmt::format("{}{}", given.empty() ? "" : ", ", value_text(in, i));
        f.tail = fmt::format("; first {}{}{}", value_text(o, i), given.empty() ? "" : " from ", given);
      }
      f.points.add(point, points);
    });
  }
}

std::vector<std::string> NanHunter::findings() const {
  std::vector<std::string> list;
  for (const Finding& f : findings_)
    list.push_back(fmt::format("{} at {}{}", f.head, f.points.text(f.nu), f.tail));
  return list;
}

void UninitHunter::marked(uint32_t number, const ExecutionStep& step, std::span<const StepOperand> values) {
  const Mark& mark = instrumenter_.marks()[number];
  if (mark.kind != MarkKind::kRead) return;
  const std::string key = fmt::format("{}:{}: '{}'", mark.file, mark.line, mark.name);
  nu_ = static_cast<size_t>(step.grid().nu());
  const size_t points = step.grid().points();
  for_each_active(step, [&](size_t point, size_t i) {
    // Of an element: whether it was set, and whether all of the array was.
    for (const StepOperand& set : values)
      if (set.planes.get(0, i) != 0) return;
    PointSet& set = reads_[key];
    if (set.empty()) order_.push_back(key);
    set.add(point, points);
  });
}

std::vector<std::string> UninitHunter::findings() const {
  std::vector<std::string> list;
  for (const std::string& key : order_)
    list.push_back(fmt::format("{} is read but was never set at {}", key, reads_.at(key).text(nu_)));
  return list;
}

} // namespace slvm::sltest
