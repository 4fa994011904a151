// Conditions and state variables: which branches count, and the values strings are filled in with.
#include "render/state/condition.h"
#include "render/state/interpreter.h"
#include "render/state/state_values.h"

#include <fmt/format.h>

#include <algorithm>

namespace render {

/// True for requests of branches that are not taken. Those are looked at only for conditions inside.
bool Interpreter::skipped(const RequestCall& call) {
  if (skip_depth_ > 0) {
    if (call.id == RequestId::kIfBegin) ++skip_depth_;
    if (call.id == RequestId::kIfEnd && --skip_depth_ == 0) return false;
    bool next_branch = call.id == RequestId::kElseIf || call.id == RequestId::kElse;
    return !(next_branch && skip_depth_ == 1);
  }
  return false;
}

/// A condition that cannot be evaluated is false.
bool Interpreter::condition_holds(const RequestCall& call) {
  auto result = evaluate_condition(call.text(0), [&](std::string_view name) { return state_variable(name); });
  if (result) return *result;
  error_at(call.arguments[0].where, call, result.error() + "; the condition counts as false");
  return false;
}

void Interpreter::if_begin(const RequestCall& call) {
  open(call, BlockKind::kCondition);
  bool taken = condition_holds(call);
  blocks_.back().taken = taken;
  skip_depth_ = taken ? 0 : 1;
}

/// ElseIf and Else.
void Interpreter::else_branch(const RequestCall& call) {
  if (blocks_.empty() || blocks_.back().kind != BlockKind::kCondition) {
    error(call, "there is no open IfBegin; the request is skipped");
    return;
  }
  Block& block = blocks_.back();
  if (block.last_branch) error(call, "Else is the last branch of a condition; this one is not taken");
  bool last = call.id == RequestId::kElse;
  bool taken = !block.taken && !block.last_branch && (last || condition_holds(call));
  block.last_branch = block.last_branch || last;
  block.taken = block.taken || taken;
  skip_depth_ = taken ? 0 : 1;
}

void Interpreter::if_end(const RequestCall& call) {
  close(call, BlockKind::kCondition);
}

/// "Attribute:user:x" and "Option:user:x" choose; without them the attribute hides the option.
std::optional<slvm::Value> Interpreter::state_variable(std::string_view name) const {
  constexpr std::string_view kAttribute = "Attribute:", kOption = "Option:";
  const Options& options = in_world_ ? scene_.options : options_;
  if (name.starts_with(kAttribute)) return attribute_value(*attributes_, name.substr(kAttribute.size()));
  if (name.starts_with(kOption)) return option_value(options, name.substr(kOption.size()));
  if (auto value = attribute_value(*attributes_, name)) return value;
  return option_value(options, name);
}

std::optional<RequestCall> Interpreter::substitute(const RequestCall& call) {
  auto set = options_.named.find("ribparse:varsubst");
  std::string marks;
  if (set != options_.named.end() && !set->second.strings.empty()) marks = set->second.strings[0];
  if (marks.empty() && inline_depth_ > 0) marks = "$";
  if (marks.empty() || call.id == RequestId::kIfBegin || call.id == RequestId::kElseIf) return {};
  // The option that chooses the marks, and search paths with variables of the environment, stay as they are.
  if (call.id == RequestId::kOption && (call.text(0) == "ribparse" || call.text(0) == "searchpath"))
    return {};
  auto marked = [&](const std::string& s) { return s.find_first_of(marks) != std::string::npos; };
  auto any_marked = [&](const std::vector<std::string>& list) {
    return std::any_of(list.begin(), list.end(), marked);
  };
  bool needed = std::any_of(call.arguments.begin(), call.arguments.end(),
                            [&](auto& a) { return any_marked(a.strings); }) ||
                std::any_of(call.params.begin(), call.params.end(),
                            [&](auto& p) { return marked(p.token) || any_marked(p.strings); });
  if (!needed) return {};
  RequestCall out = call;
  auto fill = [&](std::string& s, slvm::SourceRange where) {
    if (!marked(s)) return;
    Substituted r = substitute_variables(s, marks, [&](std::string_view n) { return state_variable(n); });
    s = std::move(r.text);
    if (!r.unknown.empty())
      error_at(where, call, fmt::format("there is no variable \"{}\" to be put in here", r.unknown));
  };
  for (Argument& a : out.arguments)
    for (std::string& s : a.strings)
      fill(s, a.where);
  for (Param& p : out.params) {
    fill(p.token, p.where);
    for (std::string& s : p.strings)
      fill(s, p.where);
  }
  return out;
}

} // namespace render
