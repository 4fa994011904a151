// Which values vary, per shader, by a fixpoint: a variable once found varying stays so; the walk is repeated
// until nothing changes, and once more to report. Read ContextWalk::run first.
//
// Control that some lanes have left counts as varying. There are two degrees: under a varying condition or in
// gather (hard), and in light loops or after a varying break or return (soft). A variable set there varies
// from then on, as it does in the IR; for a declared uniform that is worth a warning where the control is
// hard.
#include "slc/sema/contexts.h"

#include "slc/diag/messages.h"
#include "slc/sema/reasons.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace slc {
namespace {

// How much a value varies, as bits to be or-ed. kSomewhere: only because a declared uniform was set at some
// points and not at others; what is declared uniform may take that, and varies likewise. kVarying: by itself.
enum Degree : unsigned { kUniform = 0, kSomewhere = 1, kVarying = 3 };

// How much a value varies, and the first thing that makes it.
struct Variation {
  unsigned degree = kUniform;
  Reason why;

  explicit operator bool() const { return degree != kUniform; }
  Variation& operator|=(const Variation& more) {
    if (degree < more.degree) why = more.why;
    degree |= more.degree;
    return *this;
  }
  friend Variation operator|(Variation a, const Variation& b) { return a |= b; }
};

// A variable in one expansion of the function it belongs to.
struct VarState {
  const Variable* declared = nullptr;
  unsigned variation = kUniform;
  const Cause* cause = nullptr; // once it varies
  int hard = 0, soft = 0;       // control around the declaration
};

// An output formal: another name of the variable it is called with.
struct Alias {
  const VarState* state = nullptr;
  std::string_view actual;
  SourceRange where; // in the call
};

// One expansion of a function, or the shader itself. Kept between rounds.
struct Instance {
  std::map<const Variable*, VarState> variables;
  std::map<const CallExpr*, std::unique_ptr<Instance>> calls;
  std::map<const Variable*, Alias> aliases;
  std::map<const Stmt*, const Cause*> soft_loops; // loops some lanes leave earlier than others
  const Cause* soft_rest = nullptr;               // some lanes have returned already
  std::map<const void*, const Cause*> controls;   // by statement or condition: why lanes part there
  unsigned result = kUniform;
  const Cause* result_cause = nullptr;
};

// What was reported where: one function may be expanded in many places.
using Reported = std::set<std::tuple<slvm::FileId, uint32_t, uint32_t, Msg>>;

bool declared_uniform(const Variable& v) {
  return v.detail_given && v.detail == Detail::kUniform;
}
bool always_uniform(const Variable& v) {
  return declared_uniform(v) || (v.kind == VariableKind::kParameter && !v.detail_given && !v.copied);
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

  /// After run(): what is known of the variables of this name, each answer once, in source order.
  std::vector<std::vector<slvm::Note>> explain(std::string_view name) const;

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
  void need_uniform(Expr* e, std::string_view name, std::string_view callee);
  void loop_body(const Stmt& loop, Stmt* body);

  Variation value(Expr* e);
  Variation value_here(Expr& e);
  Variation values(std::vector<ExprPtr>& list);
  Variation call(CallExpr& e);
  Variation inlined(CallExpr& e);
  Variation row_call(CallExpr& e);
  Variation tokens(std::vector<TokenArg>& list, const Variation& output);
  Variation assign(AssignExpr& e);
  Variation read(const Variable* v, SourceRange where);
  void store(Expr& place, Variation variation, SourceRange where);
  void store_variable(VarState& state, const Variation& variation, SourceRange where, std::string_view name);
  Variation value_for(Expr* e, bool once);

  VarState& state(const Variable& v);
  /// Makes something vary as much as `more`, too; the first cause stays.
  void mark(unsigned& degree, const Cause*& cause, unsigned more, const Cause& why) {
    if (more && !cause) cause = &causes_.emplace_back(why);
    changed_ |= std::exchange(degree, degree | more) != degree;
  }
  void mark(const Cause*& flag, const Cause* why) {
    changed_ |= !flag;
    if (!flag) flag = why;
  }
  /// Control that some lanes only are under, as long as the object lives; none without cause.
  class Around {
  public:
    Around(ContextWalk& walk, int& counter, const Cause* cause) : walk_(walk), counter_(counter) {
      if (!cause) return;
      entered_ = true;
      ++counter_;
      walk_.controls_.push_back(cause);
    }
    ~Around() {
      if (!entered_) return;
      --counter_;
      walk_.controls_.pop_back();
    }
    Around(const Around&) = delete;
    Around& operator=(const Around&) = delete;

  private:
    ContextWalk& walk_;
    int& counter_;
    bool entered_ = false;
  };
  /// Why lanes part at a statement or condition of this instance: one cause, however often it is walked.
  const Cause* control_at(const void* node, const Cause& why) {
    const Cause*& known = here().controls[node];
    if (!known) known = &causes_.emplace_back(why);
    return known;
  }
  const Cause* condition(const Expr* e, const Variation& v) {
    return v ? control_at(e, {Cause::kCondition, e->range, "", v.why, nullptr}) : nullptr;
  }
  const Cause* around(const Stmt& s, Cause::Kind kind) {
    return control_at(&s, {kind, s.range, "", {}, nullptr});
  }
  /// The outermost varying control inside of what there is `outside` of.
  const Cause* control_from(int outside) const { return controls_[static_cast<size_t>(outside)]; }
  const Cause* early(const Stmt& loop) {
    auto it = here().soft_loops.find(&loop);
    return it == here().soft_loops.end() ? nullptr : it->second;
  }
  void explain(const Instance& instance, std::string_view name,
               std::vector<std::vector<slvm::Note>>& answers) const;
  int control() const { return hard_ + soft_; }
  Instance& here() { return *frame_.instance; }
  void check_global(const Variable& v, bool store, SourceRange where);
  void check_row_place(const CallExpr& e, uint32_t flags);
  template <class... Args> void complain(Msg id, SourceRange where, const Args&... args) {
    complain_of(Reason(), id, where, args...);
  }
  /// With the nearest step to what makes the value vary as a note.
  template <class... Args>
  void complain_of(const Reason& why, Msg id, SourceRange where, const Args&... args) {
    if (!reporting_ || !reported_.insert({where.file, where.line, where.column, id}).second) return;
    slvm::Diagnostic& d = report(diags_, id, where, args...);
    d.notes = nearest_step(why);
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
  std::deque<Cause> causes_;           // all there are
  std::vector<const Cause*> controls_; // hard_ + soft_ of them, outermost first
  int illuminance_ = 0, emission_ = 0; // loops around this point, callers' included
  Variation old_value_;                // of the target of a compound assignment
  bool changed_ = false, reporting_ = false, gave_up_ = false;
  bool drawing_once_ = false; // random() is uniform here
};

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

void ContextWalk::check_global(const Variable& v, bool store, SourceRange where) {
  char access = slvm::global_info(v.global).access[static_cast<size_t>(shader_.kind)];
  std::string_view kind = slvm::shader_kind_name(shader_.kind);
  bool light = shader_.kind == ShaderKind::kLight;
  bool of_lights = v.global == Global::kL || v.global == Global::kCl || v.global == Global::kOl;
  if (access == '-') {
    std::string_view advice;
    if (light && (v.global == Global::kCi || v.global == Global::kOi))
      advice = "; lights set Cl and Ol";
    else if (shader_.kind == ShaderKind::kDisplacement &&
             (v.global == Global::kCi || v.global == Global::kOi))
      advice = "; displacements set P and N";
    else if (of_lights && shader_.kind != ShaderKind::kSurface)
      advice = "; it belongs to lights and to light loops of surfaces";
    complain(Msg::kGlobalNotHere, where, v.name, kind, advice);
  } else if (store && access == 'r' && of_lights) {
    complain(Msg::kLightReadOnly, where, v.name, kind);
  } else if (store && access == 'r') {
    complain(Msg::kGlobalReadOnly, where, v.name, kind);
    shader_.copied.insert(v.global);
  } else if (of_lights && !light && illuminance_ == 0) {
    complain(Msg::kOutsideIlluminance, where, v.name);
  } else if (light && v.global == Global::kL && emission_ == 0) {
    complain(store ? Msg::kStrayLightVector : Msg::kOutsideEmission, where, v.name);
  }
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
  bool rsl_body = e.shadeop != kNoShadeop;
  if (e.function && !rsl_body) return inlined(e);
  if (rsl_body) return row_call(e);
  return values(e.args);
}

Variation ContextWalk::row_call(CallExpr& e) {
  const slvm::ShadeopInfo& info = slvm::shadeop(e.shadeop);
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
    if (arg && i < count && param(i).uniform)
      complain_of(arg.why, Msg::kNeedsUniform, e.args[i]->range, param(i).name, e.name);
    bool message = i < count && param(i).output && param(i).any;
    if (!message) variation |= arg;
  }
  for (size_t i = 0; i < count; ++i) {
    if (!param(i).output) continue;
    // What a message brings is as uniform as the variable is declared.
    const auto* place = as<VariableExpr>(e.args[i].get());
    bool uniform_target = param(i).any && place && place->variable &&
                          (always_uniform(*place->variable) || place->variable->type == Type::kString);
    Variation brought = variation;
    if (param(i).any) brought = {kVarying, {Reason::kBuiltin, e.range, e.name, nullptr}};
    store(*e.args[i], uniform_target ? Variation() : brought, e.args[i]->range);
  }
  variation |= tokens(e.tokens, variation);
  return signature.uniform_result || signature.result == Type::kVoid ? Variation() : variation;
}

void ContextWalk::check_row_place(const CallExpr& e, uint32_t flags) {
  if ((flags & slvm::kSurfaceOnly) && shader_.kind == ShaderKind::kLight)
    complain(Msg::kCallNotInLights, e.range, e.name);
  if ((flags & slvm::kInIlluminance) && illuminance_ == 0)
    complain(Msg::kOutsideIlluminance, e.range, e.name);
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

void ContextWalk::explain(const Instance& instance, std::string_view name,
                          std::vector<std::vector<slvm::Note>>& answers) const {
  auto tell = [](std::vector<slvm::Note>& answer, const VarState& s, std::string_view as) {
    const Variable& v = *s.declared;
    if (v.kind == VariableKind::kGlobal)
      answer.push_back({{}, fmt::format("'{}' is a predefined variable that varies", v.name)});
    else if (s.cause)
      for (slvm::Note& note : steps(*s.cause))
        answer.push_back(std::move(note));
    else
      answer.push_back({v.where, fmt::format("'{}' is uniform", as)});
  };
  for (const auto& [v, s] : instance.variables)
    if (v->name == name && s.declared) tell(answers.emplace_back(), s, name);
  for (const auto& [v, alias] : instance.aliases) {
    if (v->name != name) continue;
    std::vector<slvm::Note>& answer = answers.emplace_back();
    answer.push_back({alias.where, fmt::format("'{}' is '{}' of the caller here", name, alias.actual)});
    tell(answer, *alias.state, alias.actual);
  }
  for (const auto& [call, inner] : instance.calls)
    explain(*inner, name, answers);
}

std::vector<std::vector<slvm::Note>> ContextWalk::explain(std::string_view name) const {
  std::vector<std::vector<slvm::Note>> answers;
  explain(root_, name, answers);
  auto key = [](const std::vector<slvm::Note>& answer) {
    const SourceRange& r = answer.front().where;
    return std::tuple(r.file, r.line, r.column);
  };
  std::stable_sort(answers.begin(), answers.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  auto same = [](const slvm::Note& a, const slvm::Note& b) { return a.where == b.where && a.text == b.text; };
  auto end = std::unique(answers.begin(), answers.end(), [&](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
  });
  answers.erase(end, answers.end());
  slvm::Global global = slvm::find_global(name);
  if (!answers.empty() || global == Global::kCount) return answers;
  bool varies = slvm::global_info(global).detail == Detail::kVarying;
  return {
      {{{}, fmt::format("'{}' is a predefined variable that {}", name, varies ? "varies" : "is uniform")}}};
}

} // namespace

void check_contexts(TranslationUnit& unit, slvm::Diagnostics& diags) {
  Reported reported;
  for (Shader& shader : unit.shaders)
    ContextWalk(shader, diags, reported).run();
}

std::vector<std::vector<slvm::Note>> explain_varying(Shader& shader, std::string_view name) {
  slvm::Diagnostics known; // reported by check_contexts
  Reported reported;
  ContextWalk walk(shader, known, reported);
  walk.run();
  return walk.explain(name);
}

} // namespace slc
