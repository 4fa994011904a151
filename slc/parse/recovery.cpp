// What the parser does after an error: skip to a place where a statement surely ends or begins, so that the
// next error is a real one.
#include "slc/parse/parser.h"

#include <algorithm>
#include <iterator>

namespace slc {

Type type_of_word(std::string_view word) {
  for (Type t :
       {Type::kFloat, Type::kColor, Type::kPoint, Type::kVector, Type::kNormal, Type::kMatrix, Type::kString})
    if (slvm::type_name(t) == word) return t;
  return Type::kVoid;
}

bool is_specifier_word(std::string_view word) {
  return word == "output" || word == "uniform" || word == "varying" || word == "extern";
}

bool shader_kind_of_word(std::string_view word, ShaderKind& kind) {
  for (int k = 0; k < slvm::kShaderKindCount; ++k)
    if (slvm::shader_kind_name(static_cast<ShaderKind>(k)) == word) {
      kind = static_cast<ShaderKind>(k);
      return true;
    }
  return false;
}

std::string Parser::describe_current() const {
  if (at_end()) return "the end of the file";
  if (at(TokenKind::kString)) return "a string";
  return fmt::format("'{}'", current().text);
}

bool Parser::expect(TokenKind kind, std::string_view what) {
  if (take(kind)) return true;
  if (panic_) return false;
  // A missing ';' or ')' is best shown behind what stands before it.
  bool behind =
      kind == TokenKind::kSemicolon && current().range.line != last_range().line && last_range().valid();
  slvm::SourceRange where = current().range;
  if (behind) {
    where = last_range();
    where.column = where.end;
    where.end = where.column + 1;
  }
  fail_at(Msg::kExpected, where, what, describe_current());
  return false;
}

// `surface name (`, where no statement can be meant.
bool Parser::at_shader_start() const {
  ShaderKind kind;
  return at(TokenKind::kIdentifier) && shader_kind_of_word(current().text, kind) &&
         peek().kind == TokenKind::kIdentifier && peek(2).kind == TokenKind::kLeftParen;
}

bool Parser::at_statement_word() const {
  constexpr std::string_view kWords[] = {"if",   "while",    "for",   "return", "break",       "continue",
                                         "else", "traverse", "solar", "gather", "illuminance", "illuminate"};
  if (!at(TokenKind::kIdentifier)) return false;
  if (std::find(std::begin(kWords), std::end(kWords), current().text) != std::end(kWords)) return true;
  bool declares = type_of_word(current().text) != Type::kVoid || is_specifier_word(current().text);
  return declares && peek().kind == TokenKind::kIdentifier;
}

void Parser::synchronise() {
  panic_ = gave_up_;
  int parens = 0;
  for (; !at_end(); advance()) {
    if (at_shader_start()) return;
    switch (current().kind) {
    case TokenKind::kLeftParen: ++parens; break;
    case TokenKind::kRightParen: parens = std::max(0, parens - 1); break;
    case TokenKind::kSemicolon:
      if (parens > 0) break; // inside formals, or of a `for`
      advance();
      return;
    case TokenKind::kLeftBrace:
    case TokenKind::kRightBrace: return;
    case TokenKind::kIdentifier:
      if (parens == 0 && at_statement_word() && current().range.line != last_range().line) return;
      break;
    default: break;
    }
  }
}

void Parser::skip_balanced() {
  int depth = 0;
  do {
    if (at(TokenKind::kLeftBrace) || at(TokenKind::kLeftParen)) ++depth;
    if (at(TokenKind::kRightBrace) || at(TokenKind::kRightParen)) --depth;
    advance();
  } while (depth > 0 && !at_end());
}

// From the '(' at `open` to behind its ')', or to the block if there is none.
void Parser::skip_formals(size_t open) {
  if (gave_up_) return;
  panic_ = false;
  int depth = 0;
  for (at_ = open; !at_end() && !at(TokenKind::kLeftBrace); advance()) {
    if (at(TokenKind::kLeftParen)) ++depth;
    if (at(TokenKind::kRightParen) && --depth == 0) return advance();
  }
}

void Parser::too_deep() {
  fail(Msg::kTooDeep, kMaxNesting);
  gave_up_ = true; // nothing sensible follows: end the file here
  at_ = tokens_.size() - 1;
}

} // namespace slc
