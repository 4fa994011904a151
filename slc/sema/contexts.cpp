// Which values vary, per shader, by a fixpoint: a variable once found varying stays so; the walk is repeated
// until nothing changes, and once more to report. Read ContextWalk::run first.
//
// Control that some lanes have left counts as varying. There are two degrees: under a varying condition or in
// gather (hard), and in light loops or after a varying break or return (soft). A variable set there varies
// from then on, as it does in the IR; for a declared uniform that is worth a warning where the control is
// hard.
#include "slc/sema/contexts.h"

#include "slc/diag/messages.h"

#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace slc {
namespace {

// How much a value varies, as bits to be or-ed. kSomewhere: only because a declared uniform was set at some
// points and not at others; what is declared uniform may take that, and varies likewise. kVarying: by itself.
enum Variation : unsigned { kUniform = 0, kSomewhere = 1, kVarying = 3 };

// A variable in one expansion of the function it belongs to.
struct VarState {
  const Variable* declared = nullptr;
  unsigned variation = kUniform;
  int hard = 0, soft = 0; // control around the declaration
};

// One expansion of a function, or the shader itself. Kept between rounds.
struct Instance {
  std::map<const Variable*, VarState> variables;
  std::map<const CallExpr*, std::unique_ptr<Instance>> calls;
  std::set<const Stmt*> soft_loops; // loops some lanes leave earlier than others
  bool soft_rest = false;           // some lanes have returned already
  unsigned result = kUniform;
};

// What was reported where: one function may be expanded in many places.
using Reported = std::set<std::tuple<slvm::FileId, uint32_t, uint32_t, Msg>>;

bool declared_uniform(const Variable& v) {
  return v.detail_given && v.detail == Detail::kUniform;
}
bool always_uniform(const Variable& v) {
  return declared_uniform(v) || (v.kind == VariableKind::kParameter && !v.detail_given);
}

bool is_random(const Expr* e) {
  if (const auto* conversion = as<ConvertExpr>(e)) e = conversion->operand.get();
  const auto* call = as<CallExpr>(e);
  return call && !call->function && call->shadeop != kNoShadeop &&
         slvm::shadeop(call->shadeop).name == "random";
}

class ContextWalk {
public:
  ContextWalk(Shader& shader, slvm::Diagnostics& diags, Reported& reported)
      : shader_(shader), diags_(diags), reported_(reported) {}

  void run() {
    do {
      changed_ = false;
      walk_shader();
    } while (changed_ && !gave_up_);
    reporting_ = true;
    if (!gave_up_) walk_shader();
  }

private:
  struct Loop {
    const Stmt* statement;
    int control; // around it
  };
  // What holds at one point of the walk within one instance.
  struct Frame {
    Instance* instance = nullptr;
    const FunctionDef* function = nullptr;
    int control = 0; // around the call: inside, all lanes of the caller are there
    std::vector<Loop> loops;
  };

  void walk_shader();
  void statement(Stmt* s);
  void declare(Variable& v);
  void loop(LoopStmt& s);
  void jump(const JumpStmt& s);
  void leave(ReturnStmt& s);
  void illuminance(IlluminanceStmt& s);
  void emission(EmissionStmt& s);
  void gather(GatherStmt& s);
  void loop_body(const Stmt& loop, Stmt* body);

  unsigned value(Expr* e);
  unsigned value_here(Expr& e);
  unsigned values(std::vector<ExprPtr>& list);
  unsigned call(CallExpr& e);
  unsigned inlined(CallExpr& e);
  unsigned row_call(CallExpr& e);
  unsigned tokens(std::vector<TokenArg>& list, unsigned output);
  unsigned assign(AssignExpr& e);
  unsigned read(const Variable* v, SourceRange where);
  void store(Expr& place, unsigned variation, SourceRange where);
  void store_variable(VarState& state, unsigned variation, SourceRange where, std::string_view name);
  static bool draws_once(const Expr* value, const Variable& target);

