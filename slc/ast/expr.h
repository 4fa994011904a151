// Expressions of the syntax tree: plain structs, told apart by `kind`. Read next: stmt.h, unit.h, print.h.
//
// The parser makes them untyped; semantic analysis (slc/sema) annotates and rewrites them in place. Behind
// each struct stands what holds AFTER semantic analysis without errors; lowering relies on that and never
// looks at names, scopes or overloads. In general:
//   - `type`, `array_length` and `detail` are set. kBool is the type of relations, logical operators and
//   conditions.
//   - Every conversion is explicit: a ConvertExpr, or a cast that became a call. An operand has exactly the
//   type
//     its row's parameter, its formal or its assignment target asks for.
//   - Evaluation order is left to right, arguments before the call.
//   - `detail` is an upper estimate over all inlinings; it exists for messages and dumps only.
//   - Ranges inside RSL bodies of built-ins are not valid(): positions there are those of the outermost call.
#pragma once

#include "slvm/format/plugin_shadeop.h"
#include "slvm/support/source.h"

#include <memory>
#include <string>
#include <vector>

namespace slc {

using slvm::Detail;
using slvm::Global;
using slvm::ShadeopId;
using slvm::ShaderKind;
using slvm::SourceRange;
using slvm::Type;

struct FunctionDef;
struct Variable;

inline constexpr ShadeopId kNoShadeop = 0xffff;
inline constexpr int kNotArray = -1; ///< array_length of plain values
inline constexpr int kOpenArray = 0; ///< array_length of a formal `T a[]`: that of the actual argument

enum class ExprKind : uint8_t {
  kNumber,
  kString,
  kVariable,
  kIndex,
  kTuple,
  kArrayInit,
  kOperator,
  kLogical,
  kConditional,
  kConvert,
  kCast,
  kCall,
  kAssign,
  kTargetValue
};

struct Expr {
  ExprKind kind;
  SourceRange range; ///< the whole expression, cut off at the end of its first line
  Type type = Type::kVoid;
  int array_length = kNotArray;
  Detail detail = Detail::kUniform;

