// The instrumenter, and its walk over statements.
#include "slvm/tools/sltest/marker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace slvm::sltest {

using namespace slc;

void Marker::run() {
  if (out_.options_.probe) find_probe_line();
  for (const Definition& d : std::vector<Definition>(unit_.definitions)) {
    scope_.clear();
    if (d.shader) {
      scope_ = d.shader->params;
      block(*d.shader->body);
    } else {
      function(*d.function);
    }
  }
}

std::string Marker::file_of(SourceRange where) const {
  return std::string(sources_.name(where.file));
}

bool Marker::wanted(SourceRange where) const {
  return where.valid() && !sources_.name(where.file).starts_with('<');
}

ExprPtr Marker::mark(MarkKind kind, SourceRange where, const std::string& name, std::vector<ExprPtr> values) {
  const std::string file = file_of(where);
  const uint32_t number = out_.number_of({kind, file, where.line, where.column, name});
  out_.files_.try_emplace(file, sources_.text(where.file));
  return make_.print(fmt::format("{}{}", kMarkByte, number), std::move(values), where);
}

void Marker::function(FunctionDef& f) {
  const size_t outer = scope_.size();
  scope_.insert(scope_.end(), f.formals.begin(), f.formals.end());
  results_.push_back("the result of " + f.name);
  block(*f.body);
  results_.pop_back();
  scope_.resize(outer);
}

bool Marker::does_something(const Stmt& s) {
  if (const auto* d = as<DeclarationStmt>(&s))
    return !d->is_extern && std::any_of(d->variables.begin(), d->variables.end(),
                                        [](const Variable* v) { return v->init != nullptr; });
  return s.kind != StmtKind::kEmpty && s.kind != StmtKind::kBlock && s.kind != StmtKind::kFunction;
}

void Marker::block(BlockStmt& b) {
  const size_t outer = scope_.size();
  std::vector<StmtPtr> list;
  auto add = [&](StmtPtr s) {
    if (s) list.push_back(std::move(s));
  };
  for (StmtPtr& s : b.statements) {
    const SourceRange where = s->range;
    if (out_.options_.statements && does_something(*s) && wanted(where))
      list.push_back(make_.statement(mark(MarkKind::kStatement, where, "", {})));
    const bool here = probed(*s), leaves = as<JumpStmt>(s.get()) || as<ReturnStmt>(s.get());
    const bool before = here && (as<IfStmt>(s.get()) || (leaves && !in_probed_if_));
    const bool after = here && !before && !leaves && bodies(*s).empty() && !as<BlockStmt>(s.get());
    if (before) add(probe(where));
    statement(*s);
    list.push_back(std::move(s));
    if (after) add(probe(where));
  }
  b.statements = std::move(list);
  scope_.resize(outer);
}

void Marker::body(StmtPtr& s, bool probed_head) {
  if (!s) return;
  if (!as<BlockStmt>(s.get())) {
    auto b = std::make_unique<BlockStmt>(s->range);
    b->statements.push_back(std::move(s));
    s = std::move(b);
  }
  auto& b = static_cast<BlockStmt&>(*s);
  StmtPtr head = probed_head ? probe(s->range) : nullptr;
  block(b);
  if (head) b.statements.insert(b.statements.begin(), std::move(head));
}

void Marker::statement(Stmt& s) {
  switch (s.kind) {
  case StmtKind::kBlock: block(static_cast<BlockStmt&>(s)); break;
  case StmtKind::kDeclaration: declaration(static_cast<DeclarationStmt&>(s)); break;
  case StmtKind::kFunction: function(*static_cast<FunctionStmt&>(s).function); break;
  case StmtKind::kExpression: expressions(static_cast<ExpressionStmt&>(s).expressions); break;
  case StmtKind::kIf: {
    auto& i = static_cast<IfStmt&>(s);
    condition(i.condition, "if", s.range);
    const bool outer = std::exchange(in_probed_if_, probed(s));
    body(i.then_branch);
    body(i.else_branch);
    in_probed_if_ = outer;
    break;
  }
  case StmtKind::kLoop: loop(static_cast<LoopStmt&>(s)); break;
  case StmtKind::kReturn:
    if (ExprPtr& value = static_cast<ReturnStmt&>(s).value) named(results_.back(), value);
    break;
  case StmtKind::kIlluminance: {
    auto& i = static_cast<IlluminanceStmt&>(s);
    for (ExprPtr* e : {&i.category, &i.position, &i.axis, &i.angle})
      expr(*e);
    body(i.body, probed(s));
    break;
  }
  case StmtKind::kEmission: {
    auto& e = static_cast<EmissionStmt&>(s);
    for (ExprPtr* x : {&e.position, &e.axis, &e.angle})
      expr(*x);
    body(e.body, probed(s));
    break;
  }
  case StmtKind::kGather: gather(static_cast<GatherStmt&>(s)); break;
  case StmtKind::kEmpty:
  case StmtKind::kJump: break;
  }
}