  VarState& state(const Variable& v);
  void mark(bool& flag) { changed_ |= !std::exchange(flag, true); }
  void mark(unsigned& variation, unsigned more) {
    changed_ |= std::exchange(variation, variation | more) != variation;
  }
  int control() const { return hard_ + soft_; }
  Instance& here() { return *frame_.instance; }
  void check_global(const Variable& v, bool store, SourceRange where);
  void check_row_place(const CallExpr& e, uint32_t flags);
  template <class... Args> void complain(Msg id, SourceRange where, const Args&... args) {
    if (reporting_ && reported_.insert({where.file, where.line, where.column, id}).second)
      report(diags_, id, where, args...);
  }

  Shader& shader_;
  slvm::Diagnostics& diags_;
  Reported& reported_;
  Instance root_;
  Frame frame_;
  std::map<const Variable*, VarState*> bound_;  // variables of the expansions around this point
  std::set<const FunctionDef*> open_functions_; // being expanded
  size_t expansions_ = 0;
  int hard_ = 0, soft_ = 0;
  int illuminance_ = 0, emission_ = 0; // loops around this point, callers' included
  unsigned old_value_ = kUniform;      // of the target of a compound assignment
  bool changed_ = false, reporting_ = false, gave_up_ = false;
};

void ContextWalk::walk_shader() {
  frame_ = {&root_, nullptr, 0, {}};
  bound_.clear();
  hard_ = soft_ = illuminance_ = emission_ = 0;
  for (Variable* v : shader_.params) {
    VarState& s = state(*v);
    if (value(v->init.get()) && s.variation == kUniform && !draws_once(v->init.get(), *v))
      complain(Msg::kVaryingToUniform, v->init->range, v->name);
  }
  statement(shader_.body.get());
}

VarState& ContextWalk::state(const Variable& v) {
  if (auto it = bound_.find(&v); it != bound_.end()) return *it->second;
  VarState& s = here().variables[&v];
  if (!s.declared) {
    s.declared = &v;
    s.variation = v.detail_given && v.detail == Detail::kVarying ? kVarying : kUniform;
  }
  bound_[&v] = &s;
  return s;
}

void ContextWalk::statement(Stmt* s) {
  if (!s || gave_up_) return;
  int rest = here().soft_rest ? 1 : 0; // lanes that returned take no part in what follows
  soft_ += rest;
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
    int varying = value(branch.condition.get()) ? 1 : 0;
    hard_ += varying;
    statement(branch.then_branch.get());
    statement(branch.else_branch.get());
    hard_ -= varying;
    break;
  }
  case StmtKind::kLoop: loop(*as<LoopStmt>(s)); break;
  case StmtKind::kJump: jump(*as<JumpStmt>(s)); break;
  case StmtKind::kReturn: leave(*as<ReturnStmt>(s)); break;
  case StmtKind::kIlluminance: illuminance(*as<IlluminanceStmt>(s)); break;
  case StmtKind::kEmission: emission(*as<EmissionStmt>(s)); break;
  case StmtKind::kGather: gather(*as<GatherStmt>(s)); break;
  }
  soft_ -= rest;
}

void ContextWalk::declare(Variable& v) {
  VarState& s = state(v);
  s.hard = hard_;
  s.soft = soft_;
  if (v.init && !draws_once(v.init.get(), v)) store_variable(s, value(v.init.get()), v.init->range, v.name);
}

void ContextWalk::loop_body(const Stmt& loop_stmt, Stmt* body) {
  frame_.loops.push_back({&loop_stmt, control()});
  int early = here().soft_loops.contains(&loop_stmt) ? 1 : 0;
  soft_ += early;
  statement(body);
  soft_ -= early;
  frame_.loops.pop_back();
}

void ContextWalk::loop(LoopStmt& s) {
  statement(s.init.get());
  int varying = value(s.condition.get()) ? 1 : 0;
  hard_ += varying;
  loop_body(s, s.body.get());
  int early = here().soft_loops.contains(&s) ? 1 : 0;
  soft_ += early;
  values(s.steps);
  soft_ -= early;
  hard_ -= varying;
}

void ContextWalk::jump(const JumpStmt& s) {
  for (size_t i = frame_.loops.size(), n = static_cast<size_t>(s.levels); i-- > 0 && n-- > 0;) {
    const Loop& left = frame_.loops[i];
    if (control() > left.control && here().soft_loops.insert(left.statement).second) changed_ = true;
  }
}

