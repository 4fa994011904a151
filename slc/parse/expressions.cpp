// Expressions, by precedence.
#include "slc/parse/parser.h"

namespace slc {
namespace {

// How far an expression's text reaches on its first line.
slvm::SourceRange range_of(const Expr& first, slvm::SourceRange last) {
  return join(first.range, last);
}

struct BinaryOperator {
  TokenKind token;
  int level;
  Operator op;
};
// or and equality relation sum cross product dot: levels 0 to 7, each binding tighter than the one before.
constexpr int kOrLevel = 0, kAndLevel = 1, kLevels = 8;
constexpr BinaryOperator kBinaryOperators[] = {
    {TokenKind::kOr, kOrLevel, Operator::kNot},   {TokenKind::kAnd, kAndLevel, Operator::kNot},
    {TokenKind::kEqual, 2, Operator::kEqual},     {TokenKind::kNotEqual, 2, Operator::kNotEqual},
    {TokenKind::kLess, 3, Operator::kLess},       {TokenKind::kLessEqual, 3, Operator::kLessEqual},
    {TokenKind::kGreater, 3, Operator::kGreater}, {TokenKind::kGreaterEqual, 3, Operator::kGreaterEqual},
    {TokenKind::kPlus, 4, Operator::kAdd},        {TokenKind::kMinus, 4, Operator::kSub},
    {TokenKind::kCaret, 5, Operator::kCross},     {TokenKind::kStar, 6, Operator::kMul},
    {TokenKind::kSlash, 6, Operator::kDiv},       {TokenKind::kDot, 7, Operator::kDot},
};

const BinaryOperator* binary_operator(TokenKind token, int level) {
  for (const BinaryOperator& candidate : kBinaryOperators)
    if (candidate.token == token && candidate.level == level) return &candidate;
  return nullptr;
}

bool assignment_operator(TokenKind token, bool& compound, Operator& op) {
  compound = token != TokenKind::kAssign;
  switch (token) {
  case TokenKind::kAssign: return true;
  case TokenKind::kPlusAssign: op = Operator::kAdd; return true;
  case TokenKind::kMinusAssign: op = Operator::kSub; return true;
  case TokenKind::kStarAssign: op = Operator::kMul; return true;
  case TokenKind::kSlashAssign: op = Operator::kDiv; return true;
  default: return false;
  }
}

} // namespace

ExprPtr Parser::broken_expression(slvm::SourceRange where) const {
  auto e = std::make_unique<NumberExpr>(where);
  e->broken = true;
  return e;
}

ExprPtr Parser::missing_expression() {
  const Token& last = tokens_[at_ ? at_ - 1 : 0];
  bool word = at(TokenKind::kIdentifier);
  if (last.unterminated || current().after_error)
    panic_ = true; // what is missing here went with what was reported
  else if (word)
    fail(Msg::kStatementAsValue, current().text);
  else if (at(TokenKind::kLeftBracket))
    fail(Msg::kSquareBrackets);
  else if (slvm::Diagnostic* d = fail(Msg::kExpectedExpression, describe_current());
           d && last.kind == TokenKind::kSemicolon && last.range.end - last.range.column != 1)
    d->notes.push_back({last.range, "the text of this macro ends with a ';'"});
  return broken_expression(current().range);
}

// Of other languages: punctuation, and words where an operator stands.
const ForeignOperator* Parser::at_foreign_operator() const {
  bool candidate = at(TokenKind::kForeign) || at(TokenKind::kIdentifier);
  return candidate ? foreign_operator(current().text) : nullptr;
}

slvm::Diagnostic& Parser::report_foreign_operator(const ForeignOperator& foreign) {
  return report(diags_, Msg::kForeignOperator, current().range, foreign.text, foreign.advice);
}

// expr   = assign ;
// assign = ternary | lvalue ( "=" | "+=" | "-=" | "*=" | "/=" ) ( assign | arrayinit ) ;
ExprPtr Parser::parse_expression() {
  Nesting nesting(*this);
  ExprPtr left = parse_ternary();
  if (panic_) return left;
  if (const ForeignOperator* foreign = at_foreign_operator(); foreign && at(TokenKind::kForeign)) {
    report_foreign_operator(*foreign); // %= and its like
    advance();
    parse_expression();
    return broken_expression(left->range);
  }
  bool compound = false;
  Operator op = Operator::kAdd;
  if (!assignment_operator(current().kind, compound, op)) return left;
  auto assign = std::make_unique<AssignExpr>(left->range);
  assign->compound = compound;
  assign->op = op;
  assign->op_range = current().range;
  bool place = left->kind == ExprKind::kVariable || left->kind == ExprKind::kIndex;
  if (!place) report_not_assignable(*left);
  advance();
  ExprPtr value = at(TokenKind::kLeftBrace) ? parse_array_init() : parse_expression();
  if (!place) return broken_expression(left->range);
  assign->target = std::move(left);
  assign->value = std::move(value);
  assign->range = range_of(*assign->target, last_range());
  return assign;
}

// `P.z = 1` and its like, and what is no place at all.
void Parser::report_not_assignable(const Expr& e) {
  const auto* dot = as<OperatorExpr>(&e);
  const auto* object = dot && dot->op == Operator::kDot ? as<VariableExpr>(dot->operands[0].get()) : nullptr;
  const auto* member = object ? as<VariableExpr>(dot->operands[1].get()) : nullptr;
  if (object && unit_.misdeclared.contains(object->name)) return;
  std::string advice = member ? member_advice(object->name, member->name, true) : "";
  const auto* number = as<NumberExpr>(&e);
  if (!advice.empty())
    report(diags_, Msg::kMemberAssigned, e.range, advice);
  else if (!number || !number->broken)
    report(diags_, Msg::kNotAssignable, e.range);
}

// ternary = or [ "?" expr ":" ternary ] ;
ExprPtr Parser::parse_ternary() {
  Nesting nesting(*this);
  ExprPtr condition = parse_binary(kOrLevel);
  if (!take(TokenKind::kQuestion)) return condition;
  auto e = std::make_unique<ConditionalExpr>(condition->range);
  e->condition = std::move(condition);
  e->then_value = parse_expression();
  expect(TokenKind::kColon, "':'");
  e->else_value = parse_ternary();
  e->range = range_of(*e->condition, last_range());
  return e;
}

// or       = and { "||" and } ;                    and     = equality { "&&" equality } ;
// equality = relation { ("=="|"!=") relation } ;   relation = sum { ("<"|"<="|">"|">=") sum } ;
// sum      = cross { ("+"|"-") cross } ;           cross   = product { "^" product } ;
// product  = dot { ("*"|"/") dot } ;               dot     = unary { "." unary } ;
ExprPtr Parser::parse_binary(int level) {
  if (level == kLevels) return parse_unary();
  ExprPtr left = parse_binary(level + 1);
  for (int length = 0; !panic_; ++length) {
    const BinaryOperator* found = binary_operator(current().kind, level);
    const ForeignOperator* foreign = found ? nullptr : at_foreign_operator();
    if (!found && (!foreign || foreign->level != level)) break;
    if (length == kMaxChain) fail(Msg::kTooDeep, kMaxChain);
    if (foreign) {
      left = parse_foreign_binary(std::move(left), *foreign);
    } else {
      advance();
      left = parse_binary_operator(std::move(left), level, found->op);
    }
  }
  return left;
}

// The operator's right side, and both put together.
ExprPtr Parser::parse_binary_operator(ExprPtr left, int level, Operator op) {
  ExprPtr right = parse_binary(level + 1);
  slvm::SourceRange range = range_of(*left, last_range());
  if (level == kOrLevel || level == kAndLevel) {
    auto e = std::make_unique<LogicalExpr>(range);
    e->is_and = level == kAndLevel;
    e->left = std::move(left);
    e->right = std::move(right);
    return e;
  }
  auto e = std::make_unique<OperatorExpr>(range);
  e->op = op;
  e->operands.push_back(std::move(left));
  e->operands.push_back(std::move(right));
  return e;
}

// An operator of another language: reported, and what is meant is put in its place.
ExprPtr Parser::parse_foreign_binary(ExprPtr left, const ForeignOperator& foreign) {
  report_foreign_operator(foreign);
  slvm::SourceRange where = current().range;
  advance();
  bool word = foreign.text == "and" || foreign.text == "or";
  if (word || foreign.op != Operator::kNot)
    return parse_binary_operator(std::move(left), foreign.level, foreign.op);
  ExprPtr right = parse_binary(foreign.level + 1);
  slvm::SourceRange range = range_of(*left, last_range());
  if (foreign.function.empty()) return broken_expression(range);
  auto call = std::make_unique<CallExpr>(range);
  call->name = foreign.function;
  call->name_range = where;
  call->args.push_back(std::move(left));
  call->args.push_back(std::move(right));
  return call;
}

// unary = ("-" | "!") unary | cast unary | primary ;
ExprPtr Parser::parse_unary() {
  Nesting nesting(*this);
  if (panic_) return missing_expression();
  if (at(TokenKind::kPlus)) {
    report(diags_, Msg::kUnaryPlus, current().range);
    advance();
    return parse_unary();
  }
  if (at(TokenKind::kMinus) || at(TokenKind::kNot)) {
    auto e = std::make_unique<OperatorExpr>(current().range);
    e->op = at(TokenKind::kMinus) ? Operator::kNegate : Operator::kNot;
    advance();
    e->operands.push_back(parse_unary());
    e->range = join(e->range, last_range());
    return e;
  }
  bool word_not = at_word("not") && peek().kind == TokenKind::kIdentifier;
  if (at(TokenKind::kForeign) || word_not) return parse_foreign_unary();
  if (at(TokenKind::kIdentifier) && type_of_word(current().text) != Type::kVoid) return parse_cast();
  return parse_increments(parse_primary());
}

// `++i`, `&x`, `~n`, `not k`.
ExprPtr Parser::parse_foreign_unary() {
  const ForeignOperator* foreign = foreign_operator(current().text);
  if (current().text == "&")
    report(diags_, Msg::kReference, current().range);
  else if (foreign && foreign->level < 0)
    report_foreign_operator(*foreign);
  else
    return missing_expression();
  bool address = current().text == "&";
  advance();
  ExprPtr operand = parse_unary();
  return address ? std::move(operand) : broken_expression(operand->range);
}

// `i++`, taken for `i += 1`; and `v->x`.
ExprPtr Parser::parse_increments(ExprPtr e) {
  while (!panic_ && at(TokenKind::kForeign) && (current().text == "++" || current().text == "--")) {
    std::string_view by = current().text == "++" ? " += 1" : " -= 1";
    report_foreign_operator(*foreign_operator(current().text))
        .fixits.push_back({current().range, std::string(by)});
    advance();
    auto assign = std::make_unique<AssignExpr>(join(e->range, last_range()));
    if (e->kind != ExprKind::kVariable && e->kind != ExprKind::kIndex) return e;
    assign->compound = true;
    assign->target = std::move(e);
    auto one = std::make_unique<NumberExpr>(last_range());
    one->value = 1;
    assign->value = std::move(one);
    e = std::move(assign);
  }
  while (!panic_ && at(TokenKind::kArrow)) {
    report(diags_, Msg::kArrow, current().range);
    advance();
    if (at(TokenKind::kIdentifier)) parse_name();
    e = broken_expression(e->range);
  }
  return e;
}

// cast = ( "float" | "string" | "color" | "point" | "vector" | "normal" | "matrix" ) [ STRING ] ;
ExprPtr Parser::parse_cast() {
  auto e = std::make_unique<CastExpr>(current().range);
  e->target = type_of_word(current().text);
  advance();
  // `string "a"` casts a constant; for other types the string names a space.
  while (e->target != Type::kString && at(TokenKind::kString)) {
    e->has_space = true;
    e->space += current().text;
    advance();
  }
  e->operand = parse_unary();
  e->range = join(e->range, last_range());
  return e;
}

// primary = NUMBER | STRING { STRING } | lvalue | call | texcall | "(" expr ")" | triple | sixteentuple ;
ExprPtr Parser::parse_primary() {
  switch (current().kind) {
  case TokenKind::kNumber: {
    auto e = std::make_unique<NumberExpr>(current().range);
    e->value = current().number;
    advance();
    return e;
  }
  case TokenKind::kString: return parse_string();
  case TokenKind::kLeftParen: return parse_parenthesised();
  case TokenKind::kIdentifier: return is_statement_word(current().text) ? missing_expression() : parse_name();
  default: return missing_expression();
  }
}

ExprPtr Parser::parse_string() {
  auto e = std::make_unique<StringExpr>(current().range);
  for (; at(TokenKind::kString); advance()) {
    e->value += current().text;
    e->range = join(e->range, current().range);
  }
  return e;
}

// "(" expr ")" | triple = "(" expr "," expr "," expr ")" | sixteentuple = "(" 16 exprs ")" ;
ExprPtr Parser::parse_parenthesised() {
  slvm::SourceRange open = current().range;
  advance();
  bool type = at(TokenKind::kIdentifier) && type_of_word(current().text) != Type::kVoid;
  if (type && peek().kind == TokenKind::kRightParen) { // `(float) x`
    report(diags_, Msg::kCast, open, current().text);
    auto cast = std::make_unique<CastExpr>(open);
    cast->target = type_of_word(current().text);
    advance();
    advance();
    cast->operand = parse_unary();
    return cast;
  }
  std::vector<ExprPtr> elements = parse_expression_list();
  expect_close(TokenKind::kRightParen, "')'", open);
  slvm::SourceRange range = join(open, last_range());
  if (elements.size() == 1) {
    elements[0]->range = range;
    return std::move(elements[0]);
  }
  if (panic_) return broken_expression(range);
  if (elements.size() != 3 && elements.size() != 16) {
    report(diags_, Msg::kBadTuple, range, elements.size());
    return broken_expression(range);
  }
  auto e = std::make_unique<TupleExpr>(range);
  e->elements = std::move(elements);
  return e;
}

// lvalue  = IDENT [ "[" expr "]" ] ;
// call    = IDENT "(" [ args ] ")" ;
// texcall = ( "texture" | "environment" | "shadow" ) "(" expr [ "[" expr "]" ] { "," expr } ")" ;
ExprPtr Parser::parse_name() {
  Token name = current();
  advance();
  if (at(TokenKind::kLeftParen)) {
    auto call = std::make_unique<CallExpr>(name.range);
    call->name = name.text;
    call->name_range = name.range;
    slvm::SourceRange open = current().range;
    advance();
    while (!panic_ && !at(TokenKind::kRightParen)) {
      call->args.push_back(parse_expression());
      if (call->args.size() == 1 && take(TokenKind::kLeftBracket)) {
        call->channel = parse_expression();
        expect(TokenKind::kRightBracket, "']'");
      }
      if (!take(TokenKind::kComma)) break;
      if (at(TokenKind::kRightParen)) report(diags_, Msg::kExpectedExpression, current().range, "')'");
    }
    expect_close(TokenKind::kRightParen, "')' or ','", open);
    call->range = join(call->range, last_range());
    return call;
  }
  if (take(TokenKind::kLeftBracket)) {
    auto e = std::make_unique<IndexExpr>(name.range);
    e->name = name.text;
    slvm::SourceRange open = last_range();
    e->index = parse_expression();
    expect_close(TokenKind::kRightBracket, "']'", open);
    e->range = join(e->range, last_range());
    if (!at(TokenKind::kLeftBracket)) return e;
    reject_second_index();
    return broken_expression(e->range);
  }
  bool argument =
      at(TokenKind::kNumber) || at(TokenKind::kString) ||
      (at(TokenKind::kIdentifier) && !at_foreign_operator() && !is_statement_word(current().text));
  if (argument && current().range.line == name.range.line && !slvm::shadeop_overloads(name.text).empty()) {
    report(diags_, Msg::kCallParens, name.range, name.text); // `sqrt 2`
    parse_unary();
    return broken_expression(name.range);
  }
  auto e = std::make_unique<VariableExpr>(name.range);
  e->name = name.text;
  return e;
}

} // namespace slc
