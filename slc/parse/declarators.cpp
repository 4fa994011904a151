// Formals and variable declarations: specifiers, types, names, lengths and initial values.
#include "slc/parse/parser.h"

namespace slc {

// "(" [ formals ] ")", formals = fgroup { ( ";" | "," ) fgroup } [ ";" ] ;
std::vector<Variable*> Parser::parse_formals(VariableKind kind, bool& broken) {
  std::vector<Variable*> formals;
  slvm::SourceRange open = current().range;
  expect(TokenKind::kLeftParen, "'('");
  if (at_word("void") && peek().kind == TokenKind::kRightParen) {
    report(diags_, Msg::kVoidFormals, current().range);
    advance();
  }
  while (take(TokenKind::kSemicolon)) {
  }
  while (!panic_ && !at(TokenKind::kRightParen) && !at_end()) {
    size_t begin = at_;
    parse_formal_group(kind, formals, broken);
    bool skipped = panic_;
    if (skipped) {
      broken = true;
      skip_formal_group(begin);
    }
    bool separated = false;
    while (take(TokenKind::kSemicolon) || take(TokenKind::kComma))
      separated = true;
    if (separated || at(TokenKind::kRightParen)) continue;
    if (skipped)
      panic_ = true; // reported
    else if (declares(at_) || (at(TokenKind::kIdentifier) && foreign_specifier(current().text)))
      report(diags_, Msg::kExpected,
             current().range.line == last_range().line ? current().range : behind_last(), "',' or ';'",
             describe_current());
    else
      break;
  }
  expect_close(TokenKind::kRightParen, "')' or ';'", open);
  if (panic_ && !gave_up_) {
    panic_ = false;
    while (!at_end() && !at(TokenKind::kLeftBrace) && !at(TokenKind::kRightParen) && !at_shader_start())
      advance();
    take(TokenKind::kRightParen);
  }
  return formals;
}

// fgroup = { "output" | detail } type fdecl { "," fdecl } ;
void Parser::parse_formal_group(VariableKind kind, std::vector<Variable*>& out, bool& broken) {
  Specifiers specifiers = parse_specifiers();
  if (specifiers.is_extern) fail(Msg::kMisplacedSpecifier, "extern", "a formal");
  parse_declarators(specifiers, kind, out);
  broken |= specifiers.broken;
}

// From a group with an error to its end; its names are noted.
void Parser::skip_formal_group(size_t begin) {
  if (gave_up_) return;
  panic_ = false;
  int depth = 0;
  for (at_ = begin; !at_end() && !at_shader_start(); advance()) {
    switch (current().kind) {
    case TokenKind::kLeftParen:
    case TokenKind::kLeftBracket: ++depth; break;
    case TokenKind::kRightParen:
      if (depth == 0) return;
      [[fallthrough]];
    case TokenKind::kRightBracket: --depth; break;
    case TokenKind::kSemicolon:
      if (depth <= 0) return;
      break;
    case TokenKind::kComma:
      if (depth <= 0 && declares(at_ + 1) && peek(2).kind == TokenKind::kIdentifier) return;
      break;
    case TokenKind::kLeftBrace:
      if (at_ == begin || tokens_[at_ - 1].kind != TokenKind::kAssign) return;
      while (!at_end() && !at(TokenKind::kRightBrace))
        advance();
      break;
    case TokenKind::kIdentifier:
      if (depth == 0 && peek().kind != TokenKind::kIdentifier) unit_.misdeclared.insert(current().text);
      break;
    default: break;
    }
  }
}

// { "output" | "extern" | "uniform" | "varying" } type
Parser::Specifiers Parser::parse_specifiers() {
  Specifiers s;
  for (; at(TokenKind::kIdentifier); advance()) {
    std::string_view word = current().text;
    if (const ForeignSpecifier* foreign = foreign_specifier(word); foreign && declares(at_ + 1)) {
      slvm::Diagnostic& d = report(diags_, Msg::kForeignWord, current().range, word, foreign->advice);
      if (foreign->output) d.fixits.push_back({current().range, "output"});
      s.output |= foreign->output;
      continue;
    }
    if (!is_specifier_word(word)) break;
    if (word == "output") {
      s.output = true;
    } else if (word == "extern") {
      s.is_extern = true;
    } else {
      s.detail_given = true;
      s.detail = word == "uniform" ? Detail::kUniform : Detail::kVarying;
    }
  }
  s.type = take_type(s);
  if (at(TokenKind::kLeftBracket) && !panic_) take_misplaced_length(s);
  return s;
}

Type Parser::take_type(Specifiers& s) {
  Type type = at(TokenKind::kIdentifier) ? type_of_word(current().text) : Type::kVoid;
  if (type != Type::kVoid) {
    advance();
    return type;
  }
  if (reject_rsl2_declaration()) return Type::kVoid;
  if (!at(TokenKind::kIdentifier)) {
    fail(Msg::kExpectedType, describe_current());
    return Type::kVoid;
  }
  if (peek().kind == TokenKind::kIdentifier) return take_foreign_type(s.broken);
  report(diags_, Msg::kMissingType, current().range, current().text);
  s.broken = true;
  return Type::kFloat;
}

// A word in the place of a type, a name behind it: reported, and the nearest type taken.
Type Parser::take_foreign_type(bool& broken) {
  constexpr std::string_view kTypes[] = {"float", "color", "point", "vector", "normal", "matrix", "string"};
  const Token word = current();
  advance();
  if (const ForeignType* foreign = foreign_type(word.text)) {
    report(diags_, Msg::kForeignType, word.range, word.text, foreign->advice);
    broken |= foreign->type == Type::kVoid;
    return foreign->type == Type::kVoid ? Type::kFloat : foreign->type;
  }
  std::string_view near = slvm::nearest_name(word.text, kTypes);
  if (!near.empty()) {
    report(diags_, Msg::kUnknownTypeNear, word.range, word.text, near)
        .fixits.push_back({word.range, std::string(near)});
    broken = true; // it may be another
    return type_of_word(near);
  }
  if (!unit_.misdeclared.contains(word.text)) report(diags_, Msg::kUnknownType, word.range, word.text);
  broken = true;
  return Type::kFloat;
}

// `float[3] x`: taken for `float x[3]`.
void Parser::take_misplaced_length(Specifiers& s) {
  report(diags_, Msg::kArrayBeforeName, join(last_range(), current().range), slvm::type_name(s.type));
  s.array = true;
  while (!at_end() && !at(TokenKind::kRightBracket) && !at(TokenKind::kSemicolon))
    advance();
  take(TokenKind::kRightBracket);
}

// `[[ ... ]]` behind a parameter.
void Parser::skip_metadata() {
  report(diags_, Msg::kMetadata, join(current().range, peek().range));
  while (!at_end() && !at(TokenKind::kLeftBrace) &&
         !(at(TokenKind::kRightBracket) && peek().kind == TokenKind::kRightBracket))
    advance();
  take(TokenKind::kRightBracket);
  take(TokenKind::kRightBracket);
}

// fdecl { "," fdecl }, up to a comma behind which a new group starts
void Parser::parse_declarators(const Specifiers& s, VariableKind kind, std::vector<Variable*>& out) {
  for (;;) {
    if (panic_) return;
    if (Variable* variable = parse_declarator(s, kind)) out.push_back(variable);
    if (panic_ || !at(TokenKind::kComma)) return;
    const Token& next = peek();
    bool new_group = kind != VariableKind::kLocal && next.kind == TokenKind::kIdentifier &&
                     (declares(at_ + 1) || foreign_specifier(next.text));
    TokenKind after = peek(2).kind;
    bool name = after == TokenKind::kIdentifier || after == TokenKind::kLeftBracket ||
                after == TokenKind::kStar || after == TokenKind::kForeign;
    if (new_group && name) return;
    advance();
  }
}

// fdecl = IDENT [ "[" [ constexpr ] "]" ] [ "=" ( expr | arrayinit ) ] ;
Variable* Parser::parse_declarator(const Specifiers& s, VariableKind kind) {
  bool pointer = at(TokenKind::kStar) || (at(TokenKind::kForeign) && current().text == "&");
  if (pointer && peek().kind == TokenKind::kIdentifier) {
    report(diags_, Msg::kReference, current().range);
    advance();
  }
  if (at(TokenKind::kNumber) && tokens_[at_ - 1].kind == TokenKind::kComma) {
    fail(Msg::kTripleParens, current().text);
    return nullptr;
  }
  if (!at(TokenKind::kIdentifier)) {
    fail(Msg::kExpectedName, describe_current());
    return nullptr;
  }
  std::string_view word = current().text;
  bool jump = word == "break" || word == "continue";
  if (type_of_word(word) != Type::kVoid || is_specifier_word(word) || is_statement_word(word) || jump) {
    fail(Msg::kReservedName, current().text);
    return nullptr;
  }
  Variable& v = unit_.variables.emplace_back();
  v.kind = kind;
  v.name = current().text;
  v.where = current().range;
  v.type = s.type;
  v.detail_given = s.detail_given;
  v.detail = s.detail_given ? s.detail : Detail::kUniform;
  v.output = s.output || pointer;
  advance();
  parse_length(v);
  if (take(TokenKind::kAssign)) v.init = at(TokenKind::kLeftBrace) ? parse_array_init() : parse_expression();
  if (at(TokenKind::kLeftBracket) && peek().kind == TokenKind::kLeftBracket) skip_metadata();
  if (!s.broken && !s.array) return &v;
  unit_.misdeclared.insert(v.name);
  return nullptr;
}

// [ "[" [ constexpr ] "]" ]
void Parser::parse_length(Variable& v) {
  bool metadata = peek().kind == TokenKind::kLeftBracket;
  if (metadata || !take(TokenKind::kLeftBracket)) return;
  slvm::SourceRange open = last_range();
  v.array_length = kOpenArray;
  if (!at(TokenKind::kRightBracket)) v.length_expr = parse_ternary();
  expect_close(TokenKind::kRightBracket, "']'", open);
  reject_second_index();
}

// `[i][j]`: the second one is reported and skipped.
void Parser::reject_second_index() {
  if (panic_ || !at(TokenKind::kLeftBracket) || peek().kind == TokenKind::kLeftBracket) return;
  report(diags_, Msg::kArrayOfArrays, current().range);
  while (take(TokenKind::kLeftBracket)) {
    parse_expression();
    expect(TokenKind::kRightBracket, "']'");
  }
}

// arrayinit = "{" expr { "," expr } [ "," ] "}" ;
ExprPtr Parser::parse_array_init() {
  auto init = std::make_unique<ArrayInitExpr>(current().range);
  expect(TokenKind::kLeftBrace, "'{'");
  while (!panic_ && !at(TokenKind::kRightBrace)) {
    init->elements.push_back(parse_expression());
    if (!take(TokenKind::kComma)) break;
  }
  expect_close(TokenKind::kRightBrace, "'}'", init->range);
  init->range = join(init->range, last_range());
  return init;
}

} // namespace slc
