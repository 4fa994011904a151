// Statements.
#include "slc/parse/parser.h"

namespace slc {

// block = "{" { statement } "}" ;
std::unique_ptr<BlockStmt> Parser::parse_block() {
  auto block = std::make_unique<BlockStmt>(current().range);
  slvm::SourceRange open = current().range;
  if (!expect(TokenKind::kLeftBrace, "'{'")) return block;
  while (!at(TokenKind::kRightBrace)) {
    if (at_end() || at_shader_start()) {
      if (!panic_)
        report(diags_, Msg::kMissingBrace, current().range, describe_current())
            .notes.push_back({open, "the block starts here"});
      panic_ = gave_up_;
      return block;
    }
    size_t before = at_;
    StmtPtr s = parse_statement();
    bool broken = panic_ && as<ExpressionStmt>(s.get());
    if (s && !broken) block->statements.push_back(std::move(s));
    if (panic_) {
      synchronise();
      if (at_ == before && !at(TokenKind::kRightBrace) && !at_shader_start()) advance();
    }
  }
  advance();
  return block;
}

StmtPtr Parser::parse_statement() {
  Nesting nesting(*this);
  bool silent = current().after_nolint;
  slvm::SourceRange first = current().range;
  StmtPtr s = parse_statement_here();
  if (silent) // the whole statement's warnings, on whatever line of it
    for (uint32_t line = first.line; last_range().file == first.file && line <= last_range().line; ++line)
      diags_.silence_line(first.file, line);
  return s;
}

// statement = ";" | block | vardecl ";" | funcdef [ ";" ] | exprlist ";" | the statements that start with a
// word ;
StmtPtr Parser::parse_statement_here() {
  if (at(TokenKind::kSemicolon)) {
    auto empty = std::make_unique<EmptyStmt>(current().range);
    advance();
    return empty;
  }
  if (at(TokenKind::kLeftBrace)) return parse_block();
  if (!at(TokenKind::kIdentifier)) return parse_expression_statement();
  if (StmtPtr s = parse_word_statement()) return s;
  if (panic_) return nullptr;
  if (at_function()) {
    auto s = std::make_unique<FunctionStmt>(current().range);
    s->function = parse_function();
    return s;
  }
  bool type_then_name = type_of_word(current().text) != Type::kVoid &&
                        peek().kind == TokenKind::kIdentifier && peek(2).kind != TokenKind::kLeftParen;
  if (is_specifier_word(current().text) || type_then_name) return parse_declaration();
  if (reject_rsl2_declaration()) return nullptr;
  if (type_of_word(current().text) == Type::kVoid && peek().kind == TokenKind::kIdentifier) {
    constexpr std::string_view kTypes[] = {"float", "color", "point", "vector", "normal", "matrix", "string"};
    std::string_view near = slvm::nearest_name(current().text, kTypes);
    if (peek(2).kind != TokenKind::kDot && !near.empty()) {
      fail(Msg::kUnknownType, current().text, near);
      return nullptr;
    }
  }
  return parse_expression_statement();
}

// The statements that start with a word of their own; null, and not in panic, when this is none.
StmtPtr Parser::parse_word_statement() {
  std::string_view word = current().text;
  if (word == "if") return parse_if();
  if (word == "while") return parse_while();
  if (word == "for") return parse_for();
  if (word == "return") return parse_return();
  if (word == "break" || word == "continue") return parse_jump();
  if (word == "else") {
    fail(Msg::kStrayElse);
    return nullptr;
  }
  if (peek().kind != TokenKind::kLeftParen) return nullptr;
  if (word == "illuminance") return parse_illuminance();
  if (word == "illuminate" || word == "solar") return parse_emission();
  if (word == "gather" || word == "traverse") return parse_gather();
  return nullptr;
}

// vardecl = [ "extern" ] [ detail ] type fdecl { "," fdecl } ;
StmtPtr Parser::parse_declaration() {
  auto s = std::make_unique<DeclarationStmt>(current().range);
  slvm::SourceRange first = current().range;
  Specifiers specifiers = parse_specifiers();
  if (specifiers.output) {
    if (!panic_) report(diags_, Msg::kMisplacedSpecifier, first, "output", "a local variable");
    specifiers.output = false;
  }
  s->is_extern = specifiers.is_extern;
  parse_declarators(specifiers, VariableKind::kLocal, s->variables);
  expect(TokenKind::kSemicolon, "';'");
  return s;
}

// exprlist ";"
StmtPtr Parser::parse_expression_statement() {
  auto s = std::make_unique<ExpressionStmt>(current().range);
  s->expressions = parse_expression_list();
  expect(TokenKind::kSemicolon, "';'");
  return s;
}

// exprlist = expr { "," expr } ;
std::vector<ExprPtr> Parser::parse_expression_list() {
  std::vector<ExprPtr> list;
  do
    list.push_back(parse_expression());
  while (take(TokenKind::kComma));
  return list;
}

// "(" cond ")"
ExprPtr Parser::parse_condition() {
  expect(TokenKind::kLeftParen, "'('");
  ExprPtr condition = parse_expression();
  expect(TokenKind::kRightParen, "')'");
  return condition;
}

// "(" [ args ] ")"
std::vector<ExprPtr> Parser::parse_arguments() {
  std::vector<ExprPtr> args;
  expect(TokenKind::kLeftParen, "'('");
  if (!panic_ && !at(TokenKind::kRightParen)) args = parse_expression_list();
  expect(TokenKind::kRightParen, "')' or ','");
  return args;
}

// "if" "(" cond ")" statement [ "else" statement ]
StmtPtr Parser::parse_if() {
  auto s = std::make_unique<IfStmt>(current().range);
  advance();
  s->condition = parse_condition();
  if (panic_) return s;
  s->then_branch = parse_statement();
  if (take_word("else")) s->else_branch = parse_statement();
  return s;
}

// "while" "(" cond ")" statement
StmtPtr Parser::parse_while() {
  auto s = std::make_unique<LoopStmt>(current().range);
  advance();
  s->condition = parse_condition();
  if (!panic_) s->body = parse_statement();
  return s;
}

// "for" "(" [ exprlist | vardecl ] ";" [ cond ] ";" [ exprlist ] ")" statement
StmtPtr Parser::parse_for() {
  auto s = std::make_unique<LoopStmt>(current().range);
  s->is_for = true;
  advance();
  expect(TokenKind::kLeftParen, "'('");
  if (!take(TokenKind::kSemicolon) && !panic_) {
    bool declares = at(TokenKind::kIdentifier) &&
                    (is_specifier_word(current().text) ||
                     (type_of_word(current().text) != Type::kVoid && peek().kind == TokenKind::kIdentifier));
    s->init = declares ? parse_declaration() : parse_expression_statement();
  }
  if (!panic_ && !at(TokenKind::kSemicolon)) s->condition = parse_expression();
  expect(TokenKind::kSemicolon, "';'");
  if (!panic_ && !at(TokenKind::kRightParen)) s->steps = parse_expression_list();
  expect(TokenKind::kRightParen, "')'");
  if (!panic_) s->body = parse_statement();
  return s;
}

// ( "break" | "continue" ) [ INTEGER ] ";"
StmtPtr Parser::parse_jump() {
  auto s = std::make_unique<JumpStmt>(current().range);
  s->is_break = at_word("break");
  advance();
  if (at(TokenKind::kNumber)) {
    s->range = join(s->range, current().range);
    float levels = current().number;
    if (!current().is_integer || levels < 1 || levels > 1000)
      fail(Msg::kBadLevel, current().text);
    else
      s->levels = static_cast<int>(levels);
    advance();
  }
  expect(TokenKind::kSemicolon, "';'");
  return s;
}

// "return" [ expr ] ";"
StmtPtr Parser::parse_return() {
  auto s = std::make_unique<ReturnStmt>(current().range);
  advance();
  if (at(TokenKind::kAssign)) {
    fail(Msg::kReturnAssign);
    return s;
  }
  if (!at(TokenKind::kSemicolon)) s->value = parse_expression();
  expect(TokenKind::kSemicolon, "';'");
  return s;
}

// "illuminance" "(" args ")" statement
StmtPtr Parser::parse_illuminance() {
  auto s = std::make_unique<IlluminanceStmt>(current().range);
  advance();
  s->args = parse_arguments();
  if (!panic_) s->body = parse_statement();
  return s;
}

// "illuminate" "(" args ")" statement | "solar" "(" [ args ] ")" statement
StmtPtr Parser::parse_emission() {
  auto s = std::make_unique<EmissionStmt>(current().range);
  s->is_solar = at_word("solar");
  advance();
  s->args = parse_arguments();
  if (!panic_) s->body = parse_statement();
  return s;
}

// ( "gather" | "traverse" ) "(" args ")" statement [ "else" statement ]
StmtPtr Parser::parse_gather() {
  auto s = std::make_unique<GatherStmt>(current().range);
  s->is_traverse = at_word("traverse");
  advance();
  s->args = parse_arguments();
  if (panic_) return s;
  s->body = parse_statement();
  if (take_word("else")) s->else_body = parse_statement();
  return s;
}

} // namespace slc
