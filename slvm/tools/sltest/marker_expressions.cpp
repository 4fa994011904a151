// Conditions, and reads and assignments of variables that may not be set: expressions are replaced by calls
// of functions that hand a mark what it wants to know, and return what the expression gave.
#include "slvm/tools/sltest/marker.h"

#include <fmt/format.h>

namespace slvm::sltest {

using namespace slc;

void Marker::condition(ExprPtr& e, const char* what, SourceRange statement_range) {
  SourceRange where = e->range;
  if (!where.valid()) where = statement_range;
  expr(e);
  if (out_.options_.conditions && wanted(where)) mark_condition(e, what, where);
}

void Marker::right_side(LogicalExpr& e) {
  const SourceRange where = e.right->range;
  expr(e.right);
  if (out_.options_.right_sides && wanted(where)) mark_condition(e.right, e.is_and ? "&&" : "||", where);
}

void Marker::mark_condition(ExprPtr& e, const char* what, SourceRange where) {
  std::vector<SyntaxMaker::Formal> formals;
  formals.push_back(make_.formal("x", make_.float_of_bool(std::move(e))));
  Variable& x = *formals[0].variable;
  e = make_.bool_of_float(make_.call(
      std::move(formals), list(mark(MarkKind::kCondition, where, what, list(make_.read(x, where)))),
      make_.read(x, where)));
}

Variable* Marker::set_of(const Expr& e) const {
  const auto* v = as<VariableExpr>(&e);
  const auto* i = as<IndexExpr>(&e);
  auto it = set_of_.find(v ? v->variable : i ? i->variable : nullptr);
  return it == set_of_.end() ? nullptr : it->second;
}

void Marker::observe_read(ExprPtr& e, Variable& set) {
  const SourceRange where = e->range;
  if (!wanted(where)) return;
  std::vector<SyntaxMaker::Formal> formals;
  formals.push_back(make_.formal("x", std::move(e)));
  formals.push_back(make_.formal("set", make_.read(set, where)));
  Variable &x = *formals[0].variable, &known = *formals[1].variable;
  ExprPtr shown = mark(MarkKind::kRead, where, set.name, list(make_.read(known, where)));
  e = make_.call(std::move(formals), list(std::move(shown)), make_.read(x, where));
}

ExprPtr Marker::element_mark(Variable& known, const Variable& set, Variable& index, SourceRange where) {
  return mark(MarkKind::kRead, where, set.name,
              list(make_.element(known, make_.read(index, where)), whole(known, where, &set)));
}

void Marker::observe_element_read(ExprPtr& e, Variable& set) {
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

void Marker::set_element(ExprPtr& subscript, Variable& set, bool read_too) {
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

void Marker::set_assigned_element(ExprPtr& e, Variable& set) {
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

void Marker::set_after(ExprPtr& e, const std::vector<Variable*>& variables) {
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

void Marker::named(const std::string& name, ExprPtr& value) {
  computed_.push_back(name);
  expr(value);
  computed_.pop_back();
}

void Marker::expr(ExprPtr& e) {
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

void Marker::each(std::vector<ExprPtr>& list) {
  for (ExprPtr& e : list)
    expr(e);
}

Variable* Marker::place(Expr& e) {
  auto* i = as<IndexExpr>(&e);
  Variable* set = set_of(e);
  if (!i) return set;
  expr(i->index);
  if (set) set_element(i->index, *set, false);
  return nullptr;
}

void Marker::call(ExprPtr& e) {
  auto& c = static_cast<CallExpr&>(*e);
  std::vector<Variable*> set;
  auto argument = [&](ExprPtr& arg, bool output) {
    // Arrays as a whole may be set or read in there.
    if (!output && arg->array_length == kNotArray) return expr(arg);
    if (Variable* v = place(*arg)) set.push_back(v);
  };
  for (size_t i = 0; i < c.args.size(); ++i)
    argument(c.args[i], c.function ? c.function->formals[i]->output
                                   : c.info().signature.param(static_cast<int>(i)).output);
  for (TokenArg& t : c.tokens)
    argument(t.value, t.info && t.info->output);
  if (e->type == Type::kVoid)
    set_by_call_.insert(set_by_call_.end(), set.begin(), set.end());
  else
    set_after(e, set);
}

void Marker::assign(ExprPtr& e) {
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

} // namespace slvm::sltest
