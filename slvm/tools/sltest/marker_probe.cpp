// Where the probe goes, and what it shows there.
#include "slvm/tools/sltest/marker.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace slvm::sltest {

using namespace slc;

bool Marker::is_probed_file(SourceRange where) const {
  const std::string file = file_of(where), &wanted_file = out_.options_.probe->file;
  return file == wanted_file || file.ends_with("/" + wanted_file);
}

void Marker::find_probe_line() {
  std::vector<const Stmt*> todo;
  for (const Shader& s : unit_.shaders)
    todo.push_back(s.body.get());
  for (const FunctionDef& f : unit_.functions)
    todo.push_back(f.body.get());
  const uint32_t line = out_.options_.probe->line;
  while (!todo.empty()) {
    const Stmt* s = todo.back();
    todo.pop_back();
    if (!s) continue;
    if (const auto* b = as<BlockStmt>(s))
      for (const StmtPtr& inner : b->statements)
        todo.push_back(inner.get());
    else if (wanted(s->range) && is_probed_file(s->range) && s->range.line <= line)
      probe_line_ = std::max(probe_line_, s->range.line);
    for (const StmtPtr* inner : bodies(*s))
      todo.push_back(inner->get());
  }
  if (!probe_line_ && out_.probe_problem_.empty())
    out_.probe_problem_ =
        fmt::format("no statement of the shader is at or before {}:{}", out_.options_.probe->file, line);
}

std::vector<const StmtPtr*> Marker::bodies(const Stmt& s) {
  if (const auto* x = as<IfStmt>(&s)) return {&x->then_branch, &x->else_branch};
  if (const auto* x = as<LoopStmt>(&s)) return {&x->body};
  if (const auto* x = as<IlluminanceStmt>(&s)) return {&x->body};
  if (const auto* x = as<EmissionStmt>(&s)) return {&x->body};
  if (const auto* x = as<GatherStmt>(&s)) return {&x->body, &x->else_body};
  return {};
}

bool Marker::probed(const Stmt& s) const {
  return probe_line_ && s.range.line == probe_line_ && is_probed_file(s.range);
}

Variable* Marker::visible(const std::string& name, SourceRange where) {
  for (size_t i = scope_.size(); i-- > 0;)
    if (scope_[i]->name == name) return scope_[i];
  const Global g = find_global(name);
  if (g == Global::kCount) return nullptr;
  for (const Shader& s : unit_.shaders)
    if (global_info(g).access[static_cast<size_t>(s.kind)] == '-') return nullptr;
  Variable* v = make_.variable(VariableKind::kGlobal, name, global_info(g).type, where);
  v->global = g;
  return v;
}

StmtPtr Marker::probe(SourceRange where) {
  std::string name = out_.options_.probe->name;
  int element = -1;
  if (const size_t bracket = name.find('['); bracket != std::string::npos) {
    std::from_chars(name.data() + bracket + 1, name.data() + name.size(), element);
    name.resize(bracket);
  }
  Variable* v = visible(name, where);
  if (!v || (element >= 0 && element >= v->array_length)) {
    std::vector<std::string_view> names;
    for (const Variable* known : scope_)
      names.push_back(known->name);
    out_.probe_problem_ = fmt::format("no variable '{}' at {}:{}; there are {}", out_.options_.probe->name,
                                      file_of(where), where.line, fmt::join(names, ", "));
    return nullptr;
  }
  out_.probe_found_ = true;
  std::vector<ExprPtr> values;
  if (v->array_length == kNotArray) values.push_back(make_.read(*v, where));
  for (int i = 0; i < v->array_length; ++i)
    if (element < 0 || i == element)
      values.push_back(make_.element(*v, make_.number(static_cast<float>(i), where)));
  return make_.statement(mark(MarkKind::kProbe, where, out_.options_.probe->name, std::move(values)));
}

} // namespace slvm::sltest
