// Semantic analysis of one translation unit: names, types, overloads, conversions. Shared by the .cpp files
// of this folder; the interface is sema.h.
//
// Expressions are checked in two phases. analyse() walks up from the leaves, resolves names and returns the
// set of types an expression can have. finish() walks down with the type the context wants, picks one,
// annotates the nodes and inserts conversions. What depends on the shader a function is inlined into (uniform
// and varying, access to predefined variables, where light loops may stand) is checked afterwards, in
// contexts.cpp.
#pragma once

#include "slc/diag/messages.h"
#include "slc/sema/builtins.h"
#include "slc/sema/overload.h"
#include "slc/sema/scope.h"
#include "slc/sema/usage.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

namespace slc {

class Checker {
public:
  /// `library`: bodies of built-ins, or the one being made from `unit` itself when `in_library`.
  /// `plugins`: where functions of plug-ins are found; null: nowhere.
  Checker(TranslationUnit& unit, const BuiltinLibrary& library, bool in_library, slvm::Diagnostics& diags,
          const slvm::PluginSource* plugins = nullptr)
      : unit_(unit), library_(library), in_library_(in_library), diags_(diags), plugins_(plugins) {}

  void check_unit();

private:
  /// What a value is for: shapes the message when it does not fit, and which lint applies.
  struct Purpose {
    enum Kind : uint8_t {
      kInitialiser,
      kAssignment,
      kArgument,
      kOperand,
      kReturn,
      kIndex,
      kElement,
      kCast
    } kind;
    std::string_view name; ///< of the variable or function
  };

  // declarations.cpp
  void check_function(FunctionDef&);
  void check_function_body(FunctionDef&);
  void check_result(FunctionDef&);
  void check_shader(Shader&);
  void declare(Variable&);
  void declare_parameter(Variable&, const Shader&);
  void declare_formal(Variable&);
  void declare_local(Variable&);
  void declare_extern(Variable*&);
  void check_array_length(Variable&);
  void check_initialiser(Variable&);
  void report_duplicate(const FunctionDef&);
  Variable* global_variable(Global);

  // statements.cpp
  void check_statement(Stmt&);
  void check_block(BlockStmt&);
  void check_scoped(StmtPtr&);
  void check_loop(LoopStmt&);
  void check_jump(JumpStmt&);
  void check_return(ReturnStmt&);
  void check_illuminance(IlluminanceStmt&);
  void check_emission(EmissionStmt&);
  void check_gather(GatherStmt&);
  void check_loop_body(StmtPtr&);
  void check_axis_and_angle(std::vector<ExprPtr>& args, size_t first, ExprPtr& axis, ExprPtr& angle);
  /// Checks the token-value pairs behind the positional arguments and moves them to `tokens`.
  void split_tokens(std::vector<ExprPtr>& args, size_t positional, std::string_view set,
                    std::string_view statement, std::vector<TokenArg>& tokens);
  void check_condition(ExprPtr&);
  void finish_condition(ExprPtr&);

  // expressions.cpp
  TypeSet analyse(Expr&);
  TypeSet analyse_here(Expr&);
  TypeSet analyse_name(VariableExpr&);
  TypeSet analyse_index(IndexExpr&);
  TypeSet analyse_operator(OperatorExpr&);
  bool is_member(const OperatorExpr&);
  bool is_chained(OperatorExpr&);
  TypeSet analyse_conditional(ConditionalExpr&);
  TypeSet analyse_assign(AssignExpr&);
  TypeSet set_of(const Expr&) const;
  Variable* resolve(std::string_view name, SourceRange where);
  void report_unknown_variable(std::string_view name, SourceRange where);
  void finish(ExprPtr&, Type wanted);
  void finish_place(ExprPtr&);
  void finish_tuple(TupleExpr&, Type wanted);
  void finish_operator(OperatorExpr&, Type wanted);
  void finish_conditional(ConditionalExpr&, Type wanted);
  void finish_assign(AssignExpr&);
  void finish_cast(ExprPtr&);
  ExprPtr space_cast(CastExpr&);
  void finish_array_init(ArrayInitExpr&, const Variable&);
  bool check_writable(Variable&, SourceRange where);
  void report_bad_operands(const OperatorExpr&, const std::vector<Argument>&);