  virtual ~Expr() = default;

protected:
  Expr(ExprKind k, SourceRange r) : kind(k), range(r) {}
};
using ExprPtr = std::unique_ptr<Expr>;

/// Base of a concrete expression: `struct NumberExpr : ExprOf<ExprKind::kNumber>`.
template <ExprKind K> struct ExprOf : Expr {
  static constexpr ExprKind kKind = K;
  explicit ExprOf(SourceRange r) : Expr(K, r) {}
};

/// The expression as a T, or nullptr when it is of another kind.
template <class T> T* as(Expr* e) {
  return e && e->kind == T::kKind ? static_cast<T*>(e) : nullptr;
}
template <class T> const T* as(const Expr* e) {
  return e && e->kind == T::kKind ? static_cast<const T*>(e) : nullptr;
}

/// A float constant. PI is one too.
struct NumberExpr : ExprOf<ExprKind::kNumber> {
  float value = 0;
  bool broken = false; ///< stands for an expression with an error, which was reported
  using ExprOf::ExprOf;
};

/// A string constant, escapes resolved, adjacent literals joined.
struct StringExpr : ExprOf<ExprKind::kString> {
  std::string value;
  using ExprOf::ExprOf;
};

/// The value of a variable, or the place of one: `variable` is never null. Whole arrays (array_length not
/// kNotArray) occur only as call arguments, as output arguments, and as targets of AssignExpr with an
/// ArrayInitExpr.
struct VariableExpr : ExprOf<ExprKind::kVariable> {
  std::string name;
  Variable* variable = nullptr;
  using ExprOf::ExprOf;
};

/// One element of an array, value or place: `variable` is the array; `index` a float, to be truncated. Where
/// the variable is no array but a triple, one of its components, a float.
struct IndexExpr : ExprOf<ExprKind::kIndex> {
  std::string name;
  Variable* variable = nullptr;
  ExprPtr index;
  using ExprOf::ExprOf;
};

/// `(a, b, c)` or sixteen elements: a call of row `shadeop` ("triple" or "sixteen" of the right type);
/// elements are floats.
struct TupleExpr : ExprOf<ExprKind::kTuple> {
  std::vector<ExprPtr> elements;
  ShadeopId shadeop = kNoShadeop;
  using ExprOf::ExprOf;
};

/// `{a, b, ...}`: only the direct initialiser of an array variable (Variable::init) or the value of an
/// AssignExpr to a whole array. Elements have the array's element type; at most array_length of them, the
/// rest is zero or "".
struct ArrayInitExpr : ExprOf<ExprKind::kArrayInit> {
  std::vector<ExprPtr> elements;
  using ExprOf::ExprOf;
};

enum class Operator : uint8_t {
  kAdd,
  kSub,
  kMul,
  kDiv,
  kDot,
  kCross,
  kEqual,
  kNotEqual,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kNegate,
  kNot
};
/// As written in source; the table's row is "operator" followed by this.
std::string_view operator_text(Operator);

/// A unary or binary operator, one or two operands: a call of row `shadeop`.
struct OperatorExpr : ExprOf<ExprKind::kOperator> {
  Operator op = Operator::kAdd;
  std::vector<ExprPtr> operands;
  ShadeopId shadeop = kNoShadeop;
  using ExprOf::ExprOf;
};

/// `a && b`, `a || b` on bools. The right side must run only in lanes that need it.
struct LogicalExpr : ExprOf<ExprKind::kLogical> {
  bool is_and = true;
  ExprPtr left, right;
  using ExprOf::ExprOf;
};

/// `c ? a : b`: `condition` is a bool, both sides have the type of the whole. Each side runs only in its
/// lanes.
struct ConditionalExpr : ExprOf<ExprKind::kConditional> {
  ExprPtr condition, then_value, else_value;
  using ExprOf::ExprOf;
};

/// A conversion inserted by semantic analysis, or what is left of a cast without a space. With `shadeop` a
/// call of that "convert" row; without (kNoShadeop) a retyping among point, vector, normal and color: same
/// components.
struct ConvertExpr : ExprOf<ExprKind::kConvert> {
  ExprPtr operand;
  ShadeopId shadeop = kNoShadeop;
  using ExprOf::ExprOf;
};

/// `color "hsv" x`. Gone after semantic analysis: replaced by its operand, by a ConvertExpr, or, with a
/// space, by the call of ctransform, transform, vtransform or ntransform (from the space to "rgb" or
/// "current"), and for matrices by the product of spacematrix(space, "current") with the operand.
struct CastExpr : ExprOf<ExprKind::kCast> {
  Type target = Type::kVoid;
  bool has_space = false;
  std::string space;
  ExprPtr operand;
  using ExprOf::ExprOf;
};

/// A token-value pair of a call or of illuminance, gather, traverse.
struct TokenArg {
  ExprPtr token; ///< a string, mostly a StringExpr
  ExprPtr value; ///< where info->output: a VariableExpr or IndexExpr to be set; else of type info->type
  /// The token's row; null when `token` is not a constant (then the value is unconverted). Pairs with an
  /// unknown constant token are gone after semantic analysis.
  const slvm::TokenInfo* info = nullptr;
};

/// A call. One of these holds; a function of a plug-in, `plugin`, is called as a row is:
///   - `function` set: a function of the source or the RSL body of a built-in, to be inlined. `args` are
///   parallel
///     to function->formals: output formals get a place (VariableExpr or IndexExpr), array formals a whole
///     array as VariableExpr, others a value of the formal's type. Never recursive. `tokens` is empty.
///   - else `shadeop` is the row to call. `args` are its positional arguments; args[i] belongs to
///     signature.param(i). An `output` or `inout` parameter gets a place (any: of any type, arrays included);
///     `any` inputs are unconverted. Calls of kFoldLeft rows have been split into calls of two arguments.
///     Channel selections, texture(name[c], ...), have become an argument of their own (the row's parameter
///     "channel"; 0 where none is written). `tokens` holds the token-value pairs.
/// Places and whole arrays have the type asked for, or both are among point, vector and normal: then the
/// components are taken and stored as they are. A call of random() with detail kUniform goes straight into a
/// declared uniform: one draw per grid.
struct CallExpr : ExprOf<ExprKind::kCall> {
  std::string name;
  SourceRange name_range;
  std::vector<ExprPtr> args;
  ExprPtr channel; ///< of texture("name"[c]), as parsed; null after semantic analysis
  std::vector<TokenArg> tokens;
  ShadeopId shadeop = kNoShadeop;
  std::shared_ptr<const slvm::PluginShadeop> plugin;
  const FunctionDef* function = nullptr;
  /// A plug-in's function that returns an array: the initialiser or the value of an array, which is its first
  /// argument.
  bool fills_array = false;
  using ExprOf::ExprOf;

  /// Of a call of a row or of a plug-in's function.
  const slvm::ShadeopInfo& info() const { return plugin ? plugin->info() : slvm::shadeop(shadeop); }
};

/// `target = value`, `target op= value`. `target` is a VariableExpr or IndexExpr; `value` has its type. The
/// result is the stored value. A compound assignment has become a plain one whose value holds, exactly once,
/// a TargetValueExpr: the target's old value (its index is evaluated once, first).
struct AssignExpr : ExprOf<ExprKind::kAssign> {
  ExprPtr target, value;
  bool compound = false;
  Operator op = Operator::kAdd; ///< of a compound one; after semantic analysis only for printing
  SourceRange op_range;         ///< of the '='
  using ExprOf::ExprOf;
};

/// The old value of the target of the nearest enclosing compound AssignExpr.
struct TargetValueExpr : ExprOf<ExprKind::kTargetValue> {
  using ExprOf::ExprOf;
};

} // namespace slc