void ContextWalk::leave(ReturnStmt& s) {
  bool uniform_function = frame_.function && frame_.function->result_uniform;
  unsigned variation = uniform_function && is_random(s.value.get()) ? kUniform : value(s.value.get());
  bool some_lanes = control() > frame_.control; // only
  mark(here().result, some_lanes ? kVarying : variation);
  if (uniform_function && variation == kVarying)
    complain(Msg::kVaryingResult, s.value->range, frame_.function->name);
  if (!some_lanes) return;
  mark(here().soft_rest);
  for (const Loop& left : frame_.loops)
    if (here().soft_loops.insert(left.statement).second) changed_ = true;
}

void ContextWalk::illuminance(IlluminanceStmt& s) {
  if (shader_.kind == ShaderKind::kLight || shader_.kind == ShaderKind::kImager)
    complain(Msg::kIlluminancePlace, s.range, slvm::shader_kind_name(shader_.kind));
  if (illuminance_ > 0) complain(Msg::kNestedLightLoop, s.range, "illuminance", "illuminance");
  if (value(s.category.get())) complain(Msg::kNeedsUniform, s.category->range, "category", "illuminance");
  value(s.position.get());
  value(s.axis.get());
  value(s.angle.get());
  tokens(s.tokens, kVarying);
  ++illuminance_;
  ++soft_;
  loop_body(s, s.body.get());
  --soft_;
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
  ++soft_;
  statement(s.body.get());
  --soft_;
  --emission_;
}

void ContextWalk::gather(GatherStmt& s) {
  std::string_view name = s.is_traverse ? "traverse" : "gather";
  if (value(s.category.get())) complain(Msg::kNeedsUniform, s.category->range, "category", name);
  for (ExprPtr* e : {&s.position, &s.direction, &s.angle, &s.samples})
    value(e->get());
  ++hard_;
  tokens(s.tokens, kVarying);
  loop_body(s, s.body.get());
  loop_body(s, s.else_body.get());
  --hard_;
}

unsigned ContextWalk::values(std::vector<ExprPtr>& list) {
  unsigned variation = kUniform;
  for (ExprPtr& e : list)
    variation |= value(e.get());
  return variation;
}

// How much the value varies; notes it in the node.
unsigned ContextWalk::value(Expr* e) {
  if (!e || gave_up_) return kUniform;
  unsigned variation = value_here(*e);
  if (variation) e->detail = Detail::kVarying;
  return variation;
}

unsigned ContextWalk::value_here(Expr& e) {
  switch (e.kind) {
  case ExprKind::kNumber:
  case ExprKind::kString: return kUniform;
  case ExprKind::kVariable: return read(as<VariableExpr>(&e)->variable, e.range);
  case ExprKind::kIndex: {
    unsigned index = value(as<IndexExpr>(&e)->index.get());
    return read(as<IndexExpr>(&e)->variable, e.range) | index;
  }
  case ExprKind::kTuple: return values(as<TupleExpr>(&e)->elements);
  case ExprKind::kArrayInit: return values(as<ArrayInitExpr>(&e)->elements);
  case ExprKind::kOperator: return values(as<OperatorExpr>(&e)->operands);
  case ExprKind::kLogical: {
    unsigned left = value(as<LogicalExpr>(&e)->left.get());
    hard_ += left ? 1 : 0;
    unsigned right = value(as<LogicalExpr>(&e)->right.get());
    hard_ -= left ? 1 : 0;
    return left | right;
  }
  case ExprKind::kConditional: {
    auto& c = *as<ConditionalExpr>(&e);
    unsigned condition = value(c.condition.get());
    hard_ += condition ? 1 : 0;
    unsigned sides = value(c.then_value.get());
    sides |= value(c.else_value.get());
    hard_ -= condition ? 1 : 0;
    return condition | sides;
  }
  case ExprKind::kConvert: return value(as<ConvertExpr>(&e)->operand.get());
  case ExprKind::kCast: return value(as<CastExpr>(&e)->operand.get());
  case ExprKind::kCall: return call(*as<CallExpr>(&e));
  case ExprKind::kAssign: return assign(*as<AssignExpr>(&e));
  case ExprKind::kTargetValue: return old_value_;
  }
  return kVarying;
}

unsigned ContextWalk::read(const Variable* v, SourceRange where) {
  if (!v) return kUniform;
  if (v->kind != VariableKind::kGlobal) return state(*v).variation;
  check_global(*v, false, where);
  return v->detail == Detail::kVarying ? kVarying : kUniform;
}

