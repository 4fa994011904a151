// The recursive-descent parser, shared by the .cpp files of this folder.
//
// After an error the parser is in panic: it reports nothing more and consumes little until synchronise() has
// found the end of the statement or declaration. Parse functions therefore never check for errors; they
// return a node, or null for a statement that was skipped.
#pragma once

#include "slc/diag/messages.h"
#include "slc/parse/foreign.h"
#include "slc/parse/parse.h"

#include <utility>

namespace slc {

class Parser {
public:
  Parser(TokenList tokens, slvm::Diagnostics& diags) : tokens_(std::move(tokens.tokens)), diags_(diags) {
    for (PragmaAnnotation& a : tokens.annotations)
      unit_.annotations.push_back({std::move(a.id), std::move(a.text), a.where});
  }

  TranslationUnit parse_file();

private:
  // declarations.cpp
  void parse_shader();
  FunctionDef* parse_function();
  bool at_function() const;
  bool at_prototype() const;
  size_t behind_formals() const;
  void parse_misplaced();
  void parse_global_variable();
  std::unique_ptr<BlockStmt> parse_body();
  bool parse_plugin();
  bool reject_rsl2_declaration();
  void assign_annotations();

  // declarators.cpp
  std::vector<Variable*> parse_formals(VariableKind kind, bool& broken);
  void parse_formal_group(VariableKind kind, std::vector<Variable*>& out, bool& broken);
  void skip_formal_group(size_t begin);
  struct Specifiers {
    Type type = Type::kVoid;
    bool output = false, is_extern = false, detail_given = false;
    Detail detail = Detail::kVarying;
    bool broken = false; ///< reported: the variables are only noted as misdeclared
    bool array = false;  ///< `float[3] x`, reported
  };
  Specifiers parse_specifiers();
  Type take_type(Specifiers& s);
  Type take_foreign_type(bool& broken);
  void take_misplaced_length(Specifiers& s);
  void skip_metadata();
  void parse_declarators(const Specifiers&, VariableKind kind, std::vector<Variable*>& out);
  Variable* parse_declarator(const Specifiers&, VariableKind kind);
  void parse_length(Variable& v);
  void reject_second_index();
  ExprPtr parse_array_init();

  // statements.cpp
  StmtPtr parse_statement();
  StmtPtr parse_statement_here();
  std::unique_ptr<BlockStmt> parse_block();
  StmtPtr parse_word_statement();
  StmtPtr parse_declaration();
  StmtPtr parse_expression_statement();
  StmtPtr parse_if();
  StmtPtr parse_while();
  StmtPtr parse_for();
  StmtPtr parse_jump();
  StmtPtr parse_return();
  StmtPtr parse_illuminance();
  StmtPtr parse_emission();
  StmtPtr parse_gather();
  StmtPtr parse_foreign_statement(std::string_view advice);
  void check_empty_body(std::string_view word);
  bool resume_at_body(size_t header, bool is_for = false);
  ExprPtr parse_condition();
  std::vector<ExprPtr> parse_arguments();
  std::vector<ExprPtr> parse_expression_list();

  // expressions.cpp
  ExprPtr parse_expression();
  ExprPtr parse_ternary();
  ExprPtr parse_binary(int level);
  ExprPtr parse_unary();
  ExprPtr parse_cast();
  ExprPtr parse_primary();
  ExprPtr parse_parenthesised();
  ExprPtr parse_name();
  ExprPtr parse_string();
  ExprPtr parse_binary_operator(ExprPtr left, int level, Operator op);
  ExprPtr parse_foreign_binary(ExprPtr left, const ForeignOperator&);
  ExprPtr parse_foreign_unary();
  ExprPtr parse_increments(ExprPtr e);
  void report_not_assignable(const Expr&);
  const ForeignOperator* at_foreign_operator() const;
  slvm::Diagnostic& report_foreign_operator(const ForeignOperator&);
  ExprPtr missing_expression();
  ExprPtr broken_expression(slvm::SourceRange) const;

  // recovery.cpp
  /// Reports at the current token and panics; nothing when in panic already.
  template <class... Args> slvm::Diagnostic* fail(Msg id, const Args&... args) {
    return fail_at(id, current().range, args...);
  }
  template <class... Args> slvm::Diagnostic* fail_at(Msg id, slvm::SourceRange where, const Args&... args) {
    return std::exchange(panic_, true) ? nullptr : &report(diags_, id, where, args...);
  }
  /// Skips to the end of the statement that went wrong, or to where one surely starts.
  void synchronise();
  /// Skips a balanced { } or ( ), the current token being its first.
  void skip_balanced();
  bool at_shader_start() const;
  /// At a word that starts a declaration, of this language or another.
  bool at_declaration() const;
  /// Token `i` is a type or a specifier.
  bool declares(size_t i) const;
  bool at_statement_word() const;
  std::string describe_current() const;
  bool expect(TokenKind kind, std::string_view what);
  /// The same for what closes the bracket at `open`, which a note shows.
  bool expect_close(TokenKind kind, std::string_view what, slvm::SourceRange open);
  void note_indentation(size_t open, size_t close);
  uint32_t indentation(size_t token) const;

  // Tokens.
  const Token& current() const { return tokens_[at_]; }
  const Token& peek(size_t ahead = 1) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
  bool at(TokenKind kind) const { return current().kind == kind; }
  bool at_word(std::string_view word) const { return at(TokenKind::kIdentifier) && current().text == word; }
  bool at_end() const { return at(TokenKind::kEnd); }
  void advance() {
    if (!at_end()) ++at_;
  }
  bool take(TokenKind kind) {
    if (panic_ || !at(kind)) return false;
    advance();
    return true;
  }
  bool take_word(std::string_view word) {
    if (panic_ || !at_word(word)) return false;
    advance();
    return true;
  }
  slvm::SourceRange behind_last() const;
  slvm::SourceRange last_range() const { return tokens_[at_ ? at_ - 1 : 0].range; }

  /// Counts one level of nesting while it lives; too deep is an error.
  class Nesting {
  public:
    explicit Nesting(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kMaxNesting) parser_.too_deep();
    }
    ~Nesting() { --parser_.depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;

  private:
    Parser& parser_;
  };
  void too_deep();

  std::vector<Token> tokens_;
  slvm::Diagnostics& diags_;
  TranslationUnit unit_;
  size_t at_ = 0;
  int depth_ = 0;
  bool panic_ = false;
  bool lost_ = false;          // between definitions, behind an error: up to the next one nothing is reported
  bool in_for_header_ = false; // a ')' there ends it
  slvm::SourceRange suspect_;  // the first '{' of the shader whose '}' has another indentation
  bool gave_up_ = false;       // after an error with no way on: the rest of the file is skipped
};

/// The type a keyword names; kVoid for other words. "void" is not a type here.
Type type_of_word(std::string_view word);
/// A word with which only statements start, and no variable or function is called.
bool is_statement_word(std::string_view word);
/// output, uniform, varying, extern.
bool is_specifier_word(std::string_view word);
/// The kind of shader a word declares, if any.
bool shader_kind_of_word(std::string_view word, ShaderKind& kind);

} // namespace slc
