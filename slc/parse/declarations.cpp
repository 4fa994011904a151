// Shaders, functions, formals and variable declarations.
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
    if (at_shader_start())
      parse_shader();
    else if (at_function())
      unit_.definitions.push_back({parse_function(), nullptr});
    else if (!reject_rsl2_declaration()) {
      if (at(TokenKind::kRightBrace)) {
        report(diags_, Msg::kStrayBrace, current().range);
        advance();
      } else if (at(TokenKind::kIdentifier) && peek().kind == TokenKind::kIdentifier &&
                 peek(2).kind == TokenKind::kLeftParen) {
        fail(Msg::kUnknownShaderKind, current().text);
      } else {
        fail(Msg::kExpectedDefinition, describe_current());
      }
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
  shader_kind_of_word(current().text, shader.kind);
  advance();
  shader.name = current().text;
  shader.where = current().range;
  advance();
  shader.params = parse_formals(VariableKind::kParameter);
  shader.body = parse_block();
}

// A type or nothing, a name, and parentheses with a block behind them.
bool Parser::at_function() const {
  size_t i = at_;
  auto word = [&](size_t k) -> std::string_view {
    return k < tokens_.size() && tokens_[k].kind == TokenKind::kIdentifier ? std::string_view(tokens_[k].text)
                                                                           : "";
  };
  if (word(i) == "uniform" || word(i) == "varying") ++i;
  if (word(i) == "void" || type_of_word(word(i)) != Type::kVoid) ++i;
  if (word(i).empty() || type_of_word(word(i)) != Type::kVoid || i + 1 >= tokens_.size()) return false;
  if (tokens_[++i].kind != TokenKind::kLeftParen) return false;
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
  return i + 1 < tokens_.size() && tokens_[i].kind == TokenKind::kRightParen &&
         tokens_[i + 1].kind == TokenKind::kLeftBrace;
}

// funcdef = [ [detail] type | "void" ] IDENT "(" [ formals ] ")" block ;
FunctionDef* Parser::parse_function() {
  FunctionDef& function = unit_.functions.emplace_back();
  if (at_word("uniform") || at_word("varying")) {
    function.result_uniform = at_word("uniform");
    advance();
  }
  function.result = type_of_word(current().text);
  function.result_given = function.result != Type::kVoid || at_word("void");
  if (function.result_given)
    advance();
  else
    function.result = Type::kFloat;
  function.name = current().text;
  function.where = current().range;
  advance();
  function.formals = parse_formals(VariableKind::kFormal);
  function.body = parse_block();
  return &function;
}

// "(" [ formals ] ")", formals = fgroup { ( ";" | "," ) fgroup } [ ";" ] ;
std::vector<Variable*> Parser::parse_formals(VariableKind kind) {
  std::vector<Variable*> formals;
  size_t open = at_;
  expect(TokenKind::kLeftParen, "'('");
  while (take(TokenKind::kSemicolon)) {
  }
  while (!panic_ && !at(TokenKind::kRightParen) && !at_end()) {
    parse_formal_group(kind, formals);
    bool separated = false;
    while (take(TokenKind::kSemicolon) || take(TokenKind::kComma))
      separated = true;
    if (!separated) break;
  }
  expect(TokenKind::kRightParen, "')' or ';'");
  if (panic_) skip_formals(open);
  return formals;
}

// fgroup = { "output" | detail } type fdecl { "," fdecl } ;
void Parser::parse_formal_group(VariableKind kind, std::vector<Variable*>& out) {
  Specifiers specifiers = parse_specifiers();
  if (specifiers.is_extern) fail(Msg::kMisplacedSpecifier, "extern", "a formal");
  parse_declarators(specifiers, kind, out);
}

// { "output" | "extern" | "uniform" | "varying" } type
Parser::Specifiers Parser::parse_specifiers() {
  Specifiers s;
  for (; at(TokenKind::kIdentifier) && is_specifier_word(current().text); advance()) {
    std::string_view word = current().text;
    if (word == "output") {
      s.output = true;
    } else if (word == "extern") {
      s.is_extern = true;
    } else {
      s.detail_given = true;
      s.detail = word == "uniform" ? Detail::kUniform : Detail::kVarying;
    }
  }
  s.type = at(TokenKind::kIdentifier) ? type_of_word(current().text) : Type::kVoid;
  if (s.type != Type::kVoid)
    advance();
  else if (!reject_rsl2_declaration())
    fail(Msg::kExpectedType, describe_current());
  return s;
}

// fdecl { "," fdecl }, up to a comma behind which a new group starts
void Parser::parse_declarators(const Specifiers& s, VariableKind kind, std::vector<Variable*>& out) {
  for (;;) {
    if (panic_) return;
    if (Variable* variable = parse_declarator(s, kind)) out.push_back(variable);
    if (panic_ || !at(TokenKind::kComma)) return;
    const Token& next = peek();
    bool new_group = kind != VariableKind::kLocal && next.kind == TokenKind::kIdentifier &&
                     (is_specifier_word(next.text) || type_of_word(next.text) != Type::kVoid);
    if (new_group) return;
    advance();
  }
}

// fdecl = IDENT [ "[" [ constexpr ] "]" ] [ "=" ( expr | arrayinit ) ] ;
Variable* Parser::parse_declarator(const Specifiers& s, VariableKind kind) {
  if (!at(TokenKind::kIdentifier)) {
    fail(Msg::kExpectedName, describe_current());
    return nullptr;
  }
  if (type_of_word(current().text) != Type::kVoid || is_specifier_word(current().text)) {
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
  v.output = s.output;
  advance();
  if (take(TokenKind::kLeftBracket)) {
    v.array_length = kOpenArray;
    if (!at(TokenKind::kRightBracket)) v.length_expr = parse_expression();
    expect(TokenKind::kRightBracket, "']'");
  }
  if (take(TokenKind::kAssign)) v.init = at(TokenKind::kLeftBrace) ? parse_array_init() : parse_expression();
  return &v;
}

// arrayinit = "{" expr { "," expr } [ "," ] "}" ;
ExprPtr Parser::parse_array_init() {
  auto init = std::make_unique<ArrayInitExpr>(current().range);
  expect(TokenKind::kLeftBrace, "'{'");
  while (!panic_ && !at(TokenKind::kRightBrace)) {
    init->elements.push_back(parse_expression());
    if (!take(TokenKind::kComma)) break;
  }
  expect(TokenKind::kRightBrace, "'}'");
  init->range = join(init->range, last_range());
  return init;
}

// Constructs of RSL 2.0, by name. True: reported and skipped, or in panic.
bool Parser::reject_rsl2_declaration() {
  if (!at(TokenKind::kIdentifier) || panic_) return panic_;
  std::string_view word = current().text;
  const Token& next = peek();
  bool before_name = next.kind == TokenKind::kIdentifier;
  bool block = (word == "class" || word == "struct") && before_name;
  bool other = (word == "plugin" && next.kind == TokenKind::kString) ||
               ((word == "shader" || word == "public" || word == "private" || word == "constant" ||
                 word == "method" || word == "bool") &&
                before_name);
  if (!block && !other) return false;
  report(diags_, Msg::kRsl2, current().range, word);
  if (!block) {
    panic_ = true;
    return true;
  }
  while (!at_end() && !at(TokenKind::kLeftBrace) && !at(TokenKind::kSemicolon))
    advance();
  if (at(TokenKind::kLeftBrace)) skip_balanced();
  take(TokenKind::kSemicolon);
  return true;
}

} // namespace slc
