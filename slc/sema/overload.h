// Overload resolution: which function or row of the table a call or operator means. Two phases, so that the
// return type can decide too: viable() finds the candidates whose arguments convert most cheaply, choose()
// picks among them by the type the context wants.
#pragma once

#include "slc/ast/unit.h"
#include "slc/sema/types.h"

#include <string>
#include <vector>

namespace slc {

/// A parameter of a candidate.
struct Param {
  Type type = Type::kVoid;
  int array_length = kNotArray; ///< kOpenArray: any length
  bool any = false;             ///< a value of any type
  bool output = false, input = true;
  bool uniform = false;
  std::string_view name = {};
};

/// A function of the source, a row of the table, or a function of a plug-in.
struct Candidate {
  const FunctionDef* function = nullptr;
  ShadeopId row = kNoShadeop;
  std::shared_ptr<const slvm::PluginShadeop> plugin = {};

  /// Of a row or of a plug-in's function.
  const slvm::ShadeopInfo& info() const { return plugin ? plugin->info() : slvm::shadeop(row); }
  Type result() const;
  bool takes_count(size_t args) const;  ///< token-value pairs included
  size_t positional(size_t args) const; ///< how many of them are not token-value pairs
  Param param(size_t i) const;
  std::string_view token_set() const;
  /// "float smoothstep(float min, float max, float x)".
  std::string text() const;
};

/// An argument as far as resolution looks at it.
struct Argument {
  TypeSet types;
  int array_length = kNotArray;
  /// What tips the balance between equally good candidates.
  Type preferred = Type::kVoid;
  bool place = false; ///< can be stored to
};

struct Viable {
  Candidate candidate;
  int cost = 0;
  int promotion = 0; ///< the part of it that a type wanted outside makes up for
};

/// Of the conversion of one argument; kImpossible when there is none.
int argument_cost(const Param&, const Argument&);
/// Sum of the conversions the candidate needs; kImpossible or more when it cannot be called so.
int call_cost(const Candidate&, const std::vector<Argument>& args);
/// The candidates of least cost, in order; empty when none can be called. Floats beside an argument that
/// could be of several types are promoted for nothing: in `Ci = noise(P) + .5` the sum may be one of colors.
std::vector<Viable> viable(const std::vector<Candidate>&, const std::vector<Argument>& args);
/// The index of the best of them where a `wanted` (kVoid: any) is needed; at equal rank the first. `tied`:
/// indices of others that are exactly as good.
size_t choose(const std::vector<Viable>&, const std::vector<Argument>& args, Type wanted,
              std::vector<size_t>* tied = nullptr);

} // namespace slc
