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

bool is_statement_word(std::string_view word) {
  return word == "if" || word == "else" || word == "while" || word == "for" || word == "return";
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
  return expect_close(kind, what, {});
}

bool Parser::expect_close(TokenKind kind, std::string_view what, slvm::SourceRange open) {
  if (take(kind)) return true;
  if (panic_) return false;
  const Token& last = tokens_[at_ ? at_ - 1 : 0];
  if (last.unterminated || current().after_error) { // what is missing here went with what was reported
    panic_ = true;
    return false;
  }
  bool ends_statement = kind == TokenKind::kSemicolon && !in_for_header_;
  if (ends_statement && (at(TokenKind::kRightParen) || at(TokenKind::kRightBracket))) {
    report(diags_, Msg::kStrayBrace, current().range, current().text);
    advance();
    return expect(kind, what);
  }
  // What is missing at the end of a line is shown there, and a new line goes on with the next statement.
  bool new_line = current().range.line != last.range.line && last.range.valid();
  if (ends_statement && new_line) {
    slvm::SourceRange where = behind_last();
    report(diags_, Msg::kExpected, where, what, describe_current()).fixits.push_back({where, ";"});
    panic_ = !at(TokenKind::kRightBrace) && !at(TokenKind::kIdentifier);
    return false;
  }
  bool value = at(TokenKind::kIdentifier) || at(TokenKind::kNumber) || at(TokenKind::kLeftParen);
  if (ends_statement && value) what = "';' or an operator";
  bool behind = new_line && kind == TokenKind::kRightParen;
  slvm::SourceRange where = behind ? behind_last() : current().range;
  slvm::Diagnostic* d = fail_at(Msg::kExpected, where, what, describe_current());
  if (d && open.valid()) d->notes.push_back({open, "for this one"});
  return false;
}

// The column behind the last token.
slvm::SourceRange Parser::behind_last() const {
  slvm::SourceRange where = last_range();
  where.column = where.end;
  where.end = where.column + 1;
  return where;
}

// `surface name (`, where no statement can be meant; or the same with the parentheses forgotten.
bool Parser::at_shader_start() const {
  ShaderKind kind;
  return at(TokenKind::kIdentifier) && shader_kind_of_word(current().text, kind) &&
         peek().kind == TokenKind::kIdentifier &&
         (peek(2).kind == TokenKind::kLeftParen || peek(2).kind == TokenKind::kLeftBrace);
}

bool Parser::declares(size_t i) const {
  if (i >= tokens_.size() || tokens_[i].kind != TokenKind::kIdentifier) return false;
  std::string_view word = tokens_[i].text;
  return type_of_word(word) != Type::kVoid || is_specifier_word(word) || foreign_type(word);
}

bool Parser::at_declaration() const {
  if (!at(TokenKind::kIdentifier)) return false;
  std::string_view word = current().text;
  bool type = type_of_word(word) != Type::kVoid;
  const Token &next = peek(), &after = peek(2);
  if (is_specifier_word(word)) return true;
  if (type && next.kind == TokenKind::kLeftBracket) return true; // `float[3] x`
  if (next.kind != TokenKind::kIdentifier) return false;
  if (type) return after.kind != TokenKind::kLeftParen;
  if (foreign_specifier(word) && declares(at_ + 1)) return true;
  // Two names in a row: the first should be a type.
  return after.kind == TokenKind::kSemicolon || after.kind == TokenKind::kAssign ||
         after.kind == TokenKind::kComma || after.kind == TokenKind::kLeftBracket;
}

bool Parser::at_statement_word() const {
  constexpr std::string_view kWords[] = {"if",   "while",    "for",   "return", "break",       "continue",
                                         "else", "traverse", "solar", "gather", "illuminance", "illuminate"};
  if (!at(TokenKind::kIdentifier)) return false;
  if (std::find(std::begin(kWords), std::end(kWords), current().text) != std::end(kWords)) return true;
  return declares(at_) && peek().kind == TokenKind::kIdentifier;
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

// The column of the first token on a token's line.
uint32_t Parser::indentation(size_t token) const {
  const slvm::SourceRange at = tokens_[token].range;
  while (token > 0 && tokens_[token - 1].range.file == at.file && tokens_[token - 1].range.line == at.line)
    --token;
  return tokens_[token].range.column;
}

// A '}' on a line of its own that does not stand below the line of its '{' may belong to another one.
void Parser::note_indentation(size_t open, size_t close) {
  const slvm::SourceRange first = tokens_[open].range, last = tokens_[close].range;
  bool own_line = indentation(close) == last.column && first.file == last.file && first.line != last.line;
  if (own_line && indentation(open) != last.column && !suspect_.valid()) suspect_ = first;
}

void Parser::too_deep() {
  fail(Msg::kTooDeep, kMaxNesting);
  gave_up_ = true; // nothing sensible follows: end the file here
  at_ = tokens_.size() - 1;
}

} // namespace slc
