// Values of the walk: how much an expression varies, what is stored where, calls expanded.
#include "slc/sema/context_walk.h"

#include "slc/sema/contexts.h"

namespace slc {

void ContextWalk::need_uniform(Expr* e, std::string_view name, std::string_view callee) {
  if (Variation v = value(e)) complain_of(v.why, Msg::kNeedsUniform, e->range, name, callee);
}

Variation ContextWalk::values(std::vector<ExprPtr>& list) {
  Variation variation;
  for (ExprPtr& e : list)
    variation |= value(e.get());
  return variation;
}

// How much the value varies; notes it in the node.
Variation ContextWalk::value(Expr* e) {
  if (!e || gave_up_) return {};
  Variation variation = value_here(*e);
  if (variation) e->detail = Detail::kVarying;
  return variation;
}

Variation ContextWalk::value_here(Expr& e) {
  switch (e.kind) {
  case ExprKind::kNumber:
  case ExprKind::kString: return {};
  case ExprKind::kVariable: return read(as<VariableExpr>(&e)->variable, e.range);
  case ExprKind::kIndex: {
    Variation index = value(as<IndexExpr>(&e)->index.get());
    return read(as<IndexExpr>(&e)->variable, e.range) | index;
  }
  case ExprKind::kTuple: return values(as<TupleExpr>(&e)->elements);
  case ExprKind::kArrayInit: return values(as<ArrayInitExpr>(&e)->elements);
  case ExprKind::kOperator: return values(as<OperatorExpr>(&e)->operands);
  case ExprKind::kLogical: {
    auto& l = *as<LogicalExpr>(&e);
    Variation left = value(l.left.get());
    Around varying(*this, hard_, condition(l.left.get(), left));
    return left | value(l.right.get());
  }
  case ExprKind::kConditional: {
    auto& c = *as<ConditionalExpr>(&e);
    Variation chosen = value(c.condition.get());
    Around varying(*this, hard_, condition(c.condition.get(), chosen));
    chosen |= value(c.then_value.get());
    return chosen | value(c.else_value.get());
  }
  case ExprKind::kConvert: return value(as<ConvertExpr>(&e)->operand.get());
  case ExprKind::kCast: return value(as<CastExpr>(&e)->operand.get());
  case ExprKind::kCall: return call(*as<CallExpr>(&e));
  case ExprKind::kAssign: return assign(*as<AssignExpr>(&e));
  case ExprKind::kTargetValue: return old_value_;
  }
  return {kVarying, {}};
}

Variation ContextWalk::read(const Variable* v, SourceRange where) {
  if (!v) return {};
  if (v->kind != VariableKind::kGlobal) {
    const VarState& s = state(*v);
    return {s.variation, {Reason::kVariable, where, v->name, s.cause}};
  }
  check_global(*v, false, where);
  if (v->detail == Detail::kUniform) return {};
  return {kVarying, {Reason::kGlobal, where, v->name, nullptr}};
}

void ContextWalk::store(Expr& place, Variation variation, SourceRange where) {
  const Variable* v = nullptr;
  if (auto* name = as<VariableExpr>(&place)) v = name->variable;
  if (auto* element = as<IndexExpr>(&place)) {
    v = element->variable;
    variation |= value(element->index.get());
  }
  if (!v) return;
  if (v->kind == VariableKind::kGlobal) {
    check_global(*v, true, place.range);
    if (v->detail == Detail::kUniform && variation)
      complain_of(variation.why, Msg::kVaryingToUniform, where, v->name);
    return;
  }
  store_variable(state(*v), variation, where, v->name);
  if (state(*v).variation) place.detail = Detail::kVarying;
}

void ContextWalk::store_variable(VarState& s, const Variation& variation, SourceRange where,
                                 std::string_view name) {
  const Variable& v = *s.declared;
  bool some_points = control() > s.hard + s.soft; // only
  const Cause* outermost = some_points ? control_from(s.hard + s.soft) : nullptr;
  Cause cause{Cause::kSet, where, name, variation.why, nullptr};
  if (some_points && variation.degree != kVarying) cause = {Cause::kSetUnder, where, name, {}, outermost};
  if (!always_uniform(v)) return mark(s.variation, s.cause, some_points ? kVarying : variation.degree, cause);
  if (hard_ > s.hard) complain_of({Reason::kNone, {}, "", outermost}, Msg::kUniformUnderVarying, where, name);
  if (variation.degree == kVarying && !some_points && s.variation == kUniform)
    complain_of(variation.why, Msg::kVaryingToUniform, where, name);
  else if ((some_points && v.type != Type::kString) || variation.degree == kSomewhere)
    mark(s.variation, s.cause, kSomewhere, cause);
}

// once: what is computed goes into something uniform, for which random() is drawn once for the grid.
Variation ContextWalk::value_for(Expr* e, bool once) {
  const bool outer = std::exchange(drawing_once_, once);
  Variation variation = value(e);
  drawing_once_ = outer;
  return variation;
}

Variation ContextWalk::assign(AssignExpr& e) {
  const Variable* v = nullptr;
  if (auto* name = as<VariableExpr>(e.target.get())) v = name->variable;
  if (auto* element = as<IndexExpr>(e.target.get())) v = element->variable;
  Variation outer = old_value_;
  if (e.compound) old_value_ = value(e.target.get());
  Variation variation = value_for(e.value.get(), v && always_uniform(*v));
  old_value_ = std::move(outer);
  store(*e.target, variation, e.value->range);
  return variation;
}

Variation ContextWalk::call(CallExpr& e) {
  bool rsl_body = e.shadeop != kNoShadeop || e.plugin;
  if (e.function && !rsl_body) return inlined(e);
  if (rsl_body) return row_call(e);
  return values(e.args);
}

Variation ContextWalk::row_call(CallExpr& e) {
  const slvm::ShadeopInfo& info = e.info();
  const slvm::Signature& signature = info.signature;
  check_row_place(e, info.flags);
  Variation variation;
  const bool once = drawing_once_ && info.name == "random";
  if ((info.flags & slvm::kHiddenVarying) && !once)
    variation = {kVarying, {Reason::kBuiltin, e.range, e.name, nullptr}};
  auto param = [&](size_t i) -> const slvm::SignatureParam& { return signature.param(static_cast<int>(i)); };
  // Surplus formals of an RSL body take token-value pairs.
  size_t count =
      signature.variadic() ? e.args.size() : std::min<size_t>(e.args.size(), signature.param_count);
  for (size_t i = 0; i < e.args.size(); ++i) {
    if (i < count && param(i).output && !param(i).input) continue;
    Variation arg = value(e.args[i].get());
    // A declared uniform that was set at some points is one to a plug-in that sets it.
    const bool own = e.plugin && i < count && param(i).output && arg.degree == kSomewhere;
    if (arg && i < count && param(i).uniform && !own)
      complain_of(arg.why, Msg::kNeedsUniform, e.args[i]->range, param(i).name, e.name);
    bool message = i < count && param(i).output && param(i).any;
    if (!message) variation |= arg;
  }
  for (size_t i = 0; i < count; ++i) {
    if (!param(i).output) continue;
    // What a message brings is as uniform as the variable is declared.
    const auto* place = as<VariableExpr>(e.args[i].get());
    bool uniform_target = (param(i).any || e.plugin) && place && place->variable &&
                          (always_uniform(*place->variable) || place->variable->type == Type::kString);
    Variation brought = variation;
    if (param(i).any) brought = {kVarying, {Reason::kBuiltin, e.range, e.name, nullptr}};
    if (param(i).uniform && !param(i).any) brought = {};
    store(*e.args[i], uniform_target ? Variation() : brought, e.args[i]->range);
  }
  variation |= tokens(e.tokens, variation);
  return signature.uniform_result || signature.result == Type::kVoid ? Variation() : variation;
}

// How much the inputs among the pairs vary; `output`: how much the outputs do.
Variation ContextWalk::tokens(std::vector<TokenArg>& list, const Variation& output) {
  Variation inputs;
  for (TokenArg& t : list) {
    need_uniform(t.token.get(), "token", "token-value pairs");
    if (!t.value) continue;
    if (t.info && t.info->output) {
      store(*t.value, output, t.value->range);
      continue;
    }
    Variation input = value(t.value.get());
    if (input && t.info && t.info->uniform)
      complain_of(input.why, Msg::kTokenUniform, t.value->range, t.info->name);
    inputs |= input;
  }
  return inputs;
}

// A function of the source, expanded here.
Variation ContextWalk::inlined(CallExpr& e) {
  const FunctionDef& f = *e.function;
  if (open_functions_.contains(&f)) return {}; // recursion: an error already
  if (++expansions_ > kMaxInlinedCalls && !here().calls.contains(&e)) {
    gave_up_ = true;
    report(diags_, Msg::kTooManyCalls, shader_.where, shader_.name, kMaxInlinedCalls);
    return {kVarying, {}};
  }
  std::unique_ptr<Instance>& slot = here().calls[&e];
  if (!slot) slot = std::make_unique<Instance>();
  // Actual arguments, in the caller's terms. An output formal is another name of its actual.
  std::vector<std::pair<const Variable*, VarState*>> bindings;
  for (size_t i = 0; i < e.args.size() && i < f.formals.size(); ++i) {
    const Variable& formal = *f.formals[i];
    Expr& arg = *e.args[i];
    Variation variation = value(&arg);
    bool given_varying = formal.detail_given && formal.detail == Detail::kVarying;
    VarState* binding = &slot->variables[&formal];
    const auto* name = as<VariableExpr>(&arg);
    const auto* element = as<IndexExpr>(&arg);
    const Variable* actual = name ? name->variable : element ? element->variable : nullptr;
    if (formal.output && actual) {
      if (actual->kind == VariableKind::kGlobal) check_global(*actual, true, arg.range);
      binding = &state(*actual);
      if (element && variation) store_variable(*binding, variation, arg.range, actual->name);
      if (given_varying) {
        const Cause* declared =
            control_at(&formal, {Cause::kDeclared, formal.where, formal.name, {}, nullptr});
        store_variable(*binding, {kVarying, {Reason::kVariable, arg.range, formal.name, declared}}, arg.range,
                       actual->name);
      }
      slot->aliases[&formal] = {binding, actual->name, arg.range};
    } else {
      binding->declared = &formal;
      if (variation.degree == kVarying && declared_uniform(formal))
        complain_of(variation.why, Msg::kNeedsUniform, arg.range, formal.name, f.name);
      else if (given_varying)
        mark(binding->variation, binding->cause, kVarying,
             {Cause::kDeclared, formal.where, formal.name, {}, nullptr});
      else
        mark(binding->variation, binding->cause, variation.degree,
             {Cause::kGiven, arg.range, formal.name, variation.why, nullptr});
    }
    bindings.push_back({&formal, binding});
  }
  Frame outer = std::exchange(frame_, Frame{slot.get(), &f, control(), {}});
  auto outer_bound = bound_;
  for (auto& [formal, binding] : bindings)
    bound_[formal] = binding;
  open_functions_.insert(&f);
  statement(f.body.get());
  open_functions_.erase(&f);
  bound_ = std::move(outer_bound);
  frame_ = std::move(outer);
  return {slot->result, {Reason::kFunction, e.range, f.name, slot->result_cause}};
}

} // namespace slc