// Variables for what rays find count as set where these hit something, those for the ray itself in both
// blocks.
void Marker::gather(GatherStmt& s) {
  for (ExprPtr* e : {&s.category, &s.position, &s.direction, &s.angle, &s.samples})
    expr(*e);
  std::vector<Variable*> at_hits, always;
  for (TokenArg& t : s.tokens) {
    const bool output = t.info && t.info->output;
    if (!output && t.value->array_length == kNotArray) expr(t.value);
    Variable* set = output ? place(*t.value) : nullptr;
    if (!set) continue;
    at_hits.push_back(set);
    if (t.info->name != "ray:length" && t.info->name.find('*') == std::string_view::npos)
      always.push_back(set);
  }
  auto begin = [&](StmtPtr& block, const std::vector<Variable*>& variables) {
    if (variables.empty()) return;
    if (!block) block = std::make_unique<BlockStmt>(s.range);
    std::vector<StmtPtr>& list = static_cast<BlockStmt&>(*block).statements;
    for (Variable* set : variables)
      list.insert(list.begin(),
                  make_.statement(make_.assign(whole(*set, s.range), make_.number(1, s.range))));
  };
  body(s.body, probed(s));
  body(s.else_body);
  begin(s.body, at_hits);
  begin(s.else_body, always);
}

void Marker::loop(LoopStmt& s) {
  const size_t outer = scope_.size();
  if (s.init) statement(*s.init);
  if (s.condition) condition(s.condition, s.is_for ? "for" : "while", s.range);
  expressions(s.steps);
  body(s.body, probed(s));
  scope_.resize(outer);
}

void Marker::declaration(DeclarationStmt& s) {
  if (s.is_extern) return;
  std::vector<Variable*> list;
  for (Variable* v : s.variables) {
    if (v->init) named(v->name, v->init);
    list.push_back(v);
    scope_.push_back(v);
    if (!out_.options_.reads || v->init || !wanted(v->where)) continue;
    Variable* set = make_.variable(VariableKind::kLocal, v->name, Type::kFloat, v->where);
    if (v->array_length == kNotArray)
      set->init = make_.number(0, v->where);
    else
      set->array_length = v->array_length + 1; // the last element: all of them are set
    set_of_[v] = set;
    list.push_back(set);
  }
  s.variables = std::move(list);
}

void Marker::expressions(std::vector<ExprPtr>& list) {
  std::vector<ExprPtr> result;
  for (ExprPtr& e : list) {
    expr(e);
    const SourceRange where = e->range;
    result.push_back(std::move(e));
    for (Variable* set : std::exchange(set_by_call_, {}))
      result.push_back(make_.assign(whole(*set, where), make_.number(1, where)));
  }
  list = std::move(result);
}

ExprPtr Marker::whole(Variable& set, SourceRange where, const Variable* length_of) {
  if (set.array_length == kNotArray) return make_.read(set, where);
  const int length = (length_of ? length_of : &set)->array_length;
  return make_.element(set, make_.number(static_cast<float>(length - 1), where));
}

Instrumenter::Instrumenter(InstrumentOptions options) : options_(std::move(options)) {
  static uint64_t count = 0;
  id_ = ++count;
}

void Instrumenter::instrument(CheckedSource& checked, const SourceManager& sources) {
  met_sources_ = true;
  Marker(*this, checked, sources).run();
}

std::string Instrumenter::variable_at(std::string_view file, uint32_t line, uint32_t column) const {
  auto it = variables_.find({std::string(file), line, column});
  return it == variables_.end() ? "" : it->second;
}

uint32_t Instrumenter::number_of(Mark mark) {
  auto [it, is_new] = numbers_.try_emplace(mark, static_cast<uint32_t>(marks_.size()));
  if (is_new) marks_.push_back(std::move(mark));
  return it->second;
}

} // namespace slvm::sltest
