// Statements of the walk: control that some points have left, and what varies under it.
#include "slc/sema/context_walk.h"

namespace slc {

void ContextWalk::walk_shader() {
  frame_ = {&root_, nullptr, 0, {}};
  bound_.clear();
  hard_ = soft_ = illuminance_ = emission_ = 0;
  controls_.clear();
  for (Variable* v : shader_.params) {
    VarState& s = state(*v);
    Variation initial = value_for(v->init.get(), always_uniform(*v));
    if (initial && s.variation == kUniform)
      complain_of(initial.why, Msg::kVaryingToUniform, v->init->range, v->name);
  }
  statement(shader_.body.get());
}

VarState& ContextWalk::state(const Variable& v) {
  if (auto it = bound_.find(&v); it != bound_.end()) return *it->second;
  VarState& s = here().variables[&v];
  if (!s.declared) {
    s.declared = &v;
    if (v.detail_given && v.detail == Detail::kVarying) {
      s.variation = kVarying;
      s.cause = &causes_.emplace_back(Cause{Cause::kDeclared, v.where, v.name, {}, nullptr});
    }
  }
  bound_[&v] = &s;
  return s;
}

void ContextWalk::statement(Stmt* s) {
  if (!s || gave_up_) return;
  Around rest(*this, soft_, here().soft_rest); // lanes that returned take no part in what follows
  switch (s->kind) {
  case StmtKind::kEmpty:
  case StmtKind::kFunction: break;
  case StmtKind::kBlock:
    for (StmtPtr& child : as<BlockStmt>(s)->statements)
      statement(child.get());
    break;
  case StmtKind::kDeclaration:
    if (!as<DeclarationStmt>(s)->is_extern)
      for (Variable* v : as<DeclarationStmt>(s)->variables)
        declare(*v);
    break;
  case StmtKind::kExpression: values(as<ExpressionStmt>(s)->expressions); break;
  case StmtKind::kIf: {
    auto& branch = *as<IfStmt>(s);
    Around varying(*this, hard_, condition(branch.condition.get(), value(branch.condition.get())));
    statement(branch.then_branch.get());
    statement(branch.else_branch.get());
    break;
  }
  case StmtKind::kLoop: loop(*as<LoopStmt>(s)); break;
  case StmtKind::kJump: jump(*as<JumpStmt>(s)); break;
  case StmtKind::kReturn: leave(*as<ReturnStmt>(s)); break;
  case StmtKind::kIlluminance: illuminance(*as<IlluminanceStmt>(s)); break;
  case StmtKind::kEmission: emission(*as<EmissionStmt>(s)); break;
  case StmtKind::kGather: gather(*as<GatherStmt>(s)); break;
  }
}

void ContextWalk::declare(Variable& v) {
  VarState& s = state(v);
  s.hard = hard_;
  s.soft = soft_;
  if (v.init) store_variable(s, value_for(v.init.get(), always_uniform(v)), v.init->range, v.name);
}

void ContextWalk::loop_body(const Stmt& loop_stmt, Stmt* body) {
  frame_.loops.push_back({&loop_stmt, control()});
  {
    Around left(*this, soft_, early(loop_stmt));
    statement(body);
  }
  frame_.loops.pop_back();
}

void ContextWalk::loop(LoopStmt& s) {
  statement(s.init.get());
  Around varying(*this, hard_, condition(s.condition.get(), value(s.condition.get())));
  loop_body(s, s.body.get());
  Around left(*this, soft_, early(s));
  values(s.steps);
}

void ContextWalk::jump(const JumpStmt& s) {
  for (size_t i = frame_.loops.size(), n = static_cast<size_t>(s.levels); i-- > 0 && n-- > 0;) {
    const Loop& left = frame_.loops[i];
    if (control() <= left.control) continue;
    mark(here().soft_loops[left.statement],
         control_at(&s, {Cause::kLoopLeft, s.range, "", {}, control_from(left.control)}));
  }
}

void ContextWalk::leave(ReturnStmt& s) {
  bool uniform_function = frame_.function && frame_.function->result_uniform;
  Variation variation = value_for(s.value.get(), uniform_function || drawing_once_);
  bool some_lanes = control() > frame_.control; // only
  const Cause* outermost = some_lanes ? control_from(frame_.control) : nullptr;
  std::string_view name = frame_.function ? std::string_view(frame_.function->name) : "";
  if (variation.degree == kVarying)
    mark(here().result, here().result_cause, kVarying,
         {Cause::kReturned, s.value->range, name, variation.why, nullptr});
  else
    mark(here().result, here().result_cause, some_lanes ? kVarying : variation.degree,
         {Cause::kReturnedUnder, s.range, name, {}, outermost});
  if (uniform_function && variation.degree == kVarying)
    complain_of(variation.why, Msg::kVaryingResult, s.value->range, name);
  if (!some_lanes) return;
  const Cause* cause = control_at(&s, {Cause::kReturnedFrom, s.range, "", {}, outermost});
  mark(here().soft_rest, cause);
  for (const Loop& left : frame_.loops)
    mark(here().soft_loops[left.statement], cause);
}

void ContextWalk::illuminance(IlluminanceStmt& s) {
  if (shader_.kind == ShaderKind::kLight || shader_.kind == ShaderKind::kImager)
    complain(Msg::kIlluminancePlace, s.range, slvm::shader_kind_name(shader_.kind));
  if (illuminance_ > 0) complain(Msg::kNestedLightLoop, s.range, "illuminance", "illuminance");
  need_uniform(s.category.get(), "category", "illuminance");
  value(s.position.get());
  value(s.axis.get());
  value(s.angle.get());
  tokens(s.tokens, {kVarying, {Reason::kBuiltin, s.range, "illuminance", nullptr}});
  ++illuminance_;
  Around lights(*this, soft_, around(s, Cause::kLights));
  loop_body(s, s.body.get());
  --illuminance_;
}

void ContextWalk::emission(EmissionStmt& s) {
  std::string_view name = s.is_solar ? "solar" : "illuminate";
  if (shader_.kind != ShaderKind::kLight)
    complain(Msg::kEmissionPlace, s.range, name, slvm::shader_kind_name(shader_.kind));
  if (emission_ > 0) complain(Msg::kNestedLightLoop, s.range, name, "illuminate or solar");
  value(s.position.get());
  value(s.axis.get());
  value(s.angle.get());
  ++emission_;
  Around light(*this, soft_, around(s, Cause::kLights));
  statement(s.body.get());
  --emission_;
}

void ContextWalk::gather(GatherStmt& s) {
  std::string_view name = s.is_traverse ? "traverse" : "gather";
  need_uniform(s.category.get(), "category", name);
  for (ExprPtr* e : {&s.position, &s.direction, &s.angle, &s.samples})
    value(e->get());
  Around rays(*this, hard_, around(s, Cause::kRays));
  tokens(s.tokens, {kVarying, {Reason::kBuiltin, s.range, name, nullptr}});
  loop_body(s, s.body.get());
  loop_body(s, s.else_body.get());
}

} // namespace slc
