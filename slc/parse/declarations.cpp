// Files, shaders and functions, and what stands between them by mistake. Variables are in declarators.cpp.
#include "slc/parse/parser.h"

namespace slc {

TranslationUnit parse(TokenList tokens, slvm::Diagnostics& diags) {
  return Parser(std::move(tokens), diags).parse_file();
}

// file = { shaderdef | funcdef | ";" } ;
TranslationUnit Parser::parse_file() {
  while (!at_end()) {
    size_t before = at_;
    if (take(TokenKind::kSemicolon)) continue;
    ShaderKind kind;
    bool nameless =
        peek().kind == TokenKind::kLeftParen && shader_kind_of_word(current().text, kind) && at_function();
    if (at_shader_start() || nameless) {
      lost_ = false;
      parse_shader();
    } else if (at_function()) {
      lost_ = false;
      unit_.definitions.push_back({parse_function(), nullptr});
    } else if (!parse_plugin() && !reject_rsl2_declaration()) {
      parse_misplaced();
    }
    if (panic_) {
      if (at_ == before) advance();
      synchronise();
      if (at(TokenKind::kLeftBrace))
        skip_balanced();
      else if (at(TokenKind::kRightBrace))
        advance();
    }
  }
  assign_annotations();
  return std::move(unit_);
}

// What is neither shader nor function. Behind a '}' too many the rest of a shader comes by here: one message.
void Parser::parse_misplaced() {
  bool first = !std::exchange(lost_, true);
  bool name_then_paren = peek().kind == TokenKind::kIdentifier && peek(2).kind == TokenKind::kLeftParen;
  if (at(TokenKind::kRightBrace)) {
    if (first) report(diags_, Msg::kStrayBrace, current().range, current().text);
    advance();
    lost_ = !first;
  } else if (!first) {
    panic_ = true;
  } else if (at_prototype()) {
    size_t name = peek().kind == TokenKind::kLeftParen    ? at_
                  : peek(2).kind == TokenKind::kLeftParen ? at_ + 1
                                                          : at_ + 2;
    fail_at(Msg::kPrototype, tokens_[name].range, tokens_[name].text);
    unit_.misdeclared.insert(tokens_[name].text);
    lost_ = false;
  } else if (at_declaration() && !name_then_paren) {
    parse_global_variable();
    lost_ = false;
  } else if (at(TokenKind::kIdentifier) && name_then_paren) {
    fail(Msg::kUnknownShaderKind, current().text);
    lost_ = false;
  } else {
    bool behind = !unit_.definitions.empty() && tokens_[at_ ? at_ - 1 : 0].kind == TokenKind::kRightBrace;
    fail(behind ? Msg::kLostDefinition : Msg::kExpectedDefinition, describe_current());
  }
}

// Reported at its name; the names are known from here on as faulty.
void Parser::parse_global_variable() {
  size_t name = at_;
  while (peek(name - at_ + 1).kind == TokenKind::kIdentifier)
    ++name;
  report(diags_, Msg::kGlobalVariable, tokens_[name].range, tokens_[name].text);
  for (; !at_end() && !at(TokenKind::kSemicolon) && !at_shader_start() && !at_function(); advance())
    if (at(TokenKind::kIdentifier) && at_ >= name) unit_.misdeclared.insert(current().text);
  take(TokenKind::kSemicolon);
}

// An annotation belongs to the shader it stands in or behind; before the first shader, to that one.
void Parser::assign_annotations() {
  for (const Annotation& a : unit_.annotations) {
    Shader* owner = nullptr;
    for (Shader& s : unit_.shaders)
      if (!owner || (s.where.file == a.where.file && s.where.line <= a.where.line)) owner = &s;
    if (owner) owner->annotations.push_back(a);
  }
}

// shaderdef = stype IDENT "(" [ formals ] ")" block ;
void Parser::parse_shader() {
  Shader& shader = unit_.shaders.emplace_back();
  unit_.definitions.push_back({nullptr, &shader});
  std::string kind = current().text;
  shader_kind_of_word(kind, shader.kind);
  if (peek().kind == TokenKind::kLeftParen)
    report(diags_, Msg::kShaderName, current().range, kind);
  else
    advance();
  shader.name = current().text;
  shader.where = current().range;
  advance();
  suspect_ = {};
  bool broken = false;
  if (at(TokenKind::kLeftBrace))
    report(diags_, Msg::kShaderParens, shader.where, kind, shader.name);
  else
    shader.params = parse_formals(VariableKind::kParameter, broken);
  shader.body = parse_body();
}

// A block; a ';' that stands before it is reported.
std::unique_ptr<BlockStmt> Parser::parse_body() {
  if (at(TokenKind::kSemicolon) && peek().kind == TokenKind::kLeftBrace) {
    report(diags_, Msg::kExpected, current().range, "'{'", describe_current());
    advance();
  }
  return parse_block();
}

// The token behind `[detail] [type] name (...)`, from here; 0: no such thing stands here.
size_t Parser::behind_formals() const {
  size_t i = at_;
  auto word = [&](size_t k) -> std::string_view {
    return k < tokens_.size() && tokens_[k].kind == TokenKind::kIdentifier ? std::string_view(tokens_[k].text)
                                                                           : "";
  };
  if (word(i) == "uniform" || word(i) == "varying") ++i;
  if (word(i) == "void" || type_of_word(word(i)) != Type::kVoid ||
      (foreign_type(word(i)) && !word(i + 1).empty()))
    ++i;
  if (word(i).empty() || type_of_word(word(i)) != Type::kVoid || i + 1 >= tokens_.size()) return 0;
  if (tokens_[++i].kind != TokenKind::kLeftParen) return 0;
  int depth = 0;
  for (; i < tokens_.size(); ++i) {
    TokenKind kind = tokens_[i].kind;
    if (kind == TokenKind::kLeftParen)
      ++depth;
    else if (kind == TokenKind::kRightParen && --depth == 0)
      break;
    else if (kind == TokenKind::kLeftBrace || kind == TokenKind::kEnd)
      break;
  }
  return i + 1 < tokens_.size() && tokens_[i].kind == TokenKind::kRightParen ? i + 1 : 0;
}

// A type or nothing, a name, and parentheses with a block behind them.
bool Parser::at_function() const {
  if (at_statement_word() && peek().kind == TokenKind::kLeftParen) return false;
  if (!foreign_statement(current().text).empty()) return false;
  size_t behind = behind_formals();
  if (behind == 0) return false;
  bool typed = peek().kind != TokenKind::kLeftParen;
  bool semicolon = typed && tokens_[behind].kind == TokenKind::kSemicolon && behind + 1 < tokens_.size() &&
                   tokens_[behind + 1].kind == TokenKind::kLeftBrace;
  return tokens_[behind].kind == TokenKind::kLeftBrace || semicolon;
}

// `float half(float x);`
bool Parser::at_prototype() const {
  size_t behind = behind_formals();
  return behind != 0 && tokens_[behind].kind == TokenKind::kSemicolon && (declares(at_) || at_word("void"));
}

// funcdef = [ [detail] type | "void" ] IDENT "(" [ formals ] ")" block ;
FunctionDef* Parser::parse_function() {
  FunctionDef& function = unit_.functions.emplace_back();
  if (at_word("uniform") || at_word("varying")) {
    function.result_uniform = at_word("uniform");
    advance();
  }
  function.result_given = true;
  if (at_word("void") || type_of_word(current().text) != Type::kVoid) {
    function.result = type_of_word(current().text);
    advance();
  } else if (peek().kind == TokenKind::kIdentifier) {
    function.result = take_foreign_type(function.broken);
  } else {
    function.result_given = false;
    function.result = Type::kFloat;
  }
  function.name = current().text;
  function.where = current().range;
  advance();
  function.formals = parse_formals(VariableKind::kFormal, function.broken);
  function.body = parse_body();
  return &function;
}

// `plugin "name";`, of RSL 2.0: its functions can be called from here on. True: there was one.
bool Parser::parse_plugin() {
  if (!at(TokenKind::kIdentifier) || current().text != "plugin" || peek().kind != TokenKind::kString ||
      panic_)
    return false;
  advance();
  unit_.plugins.push_back({current().text, current().range});
  advance();
  expect(TokenKind::kSemicolon, "';' behind the name of the plug-in");
  return true;
}

// Constructs of RSL 2.0, by name. True: reported and skipped, or in panic.
bool Parser::reject_rsl2_declaration() {
  if (!at(TokenKind::kIdentifier) || panic_) return panic_;
  std::string_view word = current().text;
  const Token& next = peek();
  bool before_name = next.kind == TokenKind::kIdentifier;
  bool block = (word == "class" || word == "struct") && before_name;
  // `shader name(`, of OSL, is an unknown kind of shader.
  if (word == "shader" && peek(2).kind == TokenKind::kLeftParen) return false;
  bool other = (word == "plugin" && next.kind == TokenKind::kString) ||
               ((word == "shader" || word == "public" || word == "private" || word == "constant" ||
                 word == "method") &&
                before_name);
  if (!block && !other) return false;
  report(diags_, Msg::kRsl2, current().range, word);
  if (!block) {
    panic_ = true;
    return true;
  }
  if (word == "struct") unit_.misdeclared.insert(next.text);
  while (!at_end() && !at(TokenKind::kLeftBrace) && !at(TokenKind::kSemicolon))
    advance();
  if (at(TokenKind::kLeftBrace)) skip_balanced();
  take(TokenKind::kSemicolon);
  return true;
}

} // namespace slc
