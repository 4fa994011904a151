// Statements.
#include "slc/parse/parser.h"

namespace slc {

// block = "{" { statement } "}" ;
std::unique_ptr<BlockStmt> Parser::parse_block() {
  auto block = std::make_unique<BlockStmt>(current().range);
  slvm::SourceRange open = current().range;
  size_t open_at = at_;
  if (!expect(TokenKind::kLeftBrace, "'{'")) return block;
  while (!at(TokenKind::kRightBrace)) {
    if (at_end() || at_shader_start()) {
      if (!panic_) {
        slvm::Diagnostic& d = report(diags_, Msg::kMissingBrace, current().range, describe_current());
        d.notes.push_back({open, "the block starts here"});
        if (suspect_.valid())
          d.notes.push_back({suspect_, "or is it this one? The '}' that closes it has another indentation"});
      }
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
  note_indentation(open_at, at_);
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
  if (at(TokenKind::kRightParen) || at(TokenKind::kRightBracket)) {
    report(diags_, Msg::kStrayBrace, current().range, current().text);
    advance();
    return parse_statement();
  }
  if (!at(TokenKind::kIdentifier)) return parse_expression_statement();
  if (StmtPtr s = parse_word_statement()) return s;
  if (panic_) return nullptr;
  if (at_function()) {
    auto s = std::make_unique<FunctionStmt>(current().range);
    s->function = parse_function();
    return s;
  }
  if (at_declaration()) return parse_declaration();
  if (reject_rsl2_declaration()) return nullptr;
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
    report(diags_, Msg::kStrayElse, current().range);
    advance();
    return parse_statement();
  }
  if (std::string_view advice = foreign_statement(word); !advice.empty()) {
    bool certain = word == "do"     ? peek().kind == TokenKind::kLeftBrace
                   : word == "goto" ? peek().kind == TokenKind::kIdentifier
                                    : peek().kind == TokenKind::kLeftParen;
    if (certain) return parse_foreign_statement(advice);
  }
  bool light_loop = word == "illuminance" || word == "illuminate" || word == "solar";
  bool forgotten = light_loop && peek().kind == TokenKind::kIdentifier; // parentheses
  if (peek().kind != TokenKind::kLeftParen && !forgotten) return nullptr;
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

// `switch (x) { ... }`, `do { ... } while (x);`: reported and skipped.
StmtPtr Parser::parse_foreign_statement(std::string_view advice) {
  auto s = std::make_unique<EmptyStmt>(current().range);
  report(diags_, Msg::kForeignWord, current().range, current().text, advice);
  bool loop = at_word("do"), jump = at_word("goto");
  advance();
  if (at(TokenKind::kLeftParen)) skip_balanced();
  if (jump)
    advance(); // the label
  else if (at(TokenKind::kLeftBrace))
    skip_balanced();
  else
    return parse_statement();
  if (loop && take_word("while") && at(TokenKind::kLeftParen)) skip_balanced();
  if ((loop || jump) && at(TokenKind::kSemicolon)) advance();
  return s;
}

// "(" cond ")"
ExprPtr Parser::parse_condition() {
  slvm::SourceRange open = current().range;
  expect(TokenKind::kLeftParen, "'('");
  ExprPtr condition = parse_expression();
  expect_close(TokenKind::kRightParen, "')'", open);
  return condition;
}

// "(" [ args ] ")"
std::vector<ExprPtr> Parser::parse_arguments() {
  std::vector<ExprPtr> args;
  slvm::SourceRange open = current().range;
  expect(TokenKind::kLeftParen, "'('");
  if (!panic_ && !at(TokenKind::kRightParen)) args = parse_expression_list();
  expect_close(TokenKind::kRightParen, "')' or ','", open);
  return args;
}

// After an error in the parentheses of a statement: on to the statement they govern, so that what stands in
// it is checked, and an `else` behind it finds its `if`. `header`: the statement's first word. False: there
// is no body.
bool Parser::resume_at_body(size_t header, bool is_for) {
  if (!panic_) return true;
  if (gave_up_) return false;
  if (at(TokenKind::kIdentifier) && current().range.line != last_range().line) { // the ')' is missing
    panic_ = false;
    return true;
  }
  int depth = 0, semicolons = 0;
  for (size_t i = header + 1; i + 1 < tokens_.size(); ++i) {
    TokenKind kind = tokens_[i].kind;
    bool closes = kind == TokenKind::kRightParen && --depth == 0;
    depth += kind == TokenKind::kLeftParen ? 1 : 0;
    bool ends = kind == TokenKind::kSemicolon && ++semicolons > (is_for ? 2 : 0);
    if (ends || kind == TokenKind::kRightBrace) return false;
    if (i < at_ || (!closes && kind != TokenKind::kLeftBrace)) continue;
    at_ = i + (closes ? 1 : 0);
    panic_ = false;
    return true;
  }
  return false;
}

// `if (k > 1);`
void Parser::check_empty_body(std::string_view word) {
  bool here = at(TokenKind::kSemicolon) && current().range.line == last_range().line;
  if (here && (word == "if" || peek().kind == TokenKind::kLeftBrace))
    report(diags_, Msg::kEmptyBody, current().range, word);
}

// "if" "(" cond ")" statement [ "else" statement ]
StmtPtr Parser::parse_if() {
  auto s = std::make_unique<IfStmt>(current().range);
  size_t header = at_;
  advance();
  s->condition = parse_condition();
  if (!resume_at_body(header)) return s;
  if (at_word("then") && peek().kind == TokenKind::kIdentifier) {
    report(diags_, Msg::kForeignWord, current().range, "then", "leave it out");
    advance();
  }
  check_empty_body("if");
  s->then_branch = parse_statement();
  bool together = at_word("elseif") || at_word("elif") || at_word("elsif");
  if (!panic_ && together && peek().kind == TokenKind::kLeftParen) {
    report(diags_, Msg::kForeignWord, current().range, current().text, "write 'else if'")
        .fixits.push_back({current().range, "else if"});
    s->else_branch = parse_if();
  } else if (take_word("else")) {
    s->else_branch = parse_statement();
  }
  return s;
}

// "while" "(" cond ")" statement
StmtPtr Parser::parse_while() {
  auto s = std::make_unique<LoopStmt>(current().range);
  size_t header = at_;
  advance();
  s->condition = parse_condition();
  if (!resume_at_body(header)) return s;
  check_empty_body("while");
  s->body = parse_statement();
  return s;
}

// "for" "(" [ exprlist | vardecl ] ";" [ cond ] ";" [ exprlist ] ")" statement
StmtPtr Parser::parse_for() {
  auto s = std::make_unique<LoopStmt>(current().range);
  s->is_for = true;
  size_t header = at_;
  advance();
  slvm::SourceRange open = current().range;
  in_for_header_ = true;
  expect(TokenKind::kLeftParen, "'('");
  if (!take(TokenKind::kSemicolon) && !panic_)
    s->init = at_declaration() ? parse_declaration() : parse_expression_statement();
  if (!panic_ && !at(TokenKind::kSemicolon)) s->condition = parse_expression();
  expect(TokenKind::kSemicolon, "';'");
  in_for_header_ = false;
  if (!panic_ && !at(TokenKind::kRightParen)) s->steps = parse_expression_list();
  expect_close(TokenKind::kRightParen, "')'", open);
  if (!resume_at_body(header, true)) return s;
  check_empty_body("for");
  s->body = parse_statement();
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
  size_t header = at_;
  advance();
  s->args = parse_arguments();
  s->broken = panic_;
  if (resume_at_body(header)) s->body = parse_statement();
  return s;
}

// "illuminate" "(" args ")" statement | "solar" "(" [ args ] ")" statement
StmtPtr Parser::parse_emission() {
  auto s = std::make_unique<EmissionStmt>(current().range);
  s->is_solar = at_word("solar");
  size_t header = at_;
  advance();
  s->args = parse_arguments();
  s->broken = panic_;
  if (resume_at_body(header)) s->body = parse_statement();
  return s;
}

// ( "gather" | "traverse" ) "(" args ")" statement [ "else" statement ]
StmtPtr Parser::parse_gather() {
  auto s = std::make_unique<GatherStmt>(current().range);
  s->is_traverse = at_word("traverse");
  size_t header = at_;
  advance();
  s->args = parse_arguments();
  s->broken = panic_;
  if (!resume_at_body(header)) return s;
  s->body = parse_statement();
  if (take_word("else")) s->else_body = parse_statement();
  return s;
}

} // namespace slc
