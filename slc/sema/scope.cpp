// Name lookup.
#include "slc/sema/scope.h"

#include <algorithm>
#include <utility>

namespace slc {

Variable* Scopes::declare(std::string_view name, Variable* v) {
  auto [it, added] = scopes_.back().variables.try_emplace(std::string(name), v);
  return added ? nullptr : std::exchange(it->second, v);
}

Variable* Scopes::find(std::string_view name) const {
  for (size_t i = scopes_.size(); i-- > 0;) {
    auto it = scopes_[i].variables.find(name);
    if (it != scopes_[i].variables.end()) return it->second;
    if (scopes_[i].function_boundary) break;
  }
  return nullptr;
}

Variable* Scopes::find_outside(std::string_view name) const {
  size_t i = scopes_.size();
  while (i-- > 0 && !scopes_[i].function_boundary) {
  }
  for (; i != static_cast<size_t>(-1) && i-- > 0;) {
    auto it = scopes_[i].variables.find(name);
    if (it != scopes_[i].variables.end()) return it->second;
  }
  return nullptr;
}

std::vector<FunctionDef*> Scopes::functions(std::string_view name) const {
  std::vector<FunctionDef*> found;
  for (size_t i = scopes_.size(); i-- > 0;) {
    auto it = scopes_[i].functions.find(name);
    if (it == scopes_[i].functions.end()) continue;
    // Inner ones hide outer ones of the same types, later ones earlier ones.
    const std::vector<FunctionDef*>& here = it->second;
    const auto inner = static_cast<std::ptrdiff_t>(found.size());
    for (size_t k = 0; k < here.size(); ++k) {
      auto like = [&](const FunctionDef* other) { return same_types(*other, *here[k]); };
      if (std::none_of(found.begin(), found.begin() + inner, like) &&
          std::none_of(here.begin() + static_cast<std::ptrdiff_t>(k) + 1, here.end(), like))
        found.push_back(here[k]);
    }
  }
  return found;
}

std::vector<FunctionDef*> Scopes::own_functions(std::string_view name) const {
  auto it = scopes_.back().functions.find(name);
  return it == scopes_.back().functions.end() ? std::vector<FunctionDef*>() : it->second;
}

bool same_types(const FunctionDef& a, const FunctionDef& b) {
  auto same = [](const Variable* x, const Variable* y) {
    return x->type == y->type && (x->array_length == kNotArray) == (y->array_length == kNotArray);
  };
  return a.result == b.result &&
         std::equal(a.formals.begin(), a.formals.end(), b.formals.begin(), b.formals.end(), same);
}

bool Scopes::in_function() const {
  for (const Scope& scope : scopes_)
    if (scope.function_boundary) return true;
  return false;
}

std::vector<std::string_view> Scopes::visible_variables() const {
  std::vector<std::string_view> names;
  for (size_t i = scopes_.size(); i-- > 0;) {
    for (const auto& [name, variable] : scopes_[i].variables)
      names.push_back(name);
    if (scopes_[i].function_boundary) break;
  }
  return names;
}

std::vector<std::string_view> Scopes::visible_functions() const {
  std::vector<std::string_view> names;
  for (const Scope& scope : scopes_)
    for (const auto& [name, functions] : scope.functions)
      names.push_back(name);
  return names;
}

} // namespace slc
