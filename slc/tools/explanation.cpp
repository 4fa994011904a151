#include "slc/tools/explanation.h"

#include "slc/sema/contexts.h"

#include <fmt/format.h>

namespace slc {

std::string explanation(TranslationUnit& unit, std::string_view name, const slvm::SourceManager& sources) {
  std::string text;
  for (Shader& shader : unit.shaders) {
    const auto answers = explain_varying(shader, name);
    if (answers.empty()) continue;
    text += fmt::format("{} \"{}\"\n", slvm::shader_kind_name(shader.kind), shader.name);
    for (const auto& answer : answers)
      for (const slvm::Note& step : answer) {
        const slvm::SourceRange& at = step.where;
        if (at.valid()) text += fmt::format("{}:{}:{}: ", sources.name(at.file), at.line, at.column);
        text += step.text + '\n';
      }
  }
  return text;
}

std::string no_such_variable(const TranslationUnit& unit, std::string_view name, std::string_view file) {
  std::vector<std::string_view> names;
  for (const Variable& v : unit.variables)
    names.push_back(v.name);
  std::string text = fmt::format("slc: {} has no variable '{}'", file, name);
  if (std::string_view near = slvm::nearest_name(name, names); !near.empty())
    text += fmt::format("; did you mean '{}'?", near);
  return text + '\n';
}

} // namespace slc
