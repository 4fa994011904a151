// Expressions and assignments.
#include "slc/lower/lowering.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace slc {

slvm::ir::ValueId Lowering::value(const Expr& e) {
  SourceRange outer = b_.where;
  if (e.range.valid()) b_.where = e.range;
  ValueId v = ir::kNoValue;
  switch (e.kind) {
  case ExprKind::kNumber: v = b_.number(static_cast<const NumberExpr&>(e).value); break;
  case ExprKind::kString: v = b_.string(static_cast<const StringExpr&>(e).value); break;
  case ExprKind::kVariable: v = variable_value(static_cast<const VariableExpr&>(e)); break;
  case ExprKind::kIndex: v = load(place(e)); break;
  case ExprKind::kTuple: {
    const auto& t = static_cast<const TupleExpr&>(e);
    Values args;
    for (const ExprPtr& element : t.elements)
      args.push_back(value(*element));
    v = call_row(t.shadeop, std::move(args));
    break;
  }
  case ExprKind::kOperator: {
    const auto& o = static_cast<const OperatorExpr&>(e);
    Values args;
    for (const ExprPtr& operand : o.operands)
      args.push_back(value(*operand));
    v = call_row(o.shadeop, std::move(args));
    break;
  }
  case ExprKind::kLogical: v = logical(static_cast<const LogicalExpr&>(e)); break;
  case ExprKind::kConditional: v = conditional(static_cast<const ConditionalExpr&>(e)); break;
  case ExprKind::kConvert: {
    const auto& c = static_cast<const ConvertExpr&>(e);
    ValueId operand = value(*c.operand);
    v = c.shadeop == kNoShadeop ? b_.retype(c.type, operand) : call_row(c.shadeop, {operand});
    break;
  }
  case ExprKind::kCall: v = call(static_cast<const CallExpr&>(e)); break;
  case ExprKind::kAssign: v = assignment(static_cast<const AssignExpr&>(e)); break;
  case ExprKind::kTargetValue: v = targets_.back(); break;
  case ExprKind::kCast:
  case ExprKind::kArrayInit: assert(false && "gone after semantic analysis"); break;
  }
  b_.where = outer;
  return v;
}

slvm::ir::ValueId Lowering::call_row(ShadeopId row, std::vector<ValueId> args) {
  Type result = slvm::shadeop(row).signature.result;
  return b_.call(row, args, std::span(&result, 1))[0];
}

slvm::ir::ValueId Lowering::variable_value(const VariableExpr& e) {
  return e.array_length == kNotArray ? read(*e.variable) : b_.array(array_of(*e.variable));
}

// The right side runs only in lanes that need it. When it only computes, running it everywhere is the same
// and cheaper.
slvm::ir::ValueId Lowering::logical(const LogicalExpr& e) {
  ValueId left = value(*e.left);
  Values before = values_;
  ValueId right = ir::kNoValue;
  ir::Region side = region([&] { right = value(*e.right); });
  bool pure = values_ == before && std::all_of(side.body.begin(), side.body.end(), [&](ir::InstId id) {
                return m_.insts[id].regions.empty() && ir::effect_of(m_, m_.insts[id]) == ir::Effect::kNone;
              });
  if (pure) {
    ir::Region* here = b_.region();
    here->body.insert(here->body.end(), side.body.begin(), side.body.end());
    return b_.call(e.is_and ? "operator&&" : "operator||", "bool(bool a, bool b)", {left, right});
  }
  values_ = before;
  float yes = 0;
  uint32_t bits = ~0u;
  static_assert(sizeof bits == sizeof yes);
  std::memcpy(&yes, &bits, sizeof yes);
  auto known = [&] { return b_.constant({Type::kBool, {e.is_and ? 0.0f : yes}, {}}); };
  auto run = [&] { return value(*e.right); };
  return e.is_and ? branch(left, Type::kBool, run, known) : branch(left, Type::kBool, known, run);
}

slvm::ir::ValueId Lowering::conditional(const ConditionalExpr& e) {
  ValueId condition = value(*e.condition);
  return branch(
      condition, e.type, [&] { return value(*e.then_value); }, [&] { return value(*e.else_value); });
}

// ---- Places.

Lowering::Place Lowering::place(const Expr& e) {
  Place p;
  if (const auto* v = as<VariableExpr>(&e)) {
    p.variable = v->variable;
    p.whole_array = v->array_length != kNotArray;
  } else {
    const auto& i = static_cast<const IndexExpr&>(e);
    p.variable = i.variable;
    p.element = true;
    p.component = i.variable->array_length == kNotArray;
    p.subscript = value(*i.index);
  }
  return p;
}

namespace {

/// The row of comp() or setcomp() for this type.
ShadeopId component_row(std::string_view function, Type type) {
  for (ShadeopId id : slvm::shadeop_overloads(function))
    if (slvm::shadeop(id).signature.params[0].type == type) return id;
  assert(false && "every triple has its rows");
  return kNoShadeop;
}

} // namespace

slvm::ir::ValueId Lowering::load(const Place& p) {
  if (p.whole_array) return b_.array(array_of(*p.variable));
  if (p.component) return call_row(component_row("comp", p.variable->type), {read(*p.variable), p.subscript});
  return p.element ? b_.array_load(array_of(*p.variable), p.subscript) : read(*p.variable);
}

void Lowering::store(const Place& p, ValueId value) {
  if (p.whole_array) return; // the call stored into the array itself
  if (!p.element) {
    write(*p.variable, value);
    return;
  }
  if (p.component) {
    const Values args{read(*p.variable), p.subscript, value};
    write(*p.variable,
          b_.call(component_row("setcomp", p.variable->type), args, std::span(&p.variable->type, 1))[0]);
    return;
  }
  uint32_t array = array_of(*p.variable);
  if (m_.arrays[array].slot >= 0) m_.slots[static_cast<size_t>(m_.arrays[array].slot)].stored = true;
  b_.array_store(array, p.subscript, value);
}

slvm::ir::ValueId Lowering::assignment(const AssignExpr& e) {
  Place target = place(*e.target);
  if (target.whole_array) {
    if (const auto* call = as<CallExpr>(e.value.get())) // which stores to it
      return value(*call);
    array_assignment(array_of(*target.variable), *e.value);
    return ir::kNoValue;
  }
  bool outer = std::exchange(uniform_wanted_,
                             target.variable->detail_given && target.variable->detail == Detail::kUniform);
  if (e.compound) targets_.push_back(load(target));
  ValueId v = value(*e.value);
  if (e.compound) targets_.pop_back();
  uniform_wanted_ = outer;
  store(target, v);
  return v;
}

// `{a, b, c}`: the rest of the array is zero.
void Lowering::array_assignment(uint32_t array, const Expr& init) {
  if (m_.arrays[array].slot >= 0) m_.slots[static_cast<size_t>(m_.arrays[array].slot)].stored = true;
  const auto& list = static_cast<const ArrayInitExpr&>(init);
  Values elements;
  for (const ExprPtr& e : list.elements)
    elements.push_back(value(*e));
  if (elements.size() < m_.arrays[array].elements) b_.array_clear(array);
  for (size_t i = 0; i < elements.size(); ++i)
    b_.array_store(array, b_.number(static_cast<float>(i)), elements[i]);
}

} // namespace slc
