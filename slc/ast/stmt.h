// Statements of the syntax tree. Read expr.h first: the rules about what holds after semantic analysis go on
// here.
//
// Scopes are resolved: blocks only group. A nested function definition leaves no statement; `extern`
// declarations leave none either.
#pragma once

#include "slc/ast/expr.h"

namespace slc {

enum class StmtKind : uint8_t {
  kEmpty,
  kBlock,
  kDeclaration,
  kFunction,
  kExpression,
  kIf,
  kLoop,
  kJump,
  kReturn,
  kIlluminance,
  kEmission,
  kGather
};

struct Stmt {
  StmtKind kind;
  SourceRange range; ///< its first line

  virtual ~Stmt() = default;

protected:
  Stmt(StmtKind k, SourceRange r) : kind(k), range(r) {}
};
using StmtPtr = std::unique_ptr<Stmt>;

template <StmtKind K> struct StmtOf : Stmt {
  static constexpr StmtKind kKind = K;
  explicit StmtOf(SourceRange r) : Stmt(K, r) {}
};

template <class T> T* as(Stmt* s) {
  return s && s->kind == T::kKind ? static_cast<T*>(s) : nullptr;
}
template <class T> const T* as(const Stmt* s) {
  return s && s->kind == T::kKind ? static_cast<const T*>(s) : nullptr;
}

struct EmptyStmt : StmtOf<StmtKind::kEmpty> {
  using StmtOf::StmtOf;
};

struct BlockStmt : StmtOf<StmtKind::kBlock> {
  std::vector<StmtPtr> statements;
  using StmtOf::StmtOf;
};

/// Declares local variables, in order; each starts as its `init`, or as zero or "" without one, every time
/// the statement is executed. Variables of an `extern` declaration are those of the outer scope, and not
/// declared here: with `is_extern` the statement does nothing.
struct DeclarationStmt : StmtOf<StmtKind::kDeclaration> {
  std::vector<Variable*> variables;
  bool is_extern = false;
  using StmtOf::StmtOf;
};

/// A nested function: does nothing here.
struct FunctionStmt : StmtOf<StmtKind::kFunction> {
  FunctionDef* function = nullptr;
  using StmtOf::StmtOf;
};

/// Expressions evaluated for their effects, in order.
struct ExpressionStmt : StmtOf<StmtKind::kExpression> {
  std::vector<ExprPtr> expressions;
  using StmtOf::StmtOf;
};

struct IfStmt : StmtOf<StmtKind::kIf> {
  ExprPtr condition;                ///< a bool
  StmtPtr then_branch, else_branch; ///< else may be null
  using StmtOf::StmtOf;
};

/// while and for.
struct LoopStmt : StmtOf<StmtKind::kLoop> {
  bool is_for = false;
  StmtPtr init;               ///< null, an ExpressionStmt or a DeclarationStmt
  ExprPtr condition;          ///< a bool; null: true
  std::vector<ExprPtr> steps; ///< evaluated after each round, and by `continue`
  StmtPtr body;
  using StmtOf::StmtOf;
};

/// break and continue. `levels` >= 1 counts enclosing loops from the inside; while, for, illuminance, gather
/// and traverse (their else blocks too) count. Never more than there are in the same function or shader.
struct JumpStmt : StmtOf<StmtKind::kJump> {
  bool is_break = true;
  int levels = 1;
  using StmtOf::StmtOf;
};

/// In functions `value` has the result type, null only in void functions; in shaders it is null.
struct ReturnStmt : StmtOf<StmtKind::kReturn> {
  ExprPtr value;
  using StmtOf::StmtOf;
};

/// `illuminance([category,] position [, axis, angle] [, tokens])`.
struct IlluminanceStmt : StmtOf<StmtKind::kIlluminance> {
  std::vector<ExprPtr> args; ///< as parsed, tokens included; empty after semantic analysis
  bool broken = false;       ///< with an error in them, which was reported
  ExprPtr category;          ///< string; null: all lights
  ExprPtr position;          ///< point
  ExprPtr axis, angle;       ///< vector and float; both null or both set
  std::vector<TokenArg> tokens;
  StmtPtr body;
  using StmtOf::StmtOf;
};

/// illuminate and solar, in light shaders only.
struct EmissionStmt : StmtOf<StmtKind::kEmission> {
  bool is_solar = false;
  std::vector<ExprPtr> args; ///< as parsed; empty after semantic analysis
  bool broken = false;       ///< with an error in them, which was reported
  ExprPtr position;          ///< point; null for solar
  ExprPtr axis, angle;       ///< vector and float; both null or both set
  StmtPtr body;
  using StmtOf::StmtOf;
};

/// `gather(category, P, dir, angle, samples, tokens) body else else_body` and `traverse(category, P, dir,
/// tokens)`.
struct GatherStmt : StmtOf<StmtKind::kGather> {
  bool is_traverse = false;
  std::vector<ExprPtr> args;    ///< as parsed, tokens included; empty after semantic analysis
  bool broken = false;          ///< with an error in them, which was reported
  ExprPtr category;             ///< string
  ExprPtr position, direction;  ///< point, vector
  ExprPtr angle, samples;       ///< floats; null for traverse
  std::vector<TokenArg> tokens; ///< output ones are set before the body runs
  StmtPtr body, else_body;      ///< else may be null
  using StmtOf::StmtOf;
};

} // namespace slc
