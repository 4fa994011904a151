// Conversions: which are inserted, which are errors, which are worth a warning.
#include "slc/sema/checker.h"

namespace slc {

// The row of `name` with this result and first parameter.
ShadeopId Checker::row(std::string_view name, Type result, Type param) {
  for (ShadeopId id : slvm::shadeop_overloads(name)) {
    const slvm::Signature& s = slvm::shadeop(id).signature;
    if (s.result == result && s.params[0].type == param) return id;
  }
  return kNoShadeop;
}

Argument Checker::argument(Expr& e) {
  Argument a;
  a.types = set_of(e);
  a.array_length = e.array_length;
  a.place = e.kind == ExprKind::kVariable || e.kind == ExprKind::kIndex;
  if (!a.types.single()) a.preferred = a.types.preferred();
  return a;
}

// "color, float[]".
std::string Checker::types_text(const std::vector<Argument>& args) {
  std::string text;
  for (const Argument& a : args) {
    if (!text.empty()) text += ", ";
    text += slvm::type_name(a.types.preferred());
    if (a.array_length == kOpenArray)
      text += "[]";
    else if (a.array_length > 0)
      text += fmt::format("[{}]", a.array_length);
  }
  return text;
}

void Checker::finish_as(ExprPtr& e, Type to, Purpose purpose) {
  finish(e, to);
  if (set_of(*e).is_error()) return;
  if (e->array_length != kNotArray) {
    report(diags_, Msg::kArrayAsValue, e->range);
    return;
  }
  convert(e, to, purpose);
}

void Checker::convert(ExprPtr& e, Type to, Purpose purpose) {
  Type from = e->type;
  if (from == to) return;
  bool retype = slvm::is_geometric(from) && slvm::is_geometric(to);
  if (purpose.kind == Purpose::kCast) retype = slvm::is_triple(from) && slvm::is_triple(to);
  if (!retype && conversion_cost(from, to) >= kImpossible) {
    std::string_view advice;
    bool mixed =
        (from == Type::kColor && slvm::is_geometric(to)) || (to == Type::kColor && slvm::is_geometric(from));
    if (from == Type::kVoid)
      advice = ": the function returns nothing";
    else if (mixed)
      advice = "; write a cast if the components are meant";
    else if (to == Type::kString && from == Type::kFloat)
      advice = "; format(\"%g\", x) makes a text of a number";
    else if (slvm::is_triple(from) && to == Type::kFloat)
      advice = "; take a component, or length()";
    switch (purpose.kind) {
    case Purpose::kInitialiser:
    case Purpose::kAssignment:
      report(diags_, Msg::kCannotAssign, e->range, slvm::type_name(from), slvm::type_name(to), purpose.name,
             advice);
      break;
    case Purpose::kReturn:
      report(diags_, Msg::kCannotReturn, e->range, slvm::type_name(from), slvm::type_name(to), purpose.name,
             advice);
      break;
    default:
      report(diags_, Msg::kCannotConvert, e->range, slvm::type_name(from), slvm::type_name(to), advice);
    }
    e->type = to;
    return;
  }
  if (retype)
    lint_conversion(*e, to, purpose);
  else if (from == Type::kBool)
    report(diags_, Msg::kRelationAsNumber, e->range);
  else if (to == Type::kBool)
    report(diags_, Msg::kFloatCondition, e->range);
  insert_conversion(e, to);
}

void Checker::insert_conversion(ExprPtr& e, Type to) {
  Type from = e->type;
  bool retype = slvm::is_triple(from) && slvm::is_triple(to);
  auto conversion = std::make_unique<ConvertExpr>(e->range);
  conversion->shadeop = retype ? kNoShadeop : row("convert", to, from);
  conversion->operand = std::move(e);
  conversion->type = to;
  e = std::move(conversion);
}

// Points are places, vectors and normals are directions: mixing them in declarations and arguments is often a
// slip. Results of operators and functions are not held to that.
void Checker::lint_conversion(const Expr& e, Type to, Purpose purpose) {
  bool place = e.kind == ExprKind::kVariable || e.kind == ExprKind::kIndex;
  bool point = (e.type == Type::kPoint) != (to == Type::kPoint);
  if (!place || !point || in_library_) return;
  if (purpose.kind == Purpose::kInitialiser || purpose.kind == Purpose::kAssignment ||
      purpose.kind == Purpose::kArgument)
    report(diags_, Msg::kPointLint, e.range, slvm::type_name(e.type), slvm::type_name(to));
}

} // namespace slc
