// Makes nodes of checked syntax trees: what semantic analysis would have left of source text like this.
#pragma once

#include "slc/ast/unit.h"

namespace slvm::sltest {

class SyntaxMaker {
public:
  explicit SyntaxMaker(slc::TranslationUnit& unit) : unit_(unit) {}

  slc::Variable* variable(slc::VariableKind kind, const std::string& name, Type type, SourceRange where);
  static slc::ExprPtr number(float value, SourceRange where);
  static slc::ExprPtr read(slc::Variable& variable, SourceRange where);
  static slc::ExprPtr element(slc::Variable& array, int index, SourceRange where);
  static slc::ExprPtr assign(slc::Variable& variable, slc::ExprPtr value, SourceRange where);
  /// `printf("TEXT", values...)`.
  static slc::ExprPtr print(const std::string& text, std::vector<slc::ExprPtr> values, SourceRange where);
  static slc::StmtPtr statement(slc::ExprPtr expression);

  /// The value of `value`, after `first` ran with it: a call `f(value, others...)` of
  /// `T f(T x; formals...) { body; return x; }`.
  struct Formal {
    slc::Variable* variable;
    slc::ExprPtr actual;
  };
  /// `body` may use `x`, made by the caller as a formal of the value's type.
  slc::ExprPtr pass_through(slc::ExprPtr value, slc::Variable& x, std::vector<Formal> others,
                            std::vector<slc::ExprPtr> body);
  /// `condition` as a float, 1 or 0; and back.
  static slc::ExprPtr float_of_bool(slc::ExprPtr condition);
  static slc::ExprPtr bool_of_float(slc::ExprPtr value);

private:
  slc::TranslationUnit& unit_;
};

} // namespace slvm::sltest
