#include "slvm/tools/sltest/syntax_maker.h"

namespace slvm::sltest {

using namespace slc;

namespace {

ShadeopId row(std::string_view name, std::string_view signature) {
  return static_cast<ShadeopId>(find_shadeop(name, signature));
}

} // namespace

Variable* SyntaxMaker::variable(VariableKind kind, const std::string& name, Type type, SourceRange where) {
  Variable& v = unit_.variables.emplace_back();
  v.kind = kind;
  v.name = name;
  v.type = type;
  v.where = where;
  return &v;
}

ExprPtr SyntaxMaker::number(float value, SourceRange where) {
  auto e = std::make_unique<NumberExpr>(where);
  e->type = Type::kFloat;
  e->value = value;
  return e;
}

ExprPtr SyntaxMaker::read(Variable& variable, SourceRange where) {
  auto e = std::make_unique<VariableExpr>(where);
  e->name = variable.name;
  e->variable = &variable;
  e->type = variable.type;
  return e;
}

ExprPtr SyntaxMaker::element(Variable& array, int index, SourceRange where) {
  auto e = std::make_unique<IndexExpr>(where);
  e->name = array.name;
  e->variable = &array;
  e->type = array.type;
  e->index = number(static_cast<float>(index), where);
  return e;
}

ExprPtr SyntaxMaker::assign(Variable& variable, ExprPtr value, SourceRange where) {
  auto e = std::make_unique<AssignExpr>(where);
  e->type = variable.type;
  e->target = read(variable, where);
  e->value = std::move(value);
  return e;
}

ExprPtr SyntaxMaker::print(const std::string& text, std::vector<ExprPtr> values, SourceRange where) {
  auto pattern = std::make_unique<StringExpr>(where);
  pattern->type = Type::kString;
  pattern->value = text;
  auto e = std::make_unique<CallExpr>(where);
  e->name = "printf";
  e->shadeop = values.empty() ? row("printf", "void(uniform string pattern)")
                              : row("printf", "void(uniform string pattern, any values...)");
  e->args.push_back(std::move(pattern));
  for (ExprPtr& value : values)
    e->args.push_back(std::move(value));
  return e;
}

StmtPtr SyntaxMaker::statement(ExprPtr expression) {
  auto s = std::make_unique<ExpressionStmt>(expression->range);
  s->expressions.push_back(std::move(expression));
  return s;
}

ExprPtr SyntaxMaker::pass_through(ExprPtr value, Variable& x, std::vector<Formal> others,
                                  std::vector<ExprPtr> body) {
  const SourceRange where = value->range;
  FunctionDef& f = unit_.functions.emplace_back();
  f.name = "pass";
  f.where = where;
  f.result = value->type;
  f.body = std::make_unique<BlockStmt>(where);
  for (ExprPtr& e : body)
    f.body->statements.push_back(statement(std::move(e)));
  auto back = std::make_unique<ReturnStmt>(where);
  back->value = read(x, where);
  f.body->statements.push_back(std::move(back));

  auto call = std::make_unique<CallExpr>(where);
  call->name = f.name;
  call->function = &f;
  call->type = f.result;
  call->detail = value->detail;
  f.formals.push_back(&x);
  call->args.push_back(std::move(value));
  for (Formal& other : others) {
    f.formals.push_back(other.variable);
    call->args.push_back(std::move(other.actual));
  }
  return call;
}

ExprPtr SyntaxMaker::float_of_bool(ExprPtr condition) {
  const SourceRange where = condition->range;
  auto e = std::make_unique<ConditionalExpr>(where);
  e->type = Type::kFloat;
  e->condition = std::move(condition);
  e->then_value = number(1, where);
  e->else_value = number(0, where);
  return e;
}

ExprPtr SyntaxMaker::bool_of_float(ExprPtr value) {
  const SourceRange where = value->range;
  auto e = std::make_unique<OperatorExpr>(where);
  e->type = Type::kBool;
  e->op = Operator::kNotEqual;
  e->shadeop = row("operator!=", "bool(float a, float b)");
  e->operands.push_back(std::move(value));
  e->operands.push_back(number(0, where));
  return e;
}

} // namespace slvm::sltest
