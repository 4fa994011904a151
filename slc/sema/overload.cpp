// Ranking of candidates.
#include "slc/sema/overload.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace slc {
namespace {

const slvm::Signature& signature(const Candidate& c) {
  return c.info().signature;
}
bool folds(const Candidate& c) {
  return (c.info().flags & slvm::kFoldLeft) != 0;
}

std::string param_text(const Param& p) {
  std::string text;
  if (p.output) text += p.input ? "inout " : "output ";
  if (p.uniform) text += "uniform ";
  text += p.any ? "any" : std::string(slvm::type_name(p.type));
  if (p.array_length == kOpenArray)
    text += "[]";
  else if (p.array_length > 0)
    text += fmt::format("[{}]", p.array_length);
  if (!p.name.empty()) text += fmt::format(" {}", p.name);
  return text;
}

} // namespace

int argument_cost(const Param& p, const Argument& a) {
  if (a.types.is_error()) return 0;
  if ((p.array_length != kNotArray) != (a.array_length != kNotArray)) return kImpossible;
  if (p.array_length > 0 && a.array_length > 0 && p.array_length != a.array_length) return kImpossible;
  if (p.any) return 0;
  int cost = conversion_cost(a.types, p.type);
  // Stored components are taken as they are: only among point, vector and normal.
  bool by_reference = p.output || p.array_length != kNotArray;
  return by_reference && cost > 1 ? kImpossible : cost;
}

Type Candidate::result() const {
  return function ? function->result : signature(*this).result;
}

std::string_view Candidate::token_set() const {
  return function ? std::string_view() : signature(*this).token_set;
}

bool Candidate::takes_count(size_t args) const {
  if (function) return args == function->formals.size();
  const slvm::Signature& s = signature(*this);
  auto count = static_cast<size_t>(s.param_count);
  if (args == count) return true;
  if (args < count) return false;
  if (s.variadic() || folds(*this)) return true;
  return !s.token_set.empty() && (args - count) % 2 == 0;
}

size_t Candidate::positional(size_t args) const {
  if (token_set().empty()) return args;
  return std::min(args, static_cast<size_t>(signature(*this).param_count));
}

Param Candidate::param(size_t i) const {
  Param p;
  if (function) {
    const Variable& v = *function->formals[i];
    p.type = v.type;
    p.array_length = v.array_length;
    p.output = v.output;
    p.uniform = v.detail_given && v.detail == Detail::kUniform;
    p.name = v.name;
    return p;
  }
  const slvm::SignatureParam& s = signature(*this).param(static_cast<int>(i));
  p.type = s.type;
  p.array_length = !s.array ? kNotArray : s.elements ? static_cast<int>(s.elements) : kOpenArray;
  p.any = s.any;
  p.output = s.output;
  p.input = s.input;
  p.uniform = s.uniform;
  p.name = s.name;
  return p;
}

std::string Candidate::text() const {
  std::string_view name = function ? std::string_view(function->name) : info().name;
  size_t count = function ? function->formals.size() : static_cast<size_t>(signature(*this).param_count);
  const bool array = plugin && plugin->name().form == slvm::PluginForm::kGridArray;
  std::string text = array ? fmt::format("{}[] {}(", slvm::type_name(param(0).type), name)
                           : fmt::format("{} {}(", slvm::type_name(result()), name);
  for (size_t i = array; i < count; ++i) {
    // What the language writes in brackets behind the name of a texture.
    bool channel = !function && i == 1 && param(i).name == "channel";
    if (channel) {
      text += "[channel]";
      continue;
    }
    if (i > (array ? 1 : 0)) text += ", ";
    text += param_text(param(i));
  }
  if (!function && (signature(*this).variadic() || folds(*this))) text += "...";
  if (!token_set().empty()) text += ", token, value...";
  text += ')';
  if (plugin) text += fmt::format(", of the plug-in {}", plugin->name().library);
  return text;
}

int call_cost(const Candidate& c, const std::vector<Argument>& args) {
  if (!c.takes_count(args.size())) return kImpossible;
  size_t positional = c.positional(args.size());
  int cost = 0;
  for (size_t i = 0; i < positional; ++i) {
    // A plug-in that wants so many elements cannot be given an array whose length is the caller's affair.
    if (c.plugin && c.param(i).array_length > 0 && args[i].array_length == kOpenArray) return kImpossible;
    cost += argument_cost(c.param(i), args[i]);
  }
  for (size_t i = positional; i < args.size(); i += 2)
    cost += argument_cost({.type = Type::kString}, args[i]);
  return cost;
}

// What promoting floats costs to the type that an argument open to floats and to that type has with this
// candidate.
static int promotion(const Candidate& c, const std::vector<Argument>& args) {
  int cost = 0;
  const size_t positional = c.positional(args.size());
  for (size_t i = 0; i < positional; ++i) {
    const Type to = c.param(i).type;
    if (!args[i].types.only(Type::kFloat) || !slvm::is_triple(to)) continue;
    for (size_t k = 0; k < positional; ++k)
      if (args[k].types.has(Type::kFloat) && args[k].types.has(to) && c.param(k).type == to) {
        cost += argument_cost(c.param(i), args[i]);
        break;
      }
  }
  return cost;
}

std::vector<Viable> viable(const std::vector<Candidate>& candidates, const std::vector<Argument>& args) {
  std::vector<Viable> found;
  int best = kImpossible;
  for (const Candidate& c : candidates) {
    Viable v{c, call_cost(c, args), 0};
    if (v.cost >= kImpossible) continue;
    v.promotion = promotion(c, args);
    best = std::min(best, v.cost - v.promotion);
    found.push_back(std::move(v));
  }
  std::erase_if(found, [&](const Viable& v) { return v.cost - v.promotion > best; });
  return found;
}

size_t choose(const std::vector<Viable>& candidates, const std::vector<Argument>& args, Type wanted,
              std::vector<size_t>* tied) {
  auto rank = [&](const Viable& v) {
    int against_context = wanted == Type::kVoid ? 0 : conversion_cost(v.candidate.result(), wanted);
    int unusual = 0; // arguments that could be of another, more usual type
    for (size_t i = 0; i < v.candidate.positional(args.size()); ++i) {
      Param p = v.candidate.param(i);
      unusual += !p.any && args[i].preferred != Type::kVoid && args[i].preferred != p.type;
    }
    return std::tuple(against_context, v.promotion, unusual);
  };
  size_t best = 0;
  for (size_t i = 1; i < candidates.size(); ++i)
    if (rank(candidates[i]) < rank(candidates[best])) best = i;
  if (tied)
    for (size_t i = 0; i < candidates.size(); ++i)
      if (i != best && rank(candidates[i]) == rank(candidates[best])) tied->push_back(i);
  return best;
}

} // namespace slc
