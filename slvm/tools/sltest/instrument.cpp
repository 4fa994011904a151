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
      if (element < 0 || i == element)
        values.push_back(make_.element(*v, make_.number(static_cast<float>(i), where)));
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

  /// Expressions evaluated for their effects; what calls without a result set is marked behind them.
  void expressions(std::vector<ExprPtr>& list) {
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

  /// What tells that all of a variable is set.
  ExprPtr whole(Variable& set, SourceRange where, const Variable* length_of = nullptr) {
    if (set.array_length == kNotArray) return make_.read(set, where);
    const int length = (length_of ? length_of : &set)->array_length;
    return make_.element(set, make_.number(static_cast<float>(length - 1), where));
  }

  // ---- Expressions.

  void condition(ExprPtr& e, const char* what, SourceRange statement_range) {
    SourceRange where = e->range;
    if (!where.valid()) where = statement_range;
    expr(e);
    if (out_.options_.conditions && wanted(where)) mark_condition(e, what, where);
  }

  void right_side(LogicalExpr& e) {
    const SourceRange where = e.right->range;
    expr(e.right);
    if (out_.options_.right_sides && wanted(where)) mark_condition(e.right, e.is_and ? "&&" : "||", where);
  }

  void mark_condition(ExprPtr& e, const char* what, SourceRange where) {
    std::vector<SyntaxMaker::Formal> formals;
    formals.push_back(make_.formal("x", make_.float_of_bool(std::move(e))));
    Variable& x = *formals[0].variable;
    e = make_.bool_of_float(make_.call(
        std::move(formals), list(mark(MarkKind::kCondition, where, what, list(make_.read(x, where)))),
        make_.read(x, where)));
  }

  template <class... Items> static std::vector<ExprPtr> list(Items... items) {
    std::vector<ExprPtr> out;
    (out.push_back(std::move(items)), ...);
    return out;
  }

  Variable* set_of(const Expr& e) const {
    const auto* v = as<VariableExpr>(&e);
    const auto* i = as<IndexExpr>(&e);
    auto it = set_of_.find(v ? v->variable : i ? i->variable : nullptr);
    return it == set_of_.end() ? nullptr : it->second;
  }

  /// `e` reads a variable: hands a mark whether that was set.
  void observe_read(ExprPtr& e, Variable& set) {
    const SourceRange where = e->range;
    if (!wanted(where)) return;
    std::vector<SyntaxMaker::Formal> formals;
    formals.push_back(make_.formal("x", std::move(e)));
    formals.push_back(make_.formal("set", make_.read(set, where)));
    Variable &x = *formals[0].variable, &known = *formals[1].variable;
    ExprPtr shown = mark(MarkKind::kRead, where, set.name, list(make_.read(known, where)));
    e = make_.call(std::move(formals), list(std::move(shown)), make_.read(x, where));
  }

  /// What hands a mark whether the element was set.
  ExprPtr element_mark(Variable& known, const Variable& set, Variable& index, SourceRange where) {
    return mark(MarkKind::kRead, where, set.name,
                list(make_.element(known, make_.read(index, where)), whole(known, where, &set)));
  }

  /// `e` reads an element of an array.
  void observe_element_read(ExprPtr& e, Variable& set) {
    const SourceRange where = e->range;
    if (!wanted(where)) return;
    auto& old = static_cast<IndexExpr&>(*e);
    std::vector<SyntaxMaker::Formal> formals;
    formals.push_back(make_.formal("index", std::move(old.index)));
    formals.push_back(make_.formal("array", make_.read(*old.variable, where)));
    formals.push_back(make_.formal("set", make_.read(set, where)));
    Variable &index = *formals[0].variable, &array = *formals[1].variable, &known = *formals[2].variable;
    e = make_.call(std::move(formals), list(element_mark(known, set, index, where)),
                   make_.element(array, make_.read(index, where)));
  }

  /// The subscript of an element that is stored to: the element counts as set, after it was read where it is.
  void set_element(ExprPtr& subscript, Variable& set, bool read_too) {
    const SourceRange where = subscript->range;
    std::vector<SyntaxMaker::Formal> formals;
    formals.push_back(make_.formal("index", std::move(subscript)));
    formals.push_back(make_.formal("set", make_.read(set, where)));
    Variable &index = *formals[0].variable, &known = *formals[1].variable;
    std::vector<ExprPtr> run;
    if (read_too && wanted(where)) run.push_back(element_mark(known, set, index, where));
    run.push_back(make_.assign(make_.element(known, make_.read(index, where)), make_.number(1, where)));
    subscript = make_.call(std::move(formals), std::move(run), make_.read(index, where));
  }

  /// `array[index] = value`: the element counts as set once the value is known.
  void set_assigned_element(ExprPtr& e, Variable& set) {
    auto& a = static_cast<AssignExpr&>(*e);
    auto& target = static_cast<IndexExpr&>(*a.target);
    const SourceRange where = e->range;
    std::vector<SyntaxMaker::Formal> formals;
    formals.push_back(make_.formal("index", std::move(target.index)));
    formals.push_back(make_.formal("array", make_.read(*target.variable, where)));
    formals.push_back(make_.formal("set", make_.read(set, where)));
    formals.push_back(make_.formal("x", std::move(a.value)));
    Variable &index = *formals[0].variable, &array = *formals[1].variable, &known = *formals[2].variable,
             &x = *formals[3].variable;
    ExprPtr knows = make_.assign(make_.element(known, make_.read(index, where)), make_.number(1, where));
    ExprPtr store = make_.assign(make_.element(array, make_.read(index, where)), make_.read(x, where));
    e = make_.call(std::move(formals), list(std::move(knows), std::move(store)), make_.read(x, where));
  }

  /// Once `e` has its value, the variables count as set.
  void set_after(ExprPtr& e, const std::vector<Variable*>& variables) {
    if (variables.empty()) return;
    const SourceRange where = e->range;
    std::vector<SyntaxMaker::Formal> formals;
    formals.push_back(make_.formal("x", std::move(e)));
    Variable& x = *formals[0].variable;
    std::vector<ExprPtr> run;
    for (Variable* set : variables) {
      formals.push_back(make_.formal("set", make_.read(*set, where), true));
      run.push_back(make_.assign(whole(*formals.back().variable, where, set), make_.number(1, where)));
    }
    e = make_.call(std::move(formals), std::move(run), make_.read(x, where));
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
    case ExprKind::kIndex:
      expr(static_cast<IndexExpr&>(*e).index);
      if (Variable* set = set_of(*e)) observe_element_read(e, *set);
      break;
    case ExprKind::kTuple: each(static_cast<TupleExpr&>(*e).elements); break;
    case ExprKind::kArrayInit: each(static_cast<ArrayInitExpr&>(*e).elements); break;
    case ExprKind::kOperator: each(static_cast<OperatorExpr&>(*e).operands); break;
    case ExprKind::kLogical:
      expr(static_cast<LogicalExpr&>(*e).left);
      right_side(static_cast<LogicalExpr&>(*e));
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
    case ExprKind::kAssign: assign(e); break;
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

  /// A place that a call sets: its subscript is an expression, the rest is not read. What is set as a whole
  /// is told.
  Variable* place(Expr& e) {
    auto* i = as<IndexExpr>(&e);
    Variable* set = set_of(e);
    if (!i) return set;
    expr(i->index);
    if (set) set_element(i->index, *set, false);
    return nullptr;
  }

  void call(ExprPtr& e) {
    auto& c = static_cast<CallExpr&>(*e);
    std::vector<Variable*> set;
    auto argument = [&](ExprPtr& arg, bool output) {
      // Arrays as a whole may be set or read in there.
      if (!output && arg->array_length == kNotArray) return expr(arg);
      if (Variable* v = place(*arg)) set.push_back(v);
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

  void assign(ExprPtr& e) {
    auto& a = static_cast<AssignExpr&>(*e);
    Variable* set = set_of(*a.target);
    auto* index = as<IndexExpr>(a.target.get());
    if (index) expr(index->index);
    targets_.push_back(index ? nullptr : set);
    named(index ? index->name : static_cast<VariableExpr&>(*a.target).name, a.value);
    targets_.pop_back();
    if (!set) return;
    if (index && a.compound)
      set_element(index->index, *set, true);
    else if (index)
      set_assigned_element(e, *set);
    else if (a.target->array_length != kNotArray)
      set_by_call_.push_back(set);
    else
      set_after(a.value, {set});
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
