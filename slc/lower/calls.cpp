// Calls: functions are inlined, built-ins become call instructions.
#include "slc/lower/lowering.h"

#include <algorithm>
#include <cassert>

namespace slc {

slvm::ir::ValueId Lowering::call(const CallExpr& e) {
  if (e.shadeop != kNoShadeop || e.plugin) note_call(called(e));
  return e.function ? inline_function(e) : builtin_call(e);
}

// The compiler lets a unit name no more of them than fit.
ShadeopId Lowering::called(const CallExpr& e) {
  return e.plugin ? m_.plugins.add(e.plugin).value_or(kNoShadeop) : e.shadeop;
}

// What bodies of built-ins call is no call of the source. A function inlined twice calls in one place all the
// same.
void Lowering::note_call(ShadeopId row) {
  if (library_depth_ > 0 || m_.plugins.info(row).flags & slvm::kInternal) return;
  slvm::SourceCall call{row, b_.where.file, b_.where.line, b_.where.column};
  if (std::find(calls_.begin(), calls_.end(), call) == calls_.end()) calls_.push_back(call);
}

// Formals are variables of their own: output ones are copied back afterwards, which no RSL program can tell
// from passing by reference unless it passes one variable twice. Lights that ask for an output parameter
// meanwhile get the formal's value (store_changed).
slvm::ir::ValueId Lowering::inline_function(const CallExpr& e) {
  const FunctionDef& f = *e.function;
  size_t declared_from = declared_.size();
  std::vector<Place> places(f.formals.size());
  std::vector<ValueId> actuals(f.formals.size(), ir::kNoValue);
  for (size_t i = 0; i < f.formals.size(); ++i) {
    const Variable& formal = *f.formals[i];
    const Expr& actual = i < e.args.size() ? *e.args[i] : *formal.init; // an absent token's value
    if (formal.array_length != kNotArray) {
      arrays_[&formal] = array_of(*static_cast<const VariableExpr&>(actual).variable);
    } else if (formal.output) {
      places[i] = place(actual);
      actuals[i] = load(places[i]);
    } else {
      actuals[i] = value(actual);
    }
  }
  for (size_t i = 0; i < f.formals.size(); ++i) {
    if (f.formals[i]->array_length != kNotArray) continue;
    declared_.push_back(index_of(*f.formals[i]));
    write(*f.formals[i], actuals[i]);
  }
  size_t result = f.result == Type::kVoid ? 0 : new_index(f.result);
  if (result) {
    declared_.push_back(result);
    values_[result] = zero(f.result);
  }
  const size_t lent_from = lent_.size();
  for (size_t i = 0; i < f.formals.size(); ++i)
    if (places[i].variable && !places[i].element && !places[i].whole_array)
      lent_.emplace_back(index_of(*places[i].variable), index_of(*f.formals[i]));
  library_depth_ += e.shadeop != kNoShadeop;
  function_body(*f.body, result);
  library_depth_ -= e.shadeop != kNoShadeop;
  lent_.resize(lent_from);
  values_.resize(variable_types_.size(), ir::kNoValue);
  ValueId out = result ? values_[result] : ir::kNoValue;
  std::vector<ValueId> stored(f.formals.size(), ir::kNoValue);
  for (size_t i = 0; i < f.formals.size(); ++i)
    if (places[i].variable) stored[i] = read(*f.formals[i]);
  forget(declared_from);
  for (size_t i = 0; i < f.formals.size(); ++i)
    if (places[i].variable) store(places[i], stored[i]);
  return out;
}

// Counts the calls that must not give the same as each other: random() and what shoots rays.
slvm::ir::ValueId Lowering::next_count() {
  const ValueId count = values_[random_counter_];
  values_[random_counter_] = b_.call("operator+", "float(float a, float b)", {count, b_.number(1)});
  return count;
}

// Where the rays of a call go depends on how many calls there were before, too.
void Lowering::add_seed(Values& args) {
  args.push_back(b_.string(":call"));
  args.push_back(next_count());
}

// random() has no arguments: its values come from a counter, so that they depend on nothing but place and
// program.
slvm::ir::ValueId Lowering::random_call(const CallExpr& e, const slvm::ShadeopInfo& info) {
  const ValueId count = next_count();
  bool uniform = uniform_wanted_ || info.name == "randomgrid";
  for (ShadeopId id : slvm::shadeop_overloads(uniform ? "randomuniform" : "randomvarying"))
    if (slvm::shadeop(id).signature.result == e.type) return call_row(id, {count});
  assert(false && "every type random() gives has its rows");
  return zero(e.type);
}

slvm::ir::ValueId Lowering::builtin_call(const CallExpr& e) {
  const slvm::ShadeopInfo& info = e.info();
  if (info.name == "random" || info.name == "randomgrid") return random_call(e, info);
  if (info.flags & slvm::kLights) store_changed(true);
  const slvm::Signature& signature = info.signature;
  std::vector<Place> places;
  Values args;
  std::vector<Type> result_types;
  if (signature.result != Type::kVoid) result_types.push_back(signature.result);
  for (size_t i = 0; i < e.args.size(); ++i) {
    const slvm::SignatureParam& param = signature.param(static_cast<int>(i));
    if (!param.output) {
      args.push_back(value(*e.args[i]));
      continue;
    }
    places.push_back(place(*e.args[i]));
    result_types.push_back(e.args[i]->type);
    if (param.input) args.push_back(load(places.back()));
  }
  for (const TokenArg& t : e.tokens) {
    args.push_back(value(*t.token));
    if (info.flags & slvm::kTokenOut && t.info && t.info->output) {
      places.push_back(place(*t.value));
      result_types.push_back(t.value->type);
      args.push_back(load(places.back()));
    } else {
      args.push_back(value(*t.value));
    }
  }
  if (info.flags & slvm::kRays && !signature.token_set.empty()) add_seed(args);
  return call_into(called(e), args, result_types, places);
}

slvm::ir::ValueId Lowering::call_into(ShadeopId id, const Values& args, const std::vector<Type>& result_types,
                                      const std::vector<Place>& places) {
  std::vector<ValueId> results = b_.call(id, args, result_types);
  const bool has_result = m_.plugins.info(id).signature.result != Type::kVoid;
  size_t next = has_result;
  for (const Place& p : places) {
    if (p.whole_array) {
      uint32_t array = array_of(*p.variable);
      m_.values[results[next]].array = static_cast<int32_t>(array);
      if (m_.arrays[array].slot >= 0) m_.slots[static_cast<size_t>(m_.arrays[array].slot)].stored = true;
    }
    store(p, results[next++]);
  }
  return has_result ? results[0] : ir::kNoValue;
}

} // namespace slc
