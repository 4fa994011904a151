// Names and what they mean: nested scopes of variables and functions.
#pragma once

#include "slc/ast/unit.h"

#include <map>
#include <string_view>

namespace slc {

/// The same formals and the same result: no call can tell them apart.
bool same_types(const FunctionDef& a, const FunctionDef& b);

/// Blocks of the source, innermost last. A function's scope hides the variables (not the functions) around
/// it.
class Scopes {
public:
  void enter(bool function_boundary = false) { scopes_.push_back({{}, {}, function_boundary}); }
  void leave() { scopes_.pop_back(); }

  /// Makes `name` mean `v` in the innermost scope. Returns what it meant there before, or null.
  Variable* declare(std::string_view name, Variable* v);
  void declare(FunctionDef* f) { scopes_.back().functions[f->name].push_back(f); }

  /// The variable `name` within the current function or shader, or null.
  Variable* find(std::string_view name) const;
  /// The same beyond the current function: what `extern` refers to.
  Variable* find_outside(std::string_view name) const;
  /// All functions of that name, innermost scope first, but those that an inner one with the same types
  /// hides.
  std::vector<FunctionDef*> functions(std::string_view name) const;
  /// Those of the innermost scope alone.
  std::vector<FunctionDef*> own_functions(std::string_view name) const;
  /// In a function, or a nested one: not in a shader's own body.
  bool in_function() const;

  std::vector<std::string_view> visible_variables() const;
  std::vector<std::string_view> visible_functions() const;

private:
  struct Scope {
    std::map<std::string, Variable*, std::less<>> variables;
    std::map<std::string, std::vector<FunctionDef*>, std::less<>> functions;
    bool function_boundary = false;
  };
  std::vector<Scope> scopes_;
};

} // namespace slc