  // convert.cpp
  void finish_as(ExprPtr&, Type, Purpose);
  void convert(ExprPtr&, Type, Purpose);
  void insert_conversion(ExprPtr&, Type);
  void lint_conversion(const Expr&, Type, Purpose);
  Argument argument(Expr&);
  static ShadeopId row(std::string_view name, Type result, Type param);
  static std::string types_text(const std::vector<Argument>&);

  // calls.cpp
  TypeSet analyse_call(CallExpr&);
  std::vector<Candidate> candidates(const CallExpr&, const std::vector<Argument>&);
  void take_channel(CallExpr&);
  void report_no_candidate(const CallExpr&, const std::vector<Candidate>&, const std::vector<Argument>&);
  void report_unknown_function(const CallExpr&);
  void finish_call(ExprPtr&, Type wanted);
  void finish_argument(CallExpr&, size_t i, const Param&);
  void finish_output(ExprPtr&, const Param&, std::string_view callee);
  void finish_tokens(CallExpr&, const Candidate&);
  void finish_token(ExprPtr token, ExprPtr value, std::string_view set, std::string_view callee,
                    std::vector<TokenArg>& out);
  void use_library_body(CallExpr&);
  void fold_left(ExprPtr&);

  // plugin_calls.cpp
  void load_plugins();
  /// Functions of plug-ins; the folders are searched only for names that nothing else has.
  const slvm::PluginSource::Functions& plugin_functions(const std::string& name, bool search);
  void let_store(Candidate& chosen, const CallExpr&);
  /// The function of a plug-in that this call names, if it returns an array; else null.
  const slvm::PluginShadeop* array_function(const Expr* call);
  /// Makes such a call, the value of array `name`, store to it. False: it is none.
  bool fill_array(Expr* call, const std::string& name);

  // call_rules.cpp: what single functions ask for beyond their types
  void check_call_rules(CallExpr&);
  void check_print_pattern(CallExpr&);
  void check_colour_space(const Expr& name);
  void check_space(const Expr& name);
  void check_transform_source(const CallExpr&);
  std::string space_of(const Expr&) const;
  Type wanted_by_pattern(const CallExpr&, size_t arg) const;

  TranslationUnit& unit_;
  const BuiltinLibrary& library_;
  bool in_library_;
  slvm::Diagnostics& diags_;
  const slvm::PluginSource* plugins_;
  std::map<std::string, slvm::PluginSource::Functions> plugin_functions_; ///< by name, as far as known
  std::set<std::string> searched_;
  std::set<std::string> asked_loaded_;      ///< names that loaded plug-ins were asked for
  slvm::PluginShadeops called_plugins_;     ///< no more than a compiled shader can name
  std::vector<std::string> loaded_plugins_; ///< by statements
  std::map<std::string, std::vector<std::string>> plugin_trouble_; ///< what was wrong with libraries, by name
  Scopes scopes_;
  Usage usage_;
  /// Replaced nodes, kept to the end: the tables below know expressions by their addresses.
  std::vector<ExprPtr> retired_;
  void replace(ExprPtr& e, ExprPtr by) { retired_.push_back(std::exchange(e, std::move(by))); }
  std::unordered_map<const Expr*, TypeSet> sets_;
  struct Resolution {
    std::vector<Viable> viable;
    std::vector<Argument> args;
  };
  std::unordered_map<const Expr*, Resolution> resolutions_;
  std::array<Variable*, slvm::kGlobalCount> globals_{};
  std::set<const FunctionDef*> open_functions_; // being checked: calling one is recursion
  const FunctionDef* function_ = nullptr;       // the innermost; null in a shader's own body
  bool returned_value_ = false;
  int light_loops_ = 0; // illuminance, illuminate and solar around the expression, in the text
  int loops_ = 0;       // around the statement, in the same function
  std::map<const Variable*, std::string> spaces_; // space a variable's value was transformed to, where known
};

/// The value of a constant expression of numbers and + - * /.
bool constant_value(const Expr&, float& value);

} // namespace slc
