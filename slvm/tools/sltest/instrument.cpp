#include "slvm/tools/sltest/instrument.h"

#include "slvm/tools/sltest/syntax_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace slvm::sltest {

using namespace slc;

/// The walk over one checked source.
class Marker {
public:
  Marker(Instrumenter& out, CheckedSource& checked, const SourceManager& sources)
      : out_(out), unit_(checked.unit), sources_(sources), make_(checked.unit) {}

  void run() {
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

private:
  // ---- Places.

  std::string file_of(SourceRange where) const { return std::string(sources_.name(where.file)); }

  /// Not the text that sltest puts around expressions.
  bool wanted(SourceRange where) const {
    return where.valid() && !sources_.name(where.file).starts_with('<');
  }

  ExprPtr mark(MarkKind kind, SourceRange where, const std::string& name, std::vector<ExprPtr> values) {
    const std::string file = file_of(where);
    const uint32_t number = out_.number_of({kind, file, where.line, where.column, name});
    out_.files_.try_emplace(file, sources_.text(where.file));
    return make_.print(fmt::format("{}{}", kMarkByte, number), std::move(values), where);
  }

  // ---- The probe.

  bool is_probed_file(SourceRange where) const {
    const std::string file = file_of(where), &wanted_file = out_.options_.probe->file;
    return file == wanted_file || file.ends_with("/" + wanted_file);
  }

  void find_probe_line() {
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

  static std::vector<const StmtPtr*> bodies(const Stmt& s) {
    if (const auto* x = as<IfStmt>(&s)) return {&x->then_branch, &x->else_branch};
    if (const auto* x = as<LoopStmt>(&s)) return {&x->body};
    if (const auto* x = as<IlluminanceStmt>(&s)) return {&x->body};
    if (const auto* x = as<EmissionStmt>(&s)) return {&x->body};
    if (const auto* x = as<GatherStmt>(&s)) return {&x->body, &x->else_body};
    return {};
  }

  bool probed(const Stmt& s) const {
    return probe_line_ && s.range.line == probe_line_ && is_probed_file(s.range);
  }

  Variable* visible(const std::string& name, SourceRange where) {
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

  /// A mark with the probed variable's value, or null where there is no such variable.
  StmtPtr probe(SourceRange where) {
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
      if (!found_)
        out_.probe_problem_ =
            fmt::format("no variable '{}' at {}:{}; there are {}", out_.options_.probe->name, file_of(where),
                        where.line, fmt::join(names, ", "));
      return nullptr;
    }
    found_ = true;
    out_.probe_problem_.clear();
    std::vector<ExprPtr> values;
    if (v->array_length == kNotArray) values.push_back(make_.read(*v, where));
    for (int i = 0; i < v->array_length; ++i)
      if (element < 0 || i == element) values.push_back(make_.element(*v, i, where));
    return make_.statement(mark(MarkKind::kProbe, where, out_.options_.probe->name, std::move(values)));
  }

  // ---- Statements.

  void function(FunctionDef& f) {
    const size_t outer = scope_.size();
    scope_.insert(scope_.end(), f.formals.begin(), f.formals.end());
    results_.push_back("the result of " + f.name);
    block(*f.body);
    results_.pop_back();
    scope_.resize(outer);
  }

  static bool does_something(const Stmt& s) {
    if (const auto* d = as<DeclarationStmt>(&s))
      return !d->is_extern && std::any_of(d->variables.begin(), d->variables.end(),
                                          [](const Variable* v) { return v->init != nullptr; });
    return s.kind != StmtKind::kEmpty && s.kind != StmtKind::kBlock && s.kind != StmtKind::kFunction;
  }

  void block(BlockStmt& b) {
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
      const bool before = here && (leaves || as<IfStmt>(s.get()));
      const bool after = here && !before && bodies(*s).empty() && !as<BlockStmt>(s.get());
      if (before) add(probe(where));
      statement(*s);
      list.push_back(std::move(s));
      if (after) add(probe(where));
    }
    b.statements = std::move(list);
    scope_.resize(outer);
  }

  /// The statement in a block of its own; `probed_head`: a probed loop, whose value is that of each pass.
  void body(StmtPtr& s, bool probed_head = false) {
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

  void statement(Stmt& s) {
    switch (s.kind) {
    case StmtKind::kBlock: block(static_cast<BlockStmt&>(s)); break;
    case StmtKind::kDeclaration: declaration(static_cast<DeclarationStmt&>(s)); break;
    case StmtKind::kFunction: function(*static_cast<FunctionStmt&>(s).function); break;
    case StmtKind::kExpression: expressions(static_cast<ExpressionStmt&>(s).expressions); break;
    case StmtKind::kIf: {
      auto& i = static_cast<IfStmt&>(s);
      condition(i.condition, "if", s.range);
      body(i.then_branch);
      body(i.else_branch);
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
    case StmtKind::kGather: {
      auto& g = static_cast<GatherStmt&>(s);
      body(g.body, probed(s));
      body(g.else_body);
      break;
    }
    case StmtKind::kEmpty:
    case StmtKind::kJump: break;
    }
  }

  void loop(LoopStmt& s) {
    const size_t outer = scope_.size();
    if (s.init) statement(*s.init);
    if (s.condition) condition(s.condition, s.is_for ? "for" : "while", s.range);
    expressions(s.steps);
    body(s.body, probed(s));
    scope_.resize(outer);
  }

  void declaration(DeclarationStmt& s) {
    if (s.is_extern) return;
    std::vector<Variable*> list;
    for (Variable* v : s.variables) {
      if (v->init) named(v->name, v->init);
      list.push_back(v);
      scope_.push_back(v);
      if (!out_.options_.reads || v->init || v->array_length != kNotArray || !wanted(v->where)) continue;
      Variable* set = make_.variable(VariableKind::kLocal, v->name, Type::kFloat, v->where);
      set->init = make_.number(0, v->where);
      set_of_[v] = set;
      list.push_back(set);
    }
    s.variables = std::move(list);
  }

  /// Expressions evaluated for their effects; what calls without a result set is marked behind them.
  void expressions(std::vector<ExprPtr>& list) {
    std::vector<ExprPtr> result;
    for (ExprPtr& e : list) {
      expr(e);
      const SourceRange where = e->range;
      result.push_back(std::move(e));
      for (Variable* set : std::exchange(set_by_call_, {}))
        result.push_back(make_.assign(*set, make_.number(1, where), where));
    }
    list = std::move(result);
  }

  // ---- Expressions.

  void condition(ExprPtr& e, const char* what, SourceRange statement_range) {
    SourceRange where = e->range;
    if (!where.valid()) where = statement_range;
    expr(e);
    if (!out_.options_.conditions || !wanted(where)) return;
    ExprPtr value = make_.float_of_bool(std::move(e));
    Variable* x = make_.variable(VariableKind::kFormal, "x", Type::kFloat, where);
    std::vector<ExprPtr> shown, run;
    shown.push_back(make_.read(*x, where));
    run.push_back(mark(MarkKind::kCondition, where, what, std::move(shown)));
    e = make_.bool_of_float(make_.pass_through(std::move(value), *x, {}, std::move(run)));
  }

  Variable* set_of(const Expr& e) const {
    const auto* v = as<VariableExpr>(&e);
    auto it = v ? set_of_.find(v->variable) : set_of_.end();
    return it == set_of_.end() ? nullptr : it->second;
  }

  /// `e` reads a variable: hands a mark whether that was set.
  void observe_read(ExprPtr& e, Variable& set) {
    const SourceRange where = e->range;
    if (!wanted(where)) return;
    Variable* x = make_.variable(VariableKind::kFormal, "x", e->type, where);
    Variable* formal = make_.variable(VariableKind::kFormal, "set", Type::kFloat, where);
    std::vector<ExprPtr> shown, run;
    shown.push_back(make_.read(*formal, where));
    run.push_back(mark(MarkKind::kRead, where, set.name, std::move(shown)));
    std::vector<SyntaxMaker::Formal> others;
    others.push_back({formal, make_.read(set, where)});
    e = make_.pass_through(std::move(e), *x, std::move(others), std::move(run));
  }

  /// Once `e` has its value, the variables count as set.
  void set_after(ExprPtr& e, const std::vector<Variable*>& variables) {
    if (variables.empty()) return;
    const SourceRange where = e->range;
    Variable* x = make_.variable(VariableKind::kFormal, "x", e->type, where);
    std::vector<SyntaxMaker::Formal> others;
    std::vector<ExprPtr> run;
    for (Variable* set : variables) {
      Variable* formal = make_.variable(VariableKind::kFormal, "set", Type::kFloat, where);
      formal->output = true;
      others.push_back({formal, make_.read(*set, where)});
      run.push_back(make_.assign(*formal, make_.number(1, where), where));
    }
    e = make_.pass_through(std::move(e), *x, std::move(others), std::move(run));
  }

  void named(const std::string& name, ExprPtr& value) {
    computed_.push_back(name);
    expr(value);
    computed_.pop_back();
  }

  void expr(ExprPtr& e) {
    if (!e) return;
    if (!computed_.empty() && wanted(e->range))
      out_.variables_[{file_of(e->range), e->range.line, e->range.column}] = computed_.back();
    switch (e->kind) {
    case ExprKind::kVariable:
      if (Variable* set = set_of(*e)) observe_read(e, *set);
      break;
    case ExprKind::kIndex: expr(static_cast<IndexExpr&>(*e).index); break;
    case ExprKind::kTuple: each(static_cast<TupleExpr&>(*e).elements); break;
    case ExprKind::kArrayInit: each(static_cast<ArrayInitExpr&>(*e).elements); break;
    case ExprKind::kOperator: each(static_cast<OperatorExpr&>(*e).operands); break;
    case ExprKind::kLogical:
      expr(static_cast<LogicalExpr&>(*e).left);
      expr(static_cast<LogicalExpr&>(*e).right);
      break;
    case ExprKind::kConditional: {
      auto& c = static_cast<ConditionalExpr&>(*e);
      condition(c.condition, "?:", e->range);
      expr(c.then_value);
      expr(c.else_value);
      break;
    }
    case ExprKind::kConvert: expr(static_cast<ConvertExpr&>(*e).operand); break;
    case ExprKind::kCall: call(e); break;
    case ExprKind::kAssign: assign(static_cast<AssignExpr&>(*e)); break;
    case ExprKind::kTargetValue:
      if (Variable* set = targets_.back()) observe_read(e, *set);
      break;
    case ExprKind::kNumber:
    case ExprKind::kString:
    case ExprKind::kCast: break;
    }
  }

  void each(std::vector<ExprPtr>& list) {
    for (ExprPtr& e : list)
      expr(e);
  }

  /// A place: its subscript is an expression, the rest is not read.
  void place(Expr& e) {
    if (auto* i = as<IndexExpr>(&e)) expr(i->index);
  }

  void call(ExprPtr& e) {
    auto& c = static_cast<CallExpr&>(*e);
    std::vector<Variable*> set;
    auto argument = [&](ExprPtr& arg, bool output) {
      if (!output) return expr(arg);
      place(*arg);
      if (Variable* v = set_of(*arg)) set.push_back(v);
    };
    for (size_t i = 0; i < c.args.size(); ++i)
      argument(c.args[i], c.function ? c.function->formals[i]->output
                                     : shadeop(c.shadeop).signature.param(static_cast<int>(i)).output);
    for (TokenArg& t : c.tokens)
      argument(t.value, t.info && t.info->output);
    if (e->type == Type::kVoid)
      set_by_call_.insert(set_by_call_.end(), set.begin(), set.end());
    else
      set_after(e, set);
  }

  void assign(AssignExpr& a) {
    Variable* set = set_of(*a.target);
    place(*a.target);
    const auto* v = as<VariableExpr>(a.target.get());
    targets_.push_back(set);
    named(v ? v->name : static_cast<IndexExpr&>(*a.target).name, a.value);
    targets_.pop_back();
    if (set) set_after(a.value, {set});
  }

  Instrumenter& out_;
  TranslationUnit& unit_;
  const SourceManager& sources_;
  SyntaxMaker make_;
  uint32_t probe_line_ = 0;
  bool found_ = false;
  std::vector<Variable*> scope_; ///< what is declared so far, innermost last
  std::map<const Variable*, Variable*> set_of_;
  std::vector<Variable*> set_by_call_;
  std::vector<Variable*> targets_;    ///< of the assignments around, whether they are set; null: not followed
  std::vector<std::string> computed_; ///< variables whose values are being computed
  std::vector<std::string> results_;  ///< of the functions around
};

Instrumenter::Instrumenter(InstrumentOptions options) : options_(std::move(options)) {
  static uint64_t count = 0;
  id_ = ++count;
}

void Instrumenter::instrument(CheckedSource& checked, const SourceManager& sources) {
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
