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
  static slc::ExprPtr element(slc::Variable& array, slc::ExprPtr index);
  static slc::ExprPtr assign(slc::ExprPtr target, slc::ExprPtr value);
  /// `printf("TEXT", values...)`.
  static slc::ExprPtr print(const std::string& text, std::vector<slc::ExprPtr> values, SourceRange where);
  static slc::StmtPtr statement(slc::ExprPtr expression);

  /// A variable for what `actual` gives: of its type, an array if it is one.
  struct Formal {
    slc::Variable* variable = nullptr;
    slc::ExprPtr actual;
  };
  Formal formal(const std::string& name, slc::ExprPtr actual, bool output = false);
  /// The call of a function made for it: `T f(formals...) { body; return result; }`. Arguments are evaluated
  /// in order.
  slc::ExprPtr call(std::vector<Formal> formals, std::vector<slc::ExprPtr> body, slc::ExprPtr result);
  /// `condition` as a float, 1 or 0; and back.
  static slc::ExprPtr float_of_bool(slc::ExprPtr condition);
  static slc::ExprPtr bool_of_float(slc::ExprPtr value);

private:
  slc::TranslationUnit& unit_;
};

} // namespace slvm::sltest
