// The walk over one checked source that puts marks into it. Read instrument.h first; then instrument.cpp
// (statements), marker_expressions.cpp (conditions, what is read and what is set) and marker_probe.cpp.
#pragma once

#include "slvm/tools/sltest/instrument.h"
#include "slvm/tools/sltest/syntax_maker.h"

namespace slvm::sltest {

class Marker {
public:
  Marker(Instrumenter& out, slc::CheckedSource& checked, const SourceManager& sources)
      : out_(out), unit_(checked.unit), sources_(sources), make_(checked.unit) {}

  void run();

private:
  // ---- Places (instrument.cpp).
  std::string file_of(SourceRange where) const;
  /// Not the text that sltest puts around expressions.
  bool wanted(SourceRange where) const;
  slc::ExprPtr mark(MarkKind kind, SourceRange where, const std::string& name,
                    std::vector<slc::ExprPtr> values);

  // ---- The probe (marker_probe.cpp).
  bool is_probed_file(SourceRange where) const;
  void find_probe_line();
  static std::vector<const slc::StmtPtr*> bodies(const slc::Stmt& s);
  bool probed(const slc::Stmt& s) const;
  slc::Variable* visible(const std::string& name, SourceRange where);
  /// A mark with the probed variable's value, or null where there is no such variable.
  slc::StmtPtr probe(SourceRange where);

  // ---- Statements (instrument.cpp).
  void function(slc::FunctionDef& f);
  static bool does_something(const slc::Stmt& s);
  void block(slc::BlockStmt& b);
  /// The statement in a block of its own; `probed_head`: a probed loop, whose value is that of each pass.
  void body(slc::StmtPtr& s, bool probed_head = false);
  void statement(slc::Stmt& s);
  void loop(slc::LoopStmt& s);
  void gather(slc::GatherStmt& s);
  void declaration(slc::DeclarationStmt& s);
  /// Expressions evaluated for their effects; what calls without a result set is marked behind them.
  void expressions(std::vector<slc::ExprPtr>& list);
  /// What tells that all of a variable is set.
  slc::ExprPtr whole(slc::Variable& set, SourceRange where, const slc::Variable* length_of = nullptr);

  // ---- Expressions (marker_expressions.cpp).
  void condition(slc::ExprPtr& e, const char* what, SourceRange statement_range);
  void right_side(slc::LogicalExpr& e);
  void mark_condition(slc::ExprPtr& e, const char* what, SourceRange where);
  template <class... Items> static std::vector<slc::ExprPtr> list(Items... items) {
    std::vector<slc::ExprPtr> out;
    (out.push_back(std::move(items)), ...);
    return out;
  }
  slc::Variable* set_of(const slc::Expr& e) const;
  /// `e` reads a variable: hands a mark whether that was set.
  void observe_read(slc::ExprPtr& e, slc::Variable& set);
  /// What hands a mark whether the element was set.
  slc::ExprPtr element_mark(slc::Variable& known, const slc::Variable& set, slc::Variable& index,
                            SourceRange where);
  /// `e` reads an element of an array.
  void observe_element_read(slc::ExprPtr& e, slc::Variable& set);
  /// The subscript of an element that is stored to: the element counts as set, after it was read where it is.
  void set_element(slc::ExprPtr& subscript, slc::Variable& set, bool read_too);
  /// `array[index] = value`: the element counts as set once the value is known.
  void set_assigned_element(slc::ExprPtr& e, slc::Variable& set);
  /// Once `e` has its value, the variables count as set.
  void set_after(slc::ExprPtr& e, const std::vector<slc::Variable*>& variables);
  void named(const std::string& name, slc::ExprPtr& value);
  void expr(slc::ExprPtr& e);
  void each(std::vector<slc::ExprPtr>& list);
  /// A place that a call sets: its subscript is an expression, the rest is not read. What is set as a whole
  /// is told.
  slc::Variable* place(slc::Expr& e);
  void call(slc::ExprPtr& e);
  void assign(slc::ExprPtr& e);

  Instrumenter& out_;
  slc::TranslationUnit& unit_;
  const SourceManager& sources_;
  SyntaxMaker make_;
  uint32_t probe_line_ = 0;
  bool in_probed_if_ = false;         ///< the value was taken before it
  std::vector<slc::Variable*> scope_; ///< what is declared so far, innermost last
  std::map<const slc::Variable*, slc::Variable*> set_of_;
  std::vector<slc::Variable*> set_by_call_;
  std::vector<slc::Variable*>
      targets_;                       ///< of the assignments around, whether they are set; null: not followed
  std::vector<std::string> computed_; ///< variables whose values are being computed
  std::vector<std::string> results_;  ///< of the functions around
};

} // namespace slvm::sltest