void ContextWalk::check_global(const Variable& v, bool store, SourceRange where) {
  char access = slvm::global_info(v.global).access[static_cast<size_t>(shader_.kind)];
  std::string_view kind = slvm::shader_kind_name(shader_.kind);
  bool light = shader_.kind == ShaderKind::kLight;
  bool of_lights = v.global == Global::kL || v.global == Global::kCl || v.global == Global::kOl;
  if (access == '-') {
    std::string_view advice;
    if (light && (v.global == Global::kCi || v.global == Global::kOi))
      advice = "; lights set Cl and Ol";
    else if (of_lights && shader_.kind != ShaderKind::kSurface)
      advice = "; it belongs to lights and to light loops of surfaces";
    complain(Msg::kGlobalNotHere, where, v.name, kind, advice);
  } else if (store && access == 'r') {
    complain(Msg::kGlobalReadOnly, where, v.name, kind);
  } else if (of_lights && !light && illuminance_ == 0) {
    complain(Msg::kOutsideIlluminance, where, v.name);
  } else if (light && v.global == Global::kL && emission_ == 0) {
    complain(Msg::kOutsideEmission, where, v.name);
  }
}

void ContextWalk::store_variable(VarState& s, unsigned variation, SourceRange where, std::string_view name) {
  const Variable& v = *s.declared;
  bool some_points = control() > s.hard + s.soft; // only
  if (!always_uniform(v)) return mark(s.variation, some_points ? kVarying : variation);
  if (hard_ > s.hard) complain(Msg::kUniformUnderVarying, where, name);
  if (variation == kVarying && !some_points && s.variation == kUniform)
    complain(Msg::kVaryingToUniform, where, name);
  else if ((some_points && v.type != Type::kString) || variation == kSomewhere)
    mark(s.variation, kSomewhere);
}

void ContextWalk::store(Expr& place, unsigned variation, SourceRange where) {
  const Variable* v = nullptr;
  if (auto* name = as<VariableExpr>(&place)) v = name->variable;
  if (auto* element = as<IndexExpr>(&place)) {
    v = element->variable;
    variation |= value(element->index.get());
  }
  if (!v) return;
  if (v->kind == VariableKind::kGlobal) {
    check_global(*v, true, where);
    if (v->detail == Detail::kUniform && variation) complain(Msg::kVaryingToUniform, where, v->name);
    return;
  }
  store_variable(state(*v), variation, where, v->name);
  if (state(*v).variation) place.detail = Detail::kVarying;
}

// random() straight into a declared uniform is drawn once for the grid.
bool ContextWalk::draws_once(const Expr* e, const Variable& target) {
  return always_uniform(target) && is_random(e);
}

unsigned ContextWalk::assign(AssignExpr& e) {
  const Variable* v = nullptr;
  if (auto* name = as<VariableExpr>(e.target.get())) v = name->variable;
  if (auto* element = as<IndexExpr>(e.target.get())) v = element->variable;
  if (v && draws_once(e.value.get(), *v)) {
    store(*e.target, kUniform, e.target->range);
    return kUniform;
  }
  unsigned outer = old_value_;
  if (e.compound) old_value_ = value(e.target.get());
  unsigned variation = value(e.value.get());
  old_value_ = outer;
  store(*e.target, variation, e.value->range);
  return variation;
}

unsigned ContextWalk::call(CallExpr& e) {
  bool rsl_body = e.shadeop != kNoShadeop;
  if (e.function && !rsl_body) return inlined(e);
  if (rsl_body) return row_call(e);
  return values(e.args);
}

