// Names, operators, tuples, assignments and casts. Calls are in calls.cpp.
#include "slc/parse/foreign.h"
#include "slc/sema/checker.h"
#include "slc/sema/hints.h"

namespace slc {

TypeSet Checker::set_of(const Expr& e) const {
  auto it = sets_.find(&e);
  return it == sets_.end() ? TypeSet(e.type) : it->second;
}

TypeSet Checker::analyse(Expr& e) {
  TypeSet types = analyse_here(e);
  sets_[&e] = types;
  return types;
}

TypeSet Checker::analyse_here(Expr& e) {
  switch (e.kind) {
  case ExprKind::kNumber: return as<NumberExpr>(&e)->broken ? TypeSet::error() : TypeSet(Type::kFloat);
  case ExprKind::kString: return Type::kString;
  case ExprKind::kVariable: return analyse_name(*as<VariableExpr>(&e));
  case ExprKind::kIndex: return analyse_index(*as<IndexExpr>(&e));
  case ExprKind::kTuple: {
    auto& tuple = *as<TupleExpr>(&e);
    for (ExprPtr& element : tuple.elements)
      analyse(*element);
    if (tuple.elements.size() != 3 && tuple.elements.size() != 16)
      return TypeSet::error(); // reported by the parser
    return tuple.elements.size() == 16 ? TypeSet(Type::kMatrix) : TypeSet::triples();
  }
  case ExprKind::kArrayInit: report(diags_, Msg::kMisplacedArrayInit, e.range); return TypeSet::error();
  case ExprKind::kOperator: return analyse_operator(*as<OperatorExpr>(&e));
  case ExprKind::kLogical:
    analyse(*as<LogicalExpr>(&e)->left);
    analyse(*as<LogicalExpr>(&e)->right);
    return Type::kBool;
  case ExprKind::kConditional: return analyse_conditional(*as<ConditionalExpr>(&e));
  case ExprKind::kCast: {
    TypeSet operand = analyse(*as<CastExpr>(&e)->operand);
    return operand.is_error() ? operand : TypeSet(as<CastExpr>(&e)->target);
  }
  case ExprKind::kCall: return analyse_call(*as<CallExpr>(&e));
  case ExprKind::kAssign: return analyse_assign(*as<AssignExpr>(&e));
  case ExprKind::kConvert:
  case ExprKind::kTargetValue: return e.type;
  }
  return TypeSet::error();
}

void Checker::report_unknown_variable(std::string_view name, SourceRange where) {
  if (unit_.misdeclared.contains(name)) return; // what is wrong with it was said where it is declared
  std::vector<std::string_view> names = scopes_.visible_variables();
  for (int g = 0; g < slvm::kGlobalCount && !scopes_.in_function(); ++g)
    names.push_back(slvm::global_info(static_cast<Global>(g)).name);
  std::string_view near = slvm::nearest_name(name, names);
  bool function = !slvm::shadeop_overloads(name).empty() || !scopes_.functions(name).empty();
  if (std::string_view advice = variable_hint(name); !advice.empty() || function) {
    if (function) advice = "it is a function, whose arguments stand in parentheses";
    report(diags_, Msg::kUnknownVariableHint, where, name, advice);
  } else if (!near.empty()) {
    report(diags_, Msg::kUnknownVariableNear, where, name, near).fixits.push_back({where, std::string(near)});
  } else {
    slvm::Diagnostic& d = report(diags_, Msg::kUnknownVariable, where, name);
    for (const Shader& shader : unit_.shaders)
      for (const Variable* v : shader.params)
        if (v->name == name && scopes_.in_function() && d.notes.empty())
          d.notes.push_back({v->where, fmt::format("a parameter of shader '{}' has this name: hand it to the "
                                                   "function as an argument",
                                                   shader.name)});
  }
}

// The variable a name means here; null after an error.
Variable* Checker::resolve(std::string_view name, SourceRange where) {
  if (Variable* found = scopes_.find(name)) return found;
  Global global = slvm::find_global(name);
  Variable* hidden = scopes_.in_function() ? scopes_.find_outside(name) : nullptr;
  if (global != Global::kCount && !hidden) {
    hidden = global_variable(global);
    // A light loop brings its own variables, in functions too.
    bool of_light = global == Global::kL || global == Global::kCl || global == Global::kOl;
    if (!scopes_.in_function() || (of_light && light_loops_ > 0)) return hidden;
  }
  if (!hidden) {
    report_unknown_variable(name, where);
    return nullptr;
  }
  bool predefined = hidden == (global == Global::kCount ? nullptr : global_variable(global));
  report(diags_, predefined ? Msg::kGlobalWithoutExtern : Msg::kNeedsExtern, where, name,
         slvm::type_name(hidden->type));
  scopes_.declare(name, hidden); // once is enough
  return hidden;
}

TypeSet Checker::analyse_name(VariableExpr& e) {
  if (e.name == "PI" && !scopes_.find("PI")) return Type::kFloat; // finish() makes it a number
  e.variable = resolve(e.name, e.range);
  if (!e.variable) return TypeSet::error();
  e.array_length = e.variable->array_length;
  return e.variable->type;
}

// An element of an array, or a component: comp(P, i) and setcomp(P, i, x) as PRMan 13 writes them.
TypeSet Checker::analyse_index(IndexExpr& e) {
  analyse(*e.index);
  e.variable = resolve(e.name, e.range);
  if (!e.variable) return TypeSet::error();
  const bool component = e.variable->array_length == kNotArray;
  if (component && !slvm::is_triple(e.variable->type)) {
    bool matrix = e.variable->type == Type::kMatrix;
    report(diags_, Msg::kNotAnArray, e.range, e.name,
           matrix ? fmt::format("; its elements are comp({}, row, column)", e.name) : std::string());
    return TypeSet::error();
  }
  const int length = component ? 3 : e.variable->array_length;
  float index = 0;
  if (length > 0 && constant_value(*e.index, index) && (index < 0 || index >= static_cast<float>(length)))
    report(diags_, Msg::kIndexRange, e.range, index, e.name, length);
  return component ? Type::kFloat : e.variable->type;
}

// `N.y`, where there is no variable y: reported.
bool Checker::is_member(const OperatorExpr& e) {
  const auto* object = as<VariableExpr>(e.operands[0].get());
  const auto* member = e.op == Operator::kDot ? as<VariableExpr>(e.operands[1].get()) : nullptr;
  if (!object || !member || scopes_.find(member->name) || scopes_.find_outside(member->name) ||
      slvm::find_global(member->name) != Global::kCount || unit_.misdeclared.contains(member->name))
    return false;
  if (unit_.misdeclared.contains(object->name)) return true; // reported
  std::string advice = member_advice(object->name, member->name, false);
  if (advice.empty()) return false;
  report(diags_, Msg::kMember, e.range, advice);
  return true;
}

TypeSet Checker::analyse_operator(OperatorExpr& e) {
  if (is_member(e)) return TypeSet::error();
  Resolution resolution;
  bool error = false;
  for (ExprPtr& operand : e.operands) {
    error |= analyse(*operand).is_error();
    resolution.args.push_back(argument(*operand));
  }
  if (error) return TypeSet::error();
  std::vector<Argument>& args = resolution.args;
  if (args.size() == 2) {
    // The other operand chooses where nothing else does: a color makes an overloaded call a color, a point,
    // vector or normal is scaled by a float, and a promoted float takes the type of what it is combined with.
    bool scales = e.op == Operator::kMul || e.op == Operator::kDiv;
    for (size_t i = 0; i < 2; ++i) {
      TypeSet own = args[i].types, other = args[1 - i].types;
      bool color = other.only(Type::kColor) && own.has(Type::kColor);
      if (color || (own.only(Type::kFloat) && other.single())) args[i].preferred = other.preferred();
      if (scales && own.has(Type::kFloat) && other.single() && slvm::is_geometric(other.preferred()))
        args[i].types = Type::kFloat;
    }
  }
  // Floats are promoted for sums and products, but the dot and cross product of a float mean nothing.
  bool product = e.op == Operator::kDot || e.op == Operator::kCross;
  bool has_float =
      std::any_of(args.begin(), args.end(), [](const Argument& a) { return a.types.only(Type::kFloat); });
  std::vector<Candidate> rows;
  for (ShadeopId id : slvm::shadeop_overloads(fmt::format("operator{}", operator_text(e.op))))
    if (!product || !has_float) rows.push_back({nullptr, id});
  resolution.viable = viable(rows, args);
  if (resolution.viable.empty()) {
    report_bad_operands(e, args);
    return TypeSet::error();
  }
  TypeSet types;
  for (const Viable& v : resolution.viable)
    types.add(v.candidate.result());
  resolutions_[&e] = std::move(resolution);
  return types;
}

void Checker::report_bad_operands(const OperatorExpr& e, const std::vector<Argument>& args) {
  auto any = [&](auto&& test) { return std::any_of(args.begin(), args.end(), test); };
  bool color = any([](const Argument& a) { return a.types.only(Type::kColor); });
  bool geometric =
      any([](const Argument& a) { return a.types.single() && slvm::is_geometric(a.types.preferred()); });
  bool string = any([](const Argument& a) { return a.types.only(Type::kString); });
  bool array = any([](const Argument& a) { return a.array_length != kNotArray; });
  bool vectors =
      !any([](const Argument& a) { return !a.types.single() || !slvm::is_geometric(a.types.preferred()); });
  bool matrix = any([](const Argument& a) { return a.types.only(Type::kMatrix); });
  std::string_view advice;
  if (array)
    advice = "; arrays are used element by element";
  else if (color && geometric)
    advice = "; cast one of them: colors and points do not mix";
  else if (string)
    advice = "; strings can only be compared with == and !=, and joined with concat()";
  else if (e.op == Operator::kNot)
    advice = "; compare it with something";
  else if (matrix && geometric)
    advice = "; write transform(m, p), vtransform(m, v) or ntransform(m, n)";
  else if (matrix)
    advice = "; matrices are multiplied, divided and compared";
  else if (e.op == Operator::kCross && !vectors)
    advice = "; '^' is the cross product of vectors: for a power write pow(x, y)";
  else if (e.op == Operator::kDot && !vectors)
    advice = "; '.' is the dot product of vectors or colors";
  report(diags_, Msg::kBadOperands, e.range, operator_text(e.op), types_text(args), advice);
}

TypeSet Checker::analyse_conditional(ConditionalExpr& e) {
  analyse(*e.condition);
  bool error = analyse(*e.then_value).is_error();
  error |= analyse(*e.else_value).is_error();
  if (error) return TypeSet::error();
  Resolution resolution;
  Argument condition;
  condition.types = Type::kBool;
  resolution.args = {condition, argument(*e.then_value), argument(*e.else_value)};
  std::vector<Candidate> rows;
  for (ShadeopId id : slvm::shadeop_overloads("operator?:"))
    rows.push_back({nullptr, id});
  resolution.viable = viable(rows, resolution.args);
  if (resolution.viable.empty()) {
    report(diags_, Msg::kBadBranches, e.range, types_text({resolution.args[1], resolution.args[2]}));
    return TypeSet::error();
  }
  TypeSet types;
  for (const Viable& v : resolution.viable)
    types.add(v.candidate.result());
  resolutions_[&e] = std::move(resolution);
  return types;
}

// Compilers of the time let shaders change their parameters, and functions their formals: a copy is changed,
// which no caller sees. Not so arrays of functions, which are the caller's own.
bool Checker::check_writable(Variable& v, SourceRange where) {
  if (v.output || v.kind == VariableKind::kLocal || v.kind == VariableKind::kGlobal) return true;
  if (v.kind == VariableKind::kFormal && v.array_length != kNotArray) {
    report(diags_, Msg::kReadOnlyArray, where, v.name);
    return false;
  }
  if (!std::exchange(v.copied, true))
    report(diags_, v.kind == VariableKind::kParameter ? Msg::kReadOnlyParameter : Msg::kReadOnlyFormal, where,
           v.name);
  return true;
}

TypeSet Checker::analyse_assign(AssignExpr& e) {
  Variable* v = nullptr;
  TypeSet target;
  if (auto* name = as<VariableExpr>(e.target.get())) {
    if (name->name == "PI" && !scopes_.find("PI")) {
      report(diags_, Msg::kNotAssignable, name->range);
      return TypeSet::error();
    }
    v = name->variable = resolve(name->name, name->range);
    if (v) name->array_length = v->array_length;
    target = v ? TypeSet(v->type) : TypeSet::error();
  } else {
    auto& element = *as<IndexExpr>(e.target.get());
    target = analyse_index(element);
    v = element.variable;
  }
  sets_[e.target.get()] = target;
  // What is stored.
  bool list = e.value->kind == ExprKind::kArrayInit;
  const bool filled =
      v && e.target->array_length != kNotArray && !e.compound && fill_array(e.value.get(), v->name);
  if (v && e.target->array_length != kNotArray && !list && !filled)
    report(diags_, Msg::kArrayAssigned, e.range, v->name), target = TypeSet::error();
  if (e.compound && !target.is_error()) {
    auto combined = std::make_unique<OperatorExpr>(e.range);
    combined->op = e.op;
    auto old = std::make_unique<TargetValueExpr>(e.target->range);
    old->type = target.preferred();
    combined->operands.push_back(std::move(old));
    combined->operands.push_back(std::move(e.value));
    e.value = std::move(combined);
  }
  if (list && v && e.target->array_length != kNotArray) {
    finish_array_init(*as<ArrayInitExpr>(e.value.get()), *v);
  } else {
    analyse(*e.value);
  }
  if (v) check_writable(*v, e.target->range);
  return target;
}

// A place of known type: only an index has something to pick.
void Checker::finish_place(ExprPtr& e) {
  e->type = set_of(*e).preferred();
  if (auto* element = as<IndexExpr>(e.get())) finish_as(element->index, Type::kFloat, {Purpose::kIndex, ""});
}

// Picks types from here down. `wanted` is what the context would like; kVoid: anything.
void Checker::finish(ExprPtr& e, Type wanted) {
  TypeSet types = set_of(*e);
  if (types.is_error()) {
    e->type = wanted == Type::kVoid ? Type::kFloat : wanted;
    return;
  }
  switch (e->kind) {
  case ExprKind::kVariable:
    if (!as<VariableExpr>(e.get())->variable) {
      auto pi = std::make_unique<NumberExpr>(e->range);
      pi->value = 3.14159265358979323846f;
      pi->type = Type::kFloat;
      replace(e, std::move(pi));
      return;
    }
    usage_.read(*as<VariableExpr>(e.get())->variable, e->range);
    break;
  case ExprKind::kIndex:
    usage_.read(*as<IndexExpr>(e.get())->variable, e->range);
    finish_place(e);
    return;
  case ExprKind::kTuple: return finish_tuple(*as<TupleExpr>(e.get()), wanted);
  case ExprKind::kOperator: return finish_operator(*as<OperatorExpr>(e.get()), wanted);
  case ExprKind::kLogical: {
    auto& logical = *as<LogicalExpr>(e.get());
    finish_condition(logical.left);
    finish_condition(logical.right);
    break;
  }
  case ExprKind::kConditional: return finish_conditional(*as<ConditionalExpr>(e.get()), wanted);
  case ExprKind::kCast: return finish_cast(e);
  case ExprKind::kCall: return finish_call(e, wanted);
  case ExprKind::kAssign: finish_assign(*as<AssignExpr>(e.get())); break;
  default: break;
  }
  e->type = types.preferred();
}

void Checker::finish_tuple(TupleExpr& e, Type wanted) {
  bool matrix = e.elements.size() == 16;
  e.type = matrix ? Type::kMatrix : slvm::is_triple(wanted) ? wanted : Type::kPoint;
  for (ExprPtr& element : e.elements)
    finish_as(element, Type::kFloat, {Purpose::kElement, ""});
  e.shadeop = row(matrix ? "sixteen" : "triple", e.type, Type::kFloat);
}

void Checker::finish_operator(OperatorExpr& e, Type wanted) {
  const Resolution& r = resolutions_.at(&e);
  Candidate chosen = r.viable[choose(r.viable, r.args, wanted)].candidate;
  e.shadeop = chosen.row;
  e.type = chosen.result();
  if (is_chained(e)) return;
  for (size_t i = 0; i < e.operands.size(); ++i)
    finish_as(e.operands[i], chosen.param(i).type, {Purpose::kOperand, operator_text(e.op)});
  if (e.op == Operator::kAdd && chosen.param(0).type == Type::kPoint &&
      chosen.param(1).type == Type::kPoint && e.operands[0]->kind != ExprKind::kConvert &&
      e.operands[1]->kind != ExprKind::kConvert)
    report(diags_, Msg::kPointSum, e.range);
}

// `0 < x < 1`: reported, and finished.
bool Checker::is_chained(OperatorExpr& e) {
  bool relation = e.op >= Operator::kLess && e.op <= Operator::kGreaterEqual;
  const auto* inner = relation ? as<OperatorExpr>(e.operands[0].get()) : nullptr;
  if (!inner || inner->op < Operator::kLess || inner->op > Operator::kGreaterEqual) return false;
  report(diags_, Msg::kChainedRelation, e.range, fmt::format("a {} b", operator_text(inner->op)),
         fmt::format("b {} c", operator_text(e.op)));
  finish(e.operands[0], Type::kBool);
  insert_conversion(e.operands[0], Type::kFloat);
  finish_as(e.operands[1], Type::kFloat, {Purpose::kOperand, operator_text(e.op)});
  return true;
}

void Checker::finish_conditional(ConditionalExpr& e, Type wanted) {
  check_condition(e.condition);
  const Resolution& r = resolutions_.at(&e);
  Candidate chosen = r.viable[choose(r.viable, r.args, wanted)].candidate;
  e.type = chosen.result();
  finish_as(e.then_value, e.type, {Purpose::kOperand, "?:"});
  finish_as(e.else_value, e.type, {Purpose::kOperand, "?:"});
}

void Checker::finish_assign(AssignExpr& e) {
  const Variable* v = e.target->kind == ExprKind::kVariable ? as<VariableExpr>(e.target.get())->variable
                                                            : as<IndexExpr>(e.target.get())->variable;
  finish_place(e.target);
  if (e.compound) usage_.read(*v, e.target->range);
  const auto* call = as<CallExpr>(e.value.get());
  if (call && call->fills_array)
    finish(e.value, Type::kVoid);
  else if (e.value->kind != ExprKind::kArrayInit)
    finish_as(e.value, v->type, {Purpose::kAssignment, v->name});
  usage_.written(*v);
  if (e.target->kind == ExprKind::kVariable) spaces_[v] = e.compound ? "" : space_of(*e.value);
}

void Checker::finish_array_init(ArrayInitExpr& e, const Variable& v) {
  e.type = v.type;
  e.array_length = v.array_length;
  if (v.array_length == kNotArray)
    report(diags_, Msg::kArrayInitForValue, e.range, v.name);
  else if (e.elements.size() > static_cast<size_t>(v.array_length))
    report(diags_, Msg::kTooManyElements, e.range, e.elements.size(), v.name, v.array_length);
  for (ExprPtr& element : e.elements) {
    analyse(*element);
    finish_as(element, v.type, {Purpose::kElement, v.name});
  }
}

// A cast picks the operand's type where it can; what remains is a conversion, or a change of space.
void Checker::finish_cast(ExprPtr& e) {
  auto& cast = *as<CastExpr>(e.get());
  Type target = cast.target;
  if (cast.operand->array_length != kNotArray)
    return report(diags_, Msg::kCastArray, cast.range), void(e->type = target);
  finish(cast.operand, target);
  Type from = cast.operand->type;
  bool possible =
      conversion_cost(from, target) < kImpossible || (slvm::is_triple(from) && slvm::is_triple(target));
  if (!possible || from == Type::kVoid) {
    report(diags_, Msg::kBadCast, cast.range, slvm::type_name(from), slvm::type_name(target));
    e->type = target;
    return;
  }
  convert(cast.operand, target, {Purpose::kCast, ""});
  if (!cast.has_space) {
    ExprPtr operand_expr = std::move(cast.operand);
    operand_expr->range = cast.range;
    replace(e, std::move(operand_expr));
    return;
  }
  if (target == Type::kFloat) return report(diags_, Msg::kCastSpace, cast.range), void(e->type = target);
  replace(e, space_cast(cast));
}

// point "world" x: transform("world", "current", x), and so on.
ExprPtr Checker::space_cast(CastExpr& cast) {
  auto string = [&](std::string_view text) {
    auto s = std::make_unique<StringExpr>(cast.range);
    s->value = text;
    s->type = Type::kString;
    return s;
  };
  auto call = std::make_unique<CallExpr>(cast.range);
  call->name_range = cast.range;
  call->args.push_back(string(cast.space));
  bool color = cast.target == Type::kColor;
  if (color)
    check_colour_space(*call->args[0]);
  else
    check_space(*call->args[0]);
  call->args.push_back(string(color ? "rgb" : "current"));
  if (cast.target == Type::kMatrix) {
    call->name = "spacematrix";
    call->shadeop = slvm::shadeop_overloads(call->name)[0];
    call->type = Type::kMatrix;
    auto product = std::make_unique<OperatorExpr>(cast.range);
    product->op = Operator::kMul;
    product->shadeop = row("operator*", Type::kMatrix, Type::kMatrix);
    product->type = Type::kMatrix;
    product->operands.push_back(std::move(call));
    product->operands.push_back(std::move(cast.operand));
    return product;
  }
  call->name = color                          ? "ctransform"
               : cast.target == Type::kPoint  ? "transform"
               : cast.target == Type::kVector ? "vtransform"
                                              : "ntransform";
  call->args.push_back(std::move(cast.operand));
  call->type = cast.target;
  for (ShadeopId id : slvm::shadeop_overloads(call->name)) {
    const slvm::Signature& s = slvm::shadeop(id).signature;
    if (s.param_count == 3 && s.params[1].type == Type::kString && s.params[2].type == cast.target)
      call->shadeop = id;
  }
  use_library_body(*call);
  return call;
}

} // namespace slc
