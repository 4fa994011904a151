// Statements.
#include "slc/lower/lowering.h"

#include <algorithm>
#include <utility>

namespace slc {

std::vector<size_t> Lowering::in_scope() const {
  std::vector<size_t> out;
  for (size_t i = 0; i < values_.size(); ++i)
    if (values_[i] != ir::kNoValue) out.push_back(i);
  return out;
}

Lowering::Values Lowering::values_for(const std::vector<size_t>& variables) const {
  Values out;
  for (size_t i : variables)
    out.push_back(values_[i]);
  return out;
}

std::vector<Type> Lowering::types_of(const std::vector<size_t>& variables) const {
  std::vector<Type> out;
  for (size_t i : variables)
    out.push_back(variable_types_[i]);
  return out;
}

// What a region declared is out of scope after it: only these have values.
void Lowering::set_values(const std::vector<size_t>& variables, const Values& values) {
  values_.assign(variable_types_.size(), ir::kNoValue);
  for (size_t i = 0; i < variables.size(); ++i)
    values_[variables[i]] = values[i];
}

void Lowering::open_carried(ir::Region& region, const std::vector<size_t>& carried) {
  for (size_t i : carried) {
    region.params.push_back(b_.new_value(variable_types_[i]));
    values_[i] = region.params.back();
  }
}

void Lowering::back_to(const Stmt& s) {
  if (s.range.valid()) b_.where = s.range;
}

void Lowering::statement(const Stmt& s) {
  if (b_.terminated()) return; // not reached
  back_to(s);
  switch (s.kind) {
  case StmtKind::kEmpty:
  case StmtKind::kFunction: break;
  case StmtKind::kBlock: block(static_cast<const BlockStmt&>(s)); break;
  case StmtKind::kDeclaration: {
    const auto& d = static_cast<const DeclarationStmt&>(s);
    if (!d.is_extern)
      for (const Variable* v : d.variables)
        declaration(*v);
    break;
  }
  case StmtKind::kExpression:
    for (const ExprPtr& e : static_cast<const ExpressionStmt&>(s).expressions)
      value(*e);
    break;
  case StmtKind::kIf: if_statement(static_cast<const IfStmt&>(s)); break;
  case StmtKind::kLoop: loop(static_cast<const LoopStmt&>(s)); break;
  case StmtKind::kJump: jump(static_cast<const JumpStmt&>(s)); break;
  case StmtKind::kReturn: return_statement(static_cast<const ReturnStmt&>(s)); break;
  case StmtKind::kIlluminance: illuminance(static_cast<const IlluminanceStmt&>(s)); break;
  case StmtKind::kEmission: emission(static_cast<const EmissionStmt&>(s)); break;
  case StmtKind::kGather: gather(static_cast<const GatherStmt&>(s)); break;
  }
}

void Lowering::block(const BlockStmt& s) {
  size_t declared_from = declared_.size();
  for (const StmtPtr& inner : s.statements)
    statement(*inner);
  if (!b_.terminated())
    forget(declared_from);
  else
    declared_.resize(declared_from);
}

void Lowering::declaration(const Variable& v) {
  if (v.where.valid()) b_.where = v.where;
  if (v.array_length != kNotArray) {
    arrays_[&v] = b_.add_array(v.type, static_cast<uint32_t>(std::max(v.array_length, 1)));
    initialise_array(v);
    return;
  }
  bool outer = std::exchange(uniform_wanted_, v.detail_given && v.detail == Detail::kUniform);
  ValueId initial = v.init ? value(*v.init) : zero(v.type);
  uniform_wanted_ = outer;
  declared_.push_back(index_of(v));
  write(v, initial);
}

void Lowering::initialise_array(const Variable& v) {
  uint32_t array = array_of(v);
  if (const auto* call = v.init ? as<CallExpr>(v.init.get()) : nullptr; call && call->fills_array) {
    b_.array_clear(array);
    value(*call);
    return;
  }
  if (v.init && !as<ArrayInitExpr>(v.init.get())) { // one value for every element
    ValueId x = value(*v.init);
    for (int i = 0; i < v.array_length; ++i)
      b_.array_store(array, b_.number(static_cast<float>(i)), x);
    return;
  }
  b_.array_clear(array);
  if (v.init) array_assignment(array, *v.init);
}

void Lowering::if_statement(const IfStmt& s) {
  two_sided(value(*s.condition), s.then_branch, s.else_branch);
}

void Lowering::two_sided(ValueId condition, const StmtPtr& then_branch, const StmtPtr& else_branch) {
  auto side = [&](const StmtPtr& branch) {
    size_t declared_from = declared_.size();
    if (branch) statement(*branch);
    if (!b_.terminated()) forget(declared_from);
    declared_.resize(declared_from);
    return ir::kNoValue;
  };
  branch(
      condition, Type::kVoid, [&] { return side(then_branch); }, [&] { return side(else_branch); });
}

void Lowering::loop_steps(const LoopStmt& s) {
  for (const ExprPtr& step : s.steps)
    value(*step);
}

void Lowering::loop(const LoopStmt& s) {
  size_t declared_from = declared_.size();
  if (s.init) statement(*s.init);
  Frame frame{true, in_scope(), &s};
  Values initial = values_for(frame.carried);
  frames_.push_back(frame);
  ir::Region body;
  open_carried(body, frame.carried);
  ir::Region* outer = b_.region();
  b_.set_region(&body);
  if (s.condition) {
    ValueId condition = value(*s.condition);
    ir::Region go_on = region([&] { b_.yield({}); });
    ir::Region leave = region([&] { b_.break_out(0, values_for(frame.carried)); });
    std::vector<ir::Region> sides;
    sides.push_back(std::move(go_on));
    sides.push_back(std::move(leave));
    b_.region_inst(ir::Op::kIf, 0, {condition}, std::move(sides), {});
  }
  size_t body_from = declared_.size();
  statement(*s.body);
  if (!b_.terminated()) {
    forget(body_from);
    loop_steps(s);
    b_.next_round(0, values_for(frame.carried));
  }
  declared_.resize(body_from);
  b_.set_region(outer);
  frames_.pop_back();
  std::vector<ir::Region> regions;
  regions.push_back(std::move(body));
  back_to(s);
  ir::InstId id =
      b_.region_inst(ir::Op::kLoop, 0, std::move(initial), std::move(regions), types_of(frame.carried));
  set_values(frame.carried, m_.insts[id].results);
  forget(declared_from);
}

void Lowering::jump(const JumpStmt& s) {
  size_t f = frames_.size();
  for (int to_pass = s.levels; to_pass > 0;)
    to_pass -= frames_[--f].user_loop;
  auto level = static_cast<uint32_t>(frames_.size() - 1 - f);
  if (s.is_break) {
    b_.break_out(level, values_for(frames_[f].carried));
    return;
  }
  if (frames_[f].source) loop_steps(*frames_[f].source);
  b_.next_round(level, values_for(frames_[f].carried));
}

void Lowering::return_statement(const ReturnStmt& s) {
  const Function function = functions_.back();
  if (s.value) values_[function.result] = value(*s.value);
  if (!function.in_block) return; // the last statement
  b_.break_out(static_cast<uint32_t>(frames_.size() - 1 - function.frame),
               values_for(frames_[function.frame].carried));
}

// The optional arguments of a light loop before it: what it sends, and whether its lights must run anew.
bool Lowering::begin_sending(const std::vector<TokenArg>& tokens) {
  bool sends = false;
  for (const TokenArg& t : tokens) {
    std::string_view name = static_cast<const StringExpr&>(*t.token).value;
    if (name == "lightcache") {
      b_.call(slvm::shadeop_overloads("lightcache")[0], Values{value(*t.value)}, {});
    } else if (constexpr std::string_view kSend = "send:light:"; name.starts_with(kSend)) {
      const bool array = t.value->array_length != kNotArray;
      const ValueId sent = array ? load(place(*t.value)) : value(*t.value);
      b_.call(slvm::shadeop_overloads("lightsend")[array ? 1 : 0],
              Values{b_.string(std::string(name.substr(kSend.size()))), sent}, {});
      sends = true;
    }
  }
  return sends;
}

// "light:name" is lightsource("name", variable) at the begin of each round.
void Lowering::receive_from_light(const std::vector<TokenArg>& tokens) {
  for (const TokenArg& t : tokens) {
    std::string_view name = static_cast<const StringExpr&>(*t.token).value;
    if (!t.info->output) continue;
    name.remove_prefix(std::string_view("light:").size());
    Place p = place(*t.value);
    call_into(slvm::shadeop_overloads("lightsource")[p.whole_array ? 1 : 0],
              {b_.string(std::string(name)), load(p)}, {Type::kFloat, t.value->type}, {p});
  }
}

/// A loop whose rounds the machine decides on: lights, or rays.
template <class Body>
void Lowering::rounds(const Stmt& s, ir::Op op, uint32_t index, Values args, Body&& make_body) {
  Frame frame{true, in_scope(), nullptr};
  Values initial = values_for(frame.carried);
  args.insert(args.end(), initial.begin(), initial.end());
  frames_.push_back(frame);
  ir::Region body;
  open_carried(body, frame.carried);
  ir::Region* outer = b_.region();
  b_.set_region(&body);
  make_body();
  if (!b_.terminated()) b_.next_round(0, values_for(frame.carried));
  b_.set_region(outer);
  frames_.pop_back();
  std::vector<ir::Region> regions;
  regions.push_back(std::move(body));
  back_to(s);
  ir::InstId id = b_.region_inst(op, index, std::move(args), std::move(regions), types_of(frame.carried));
  set_values(frame.carried, m_.insts[id].results);
}

void Lowering::illuminance(const IlluminanceStmt& s) {
  store_changed(true); // lights may ask for output parameters
  Values args{s.category ? value(*s.category) : b_.string(""), value(*s.position),
              s.axis ? value(*s.axis) : zero(Type::kVector), s.angle ? value(*s.angle) : zero(Type::kFloat)};
  for (Global g : {Global::kL, Global::kCl, Global::kOl})
    global_slot(g); // bound for each light
  const bool sends = begin_sending(s.tokens);
  rounds(s, ir::Op::kIlluminance, s.axis ? 1 : 0, std::move(args), [&] {
    receive_from_light(s.tokens);
    statement(*s.body);
  });
  if (sends) b_.call(slvm::shadeop_overloads("lightsend")[2], Values(), {});
}

void Lowering::emission(const EmissionStmt& s) {
  ValueId axis = s.axis ? value(*s.axis) : zero(Type::kVector);
  ValueId angle = s.angle ? value(*s.angle) : zero(Type::kFloat);
  Values args;
  if (!s.is_solar) args.push_back(value(*s.position));
  args.push_back(axis);
  args.push_back(angle);
  for (Global g : {Global::kL, Global::kPs, Global::kNs})
    global_slot(g); // what the machine computes light from
  Values before = values_;
  ir::Region body = region([&] {
    size_t declared_from = declared_.size();
    statement(*s.body);
    if (!b_.terminated()) forget(declared_from);
    declared_.resize(declared_from);
    if (!b_.terminated()) store_changed(false); // Cl and Ol, for the emission to be recorded
  });
  std::vector<size_t> changed;
  bool ends = !body.body.empty() && ir::is_terminator(m_.insts[body.body.back()].op);
  for (size_t i = 0; i < before.size() && !ends; ++i)
    if (before[i] != ir::kNoValue && values_[i] != before[i]) changed.push_back(i);
  Values after = ends ? Values() : values_for(changed);
  values_ = before;
  values_.resize(variable_types_.size(), ir::kNoValue);
  if (!ends) {
    ir::Region* outer = b_.region();
    b_.set_region(&body);
    b_.yield(std::move(after));
    b_.set_region(outer);
  }
  Values otherwise = values_for(changed);
  args.insert(args.end(), otherwise.begin(), otherwise.end());
  std::vector<ir::Region> regions;
  regions.push_back(std::move(body));
  back_to(s);
  ir::InstId id = b_.region_inst(s.is_solar ? ir::Op::kSolar : ir::Op::kIlluminate, s.axis ? 1 : 0,
                                 std::move(args), std::move(regions), types_of(changed));
  for (size_t i = 0; i < changed.size(); ++i)
    values_[changed[i]] = m_.insts[id].results[i];
}

// Variables that rays set are named with a value of their type, arrays by themselves.
Lowering::Values Lowering::gather_args(const GatherStmt& s) {
  Values args{value(*s.category), value(*s.position), value(*s.direction)};
  if (!s.is_traverse) {
    args.push_back(value(*s.angle));
    args.push_back(value(*s.samples));
  }
  for (const TokenArg& t : s.tokens) {
    args.push_back(value(*t.token));
    const bool output = t.info && t.info->output;
    if (output && t.value->array_length != kNotArray)
      args.push_back(load(place(*t.value)));
    else
      args.push_back(output ? zero(t.value->type) : value(*t.value));
  }
  add_seed(args);
  return args;
}

void Lowering::receive_from_ray(const std::vector<TokenArg>& tokens) {
  for (const TokenArg& t : tokens) {
    if (!t.info || !t.info->output) continue;
    Place p = place(*t.value);
    call_into(slvm::shadeop_overloads("gathered")[p.whole_array ? 1 : 0], {value(*t.token), load(p)},
              {t.value->type}, {p});
  }
}

// A loop over rays: each round sets the variables, then takes one of the two blocks.
void Lowering::gather(const GatherStmt& s) {
  const ShadeopId row = slvm::shadeop_overloads(s.is_traverse ? "traverse" : "gather")[0];
  rounds(s, ir::Op::kGather, row, gather_args(s), [&] {
    back_to(s);
    const Type hit_type = Type::kBool;
    const ValueId hit = b_.call(slvm::shadeop_overloads("gatherhit")[0], {}, std::span(&hit_type, 1))[0];
    receive_from_ray(s.tokens);
    two_sided(hit, s.body, s.else_body);
  });
}

} // namespace slc
