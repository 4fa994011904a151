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

ExprPtr Parser::missing_expression() {
  fail(Msg::kExpectedExpression, describe_current());
  return std::make_unique<NumberExpr>(current().range);
}

ExprPtr Parser::reject_foreign_operator() {
  std::string_view text = current().text;
  std::string_view advice = text == "%"    ? "write mod(a, b)"
                            : text == "++" ? "write x += 1"
                            : text == "--" ? "write x -= 1"
                            : text == "&"  ? "logical 'and' is &&"
                            : text == "|"  ? "logical 'or' is ||"
                                           : "there are no bit operations";
  fail(Msg::kForeignOperator, text, advice);
  return std::make_unique<NumberExpr>(current().range);
}

// expr   = assign ;
// assign = ternary | lvalue ( "=" | "+=" | "-=" | "*=" | "/=" ) ( assign | arrayinit ) ;
ExprPtr Parser::parse_expression() {
  Nesting nesting(*this);
  ExprPtr left = parse_ternary();
  if (panic_) return left;
  if (at(TokenKind::kForeign)) return reject_foreign_operator();
  if (at(TokenKind::kArrow)) fail(Msg::kRsl2, "->");
  bool compound = false;
  Operator op = Operator::kAdd;
  if (!assignment_operator(current().kind, compound, op)) return left;
  if (left->kind != ExprKind::kVariable && left->kind != ExprKind::kIndex) {
    fail_at(Msg::kNotAssignable, left->range);
    return left;
  }
  auto assign = std::make_unique<AssignExpr>(left->range);
  assign->compound = compound;
  assign->op = op;
  assign->target = std::move(left);
  advance();
  assign->value = at(TokenKind::kLeftBrace) ? parse_array_init() : parse_expression();
  assign->range = range_of(*assign->target, last_range());
  return assign;
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
    if (!found) break;
    if (length == kMaxChain) fail(Msg::kTooDeep, kMaxChain);
    advance();
    ExprPtr right = parse_binary(level + 1);
    slvm::SourceRange range = range_of(*left, last_range());
    if (level == kOrLevel || level == kAndLevel) {
      auto e = std::make_unique<LogicalExpr>(range);
      e->is_and = level == kAndLevel;
      e->left = std::move(left);
      e->right = std::move(right);
      left = std::move(e);
    } else {
      auto e = std::make_unique<OperatorExpr>(range);
      e->op = found->op;
      e->operands.push_back(std::move(left));
      e->operands.push_back(std::move(right));
      left = std::move(e);
    }
  }
  return left;
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
  if (at(TokenKind::kIdentifier) && type_of_word(current().text) != Type::kVoid) return parse_cast();
  return parse_primary();
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
  case TokenKind::kIdentifier: return parse_name();
  case TokenKind::kForeign: return reject_foreign_operator();
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
  std::vector<ExprPtr> elements = parse_expression_list();
  expect(TokenKind::kRightParen, "')'");
  slvm::SourceRange range = join(open, last_range());
  if (elements.size() == 1) {
    elements[0]->range = range;
    return std::move(elements[0]);
  }
  if (elements.size() != 3 && elements.size() != 16) fail_at(Msg::kBadTuple, range, elements.size());
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
    advance();
    while (!panic_ && !at(TokenKind::kRightParen)) {
      call->args.push_back(parse_expression());
      if (call->args.size() == 1 && take(TokenKind::kLeftBracket)) {
        call->channel = parse_expression();
        expect(TokenKind::kRightBracket, "']'");
      }
      if (!take(TokenKind::kComma)) break;
    }
    expect(TokenKind::kRightParen, "')' or ','");
    call->range = join(call->range, last_range());
    return call;
  }
  if (take(TokenKind::kLeftBracket)) {
    auto e = std::make_unique<IndexExpr>(name.range);
    e->name = name.text;
    e->index = parse_expression();
    expect(TokenKind::kRightBracket, "']'");
    e->range = join(e->range, last_range());
    return e;
  }
  auto e = std::make_unique<VariableExpr>(name.range);
  e->name = name.text;
  return e;
}

} // namespace slc
