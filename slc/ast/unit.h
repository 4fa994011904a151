// Variables, functions, shaders and the translation unit that owns them. Read expr.h and stmt.h first.
//
// Lowering starts at TranslationUnit::shaders: parameters' defaults in order, then the body. Functions are
// met through CallExpr::function and inlined there; because nothing recurs, each Variable has at most one
// live instance at a time, and a nested function finds the enclosing function's variables simply by their
// pointers.
#pragma once

#include "slc/ast/stmt.h"

#include <deque>
#include <set>

namespace slc {

enum class VariableKind : uint8_t { kGlobal, kParameter, kFormal, kLocal };

/// A variable of the source. Names are resolved: expressions point here.
struct Variable {
  VariableKind kind = VariableKind::kLocal;
  std::string name;
  SourceRange where;
  Type type = Type::kVoid;
  int array_length = kNotArray; ///< kOpenArray for formals `T a[]` only
  /// As declared; without a declaration (`detail_given` false) parameters are uniform, locals and formals as
  /// inferred. A local declared uniform can vary in fact: when it is set under varying control, which is a
  /// warning.
  Detail detail = Detail::kUniform;
  bool detail_given = false;
  bool output = false;
  bool copied =
      false; ///< a read-only parameter or formal that is assigned to all the same: it is a local copy
  Global global = Global::kCount; ///< kGlobal: which
  /// Parameter default or local initialiser, of the variable's type; null if none. For arrays an
  /// ArrayInitExpr, or for parameters and locals a single value for every element. Not for globals and
  /// formals.
  ExprPtr init;
  ExprPtr length_expr; ///< as parsed, `[n]`; null after semantic analysis
  /// The space or colour space named by the cast around a parameter's default, "" if none: for introspection.
  /// The conversion itself is part of `init`.
  std::string init_space;
};

/// A function: of the source, nested, or the RSL body of a built-in. After semantic analysis it is only read.
struct FunctionDef {
  std::string name;
  SourceRange where; ///< of the name
  Type result = Type::kVoid;
  bool result_given = true;       ///< false: the source omitted it
  bool result_uniform = false;    ///< declared `uniform`
  bool broken = false;            ///< its formals had errors: calls cannot be checked
  std::vector<Variable*> formals; ///< passed by reference; read-only unless `output`
  std::unique_ptr<BlockStmt> body;
  ShadeopId shadeop = kNoShadeop; ///< the row whose body this is
};

/// `#pragma annotation "id" "text"`.
struct Annotation {
  std::string id, text;
  SourceRange where;
};

/// `plugin "name";`
struct PluginStatement {
  std::string name;
  SourceRange where; ///< of the name
};

struct Shader {
  ShaderKind kind = ShaderKind::kSurface;
  std::string name;
  SourceRange where;             ///< of the name
  std::vector<Variable*> params; ///< all with an init
  std::unique_ptr<BlockStmt> body;
  std::vector<Annotation> annotations;
  /// Predefined variables it assigns to though they are read-only: it works on copies.
  std::set<slvm::Global> copied;
};

/// A function or shader of the file itself, not nested: one of the two is set.
struct Definition {
  FunctionDef* function = nullptr;
  Shader* shader = nullptr;
};

/// All that one source file and its includes define. Owns every node.
struct TranslationUnit {
  std::vector<Definition> definitions; ///< in source order
  std::deque<Variable> variables;
  std::deque<FunctionDef> functions; ///< in source order, nested ones included
  std::deque<Shader> shaders;        ///< in source order
  std::vector<Annotation> annotations;
  std::vector<PluginStatement> plugins;
  /// Names whose declarations had errors: nothing more is said about them.
  std::set<std::string, std::less<>> misdeclared;
  /// Keeps the functions of the built-ins alive, to which calls of this unit refer.
  std::shared_ptr<const TranslationUnit> builtins;
};

} // namespace slc
