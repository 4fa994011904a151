// Walks all shaders of a file; tells why variables vary.
#include "slc/sema/contexts.h"

#include "slc/sema/context_walk.h"

#include <algorithm>

namespace slc {

void ContextWalk::explain(const Instance& instance, std::string_view name,
                          std::vector<std::vector<slvm::Note>>& answers) const {
  auto tell = [](std::vector<slvm::Note>& answer, const VarState& s, std::string_view as) {
    const Variable& v = *s.declared;
    if (v.kind == VariableKind::kGlobal)
      answer.push_back({{}, fmt::format("'{}' is a predefined variable that varies", v.name)});
    else if (s.cause)
      for (slvm::Note& note : steps(*s.cause))
        answer.push_back(std::move(note));
    else
      answer.push_back({v.where, fmt::format("'{}' is uniform", as)});
  };
  for (const auto& [v, s] : instance.variables)
    if (v->name == name && s.declared) tell(answers.emplace_back(), s, name);
  for (const auto& [v, alias] : instance.aliases) {
    if (v->name != name) continue;
    std::vector<slvm::Note>& answer = answers.emplace_back();
    answer.push_back({alias.where, fmt::format("'{}' is '{}' of the caller here", name, alias.actual)});
    tell(answer, *alias.state, alias.actual);
  }
  for (const auto& [call, inner] : instance.calls)
    explain(*inner, name, answers);
}

std::vector<std::vector<slvm::Note>> ContextWalk::explain(std::string_view name) const {
  std::vector<std::vector<slvm::Note>> answers;
  explain(root_, name, answers);
  auto key = [](const std::vector<slvm::Note>& answer) {
    const SourceRange& r = answer.front().where;
    return std::tuple(r.file, r.line, r.column);
  };
  std::stable_sort(answers.begin(), answers.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  auto same = [](const slvm::Note& a, const slvm::Note& b) { return a.where == b.where && a.text == b.text; };
  auto end = std::unique(answers.begin(), answers.end(), [&](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
  });
  answers.erase(end, answers.end());
  slvm::Global global = slvm::find_global(name);
  if (!answers.empty() || global == Global::kCount) return answers;
  bool varies = slvm::global_info(global).detail == Detail::kVarying;
  return {
      {{{}, fmt::format("'{}' is a predefined variable that {}", name, varies ? "varies" : "is uniform")}}};
}

void check_contexts(TranslationUnit& unit, slvm::Diagnostics& diags) {
  Reported reported;
  for (Shader& shader : unit.shaders)
    ContextWalk(shader, diags, reported).run();
}

std::vector<std::vector<slvm::Note>> explain_varying(Shader& shader, std::string_view name) {
  slvm::Diagnostics known; // reported by check_contexts
  Reported reported;
  ContextWalk walk(shader, known, reported);
  walk.run();
  return walk.explain(name);
}

} // namespace slc