unsigned ContextWalk::row_call(CallExpr& e) {
  const slvm::ShadeopInfo& info = slvm::shadeop(e.shadeop);
  const slvm::Signature& signature = info.signature;
  check_row_place(e, info.flags);
  unsigned variation = info.flags & slvm::kHiddenVarying ? kVarying : kUniform;
  auto param = [&](size_t i) -> const slvm::SignatureParam& { return signature.param(static_cast<int>(i)); };
  // Surplus formals of an RSL body take token-value pairs.
  size_t count =
      signature.variadic() ? e.args.size() : std::min<size_t>(e.args.size(), signature.param_count);
  for (size_t i = 0; i < e.args.size(); ++i) {
    if (i < count && param(i).output && !param(i).input) continue;
    unsigned arg = value(e.args[i].get());
    if (arg && i < count && param(i).uniform)
      complain(Msg::kNeedsUniform, e.args[i]->range, param(i).name, e.name);
    bool message = i < count && param(i).output && param(i).any;
    if (!message) variation |= arg;
  }
  for (size_t i = 0; i < count; ++i) {
    if (!param(i).output) continue;
    // What a message brings is as uniform as the variable is declared.
    const auto* place = as<VariableExpr>(e.args[i].get());
    bool uniform_target = param(i).any && place && place->variable &&
                          (always_uniform(*place->variable) || place->variable->type == Type::kString);
    unsigned brought = uniform_target ? kUniform : param(i).any ? kVarying : variation;
    store(*e.args[i], brought, e.args[i]->range);
  }
  variation |= tokens(e.tokens, variation);
  return signature.uniform_result || signature.result == Type::kVoid ? kUniform : variation;
}

void ContextWalk::check_row_place(const CallExpr& e, uint32_t flags) {
  if ((flags & slvm::kSurfaceOnly) && shader_.kind == ShaderKind::kLight)
    complain(Msg::kCallNotInLights, e.range, e.name);
  if ((flags & slvm::kInIlluminance) && illuminance_ == 0)
    complain(Msg::kOutsideIlluminance, e.range, e.name);
}

// How much the inputs among the pairs vary; `output`: how much the outputs do.
unsigned ContextWalk::tokens(std::vector<TokenArg>& list, unsigned output) {
  unsigned inputs = kUniform;
  for (TokenArg& t : list) {
    if (value(t.token.get())) complain(Msg::kNeedsUniform, t.token->range, "token", "token-value pairs");
    if (!t.value) continue;
    if (t.info && t.info->output) {
      store(*t.value, output, t.value->range);
      continue;
    }
    unsigned input = value(t.value.get());
    if (input && t.info && t.info->uniform) complain(Msg::kTokenUniform, t.value->range, t.info->name);
    inputs |= input;
  }
  return inputs;
}

// A function of the source, expanded here.
unsigned ContextWalk::inlined(CallExpr& e) {
  const FunctionDef& f = *e.function;
  if (open_functions_.contains(&f)) return kUniform; // recursion: an error already
  if (++expansions_ > kMaxInlinedCalls && !here().calls.contains(&e)) {
    gave_up_ = true;
    report(diags_, Msg::kTooManyCalls, shader_.where, shader_.name, kMaxInlinedCalls);
    return kVarying;
  }
  std::unique_ptr<Instance>& slot = here().calls[&e];
  if (!slot) slot = std::make_unique<Instance>();
  // Actual arguments, in the caller's terms. An output formal is another name of its actual.
  std::vector<std::pair<const Variable*, VarState*>> bindings;
  for (size_t i = 0; i < e.args.size() && i < f.formals.size(); ++i) {
    const Variable& formal = *f.formals[i];
    Expr& arg = *e.args[i];
    unsigned variation = value(&arg);
    bool given_varying = formal.detail_given && formal.detail == Detail::kVarying;
    VarState* binding = &slot->variables[&formal];
    const auto* name = as<VariableExpr>(&arg);
    const auto* element = as<IndexExpr>(&arg);
    const Variable* actual = name ? name->variable : element ? element->variable : nullptr;
    if (formal.output && actual) {
      if (actual->kind == VariableKind::kGlobal) check_global(*actual, true, arg.range);
      binding = &state(*actual);
      if (element && variation) store_variable(*binding, variation, arg.range, actual->name);
      if (given_varying) store_variable(*binding, kVarying, arg.range, actual->name);
    } else {
      binding->declared = &formal;
      if (variation == kVarying && declared_uniform(formal))
        complain(Msg::kNeedsUniform, arg.range, formal.name, f.name);
      else
        mark(binding->variation, given_varying ? kVarying : variation);
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
  return slot->result;
}

} // namespace

void check_contexts(TranslationUnit& unit, slvm::Diagnostics& diags) {
  Reported reported;
  for (Shader& shader : unit.shaders)
    ContextWalk(shader, diags, reported).run();
}

} // namespace slc
