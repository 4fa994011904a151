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
  e->array_length = variable.array_length;
  return e;
}

ExprPtr SyntaxMaker::element(Variable& array, ExprPtr index) {
  auto e = std::make_unique<IndexExpr>(index->range);
  e->name = array.name;
  e->variable = &array;
  e->type = array.type;
  e->index = std::move(index);
  return e;
}

ExprPtr SyntaxMaker::assign(ExprPtr target, ExprPtr value) {
  auto e = std::make_unique<AssignExpr>(value->range);
  e->type = target->type;
  e->target = std::move(target);
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

SyntaxMaker::Formal SyntaxMaker::formal(const std::string& name, ExprPtr actual, bool output) {
  Variable* v = variable(VariableKind::kFormal, name, actual->type, actual->range);
  if (actual->array_length != kNotArray) v->array_length = kOpenArray;
  v->output = output;
  return {v, std::move(actual)};
}

ExprPtr SyntaxMaker::call(std::vector<Formal> formals, std::vector<ExprPtr> body, ExprPtr result) {
  const SourceRange where = result->range;
  FunctionDef& f = unit_.functions.emplace_back();
  f.name = "mark";
  f.where = where;
  f.result = result->type;
  f.body = std::make_unique<BlockStmt>(where);
  for (ExprPtr& e : body)
    f.body->statements.push_back(statement(std::move(e)));
  auto back = std::make_unique<ReturnStmt>(where);
  back->value = std::move(result);
  f.body->statements.push_back(std::move(back));

  auto e = std::make_unique<CallExpr>(where);
  e->name = f.name;
  e->function = &f;
  e->type = f.result;
  for (Formal& formal : formals) {
    f.formals.push_back(formal.variable);
    e->args.push_back(std::move(formal.actual));
  }
  return e;
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
