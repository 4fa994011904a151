// A shader as a whole: parameters and their defaults, predefined variables, what is stored back at the end.
#include "slc/lower/lower.h"
#include "slc/lower/lowering.h"

#include <algorithm>
#include <cassert>

namespace slc {

Lowering::Lowering(const Shader& shader, std::vector<std::string> files, std::vector<slvm::SourceCall>& calls)
    : shader_(shader), b_(m_), calls_(calls) {
  m_.kind = shader.kind;
  m_.name = shader.name;
  m_.files = std::move(files);
  random_counter_ = new_index(Type::kFloat); // index 0: never in a frame's way, means "none" elsewhere
}

ir::Module Lowering::run() {
  lower_params();
  lower_body();
  return std::move(m_);
}

// ---- External variables.

uint32_t Lowering::slot_of(const std::string& name, Type type, uint32_t elements, bool parameter,
                           bool varying) {
  for (size_t i = 0; i < m_.slots.size(); ++i)
    if (m_.slots[i].parameter == parameter && m_.slots[i].name == name) return static_cast<uint32_t>(i);
  m_.slots.push_back({name, type, elements, parameter, varying, false});
  return static_cast<uint32_t>(m_.slots.size() - 1);
}

uint32_t Lowering::global_slot(Global g) {
  const slvm::GlobalInfo& info = slvm::global_info(g);
  return slot_of(std::string(info.name), info.type, 0, false, info.detail == Detail::kVarying);
}

void Lowering::lower_params() {
  for (const Variable* v : shader_.params) {
    slvm::Param& p = m_.params.emplace_back();
    p.name = v->name;
    p.type = v->type;
    p.elements = v->array_length == kNotArray ? 0 : static_cast<uint32_t>(v->array_length);
    p.varying = v->detail_given && v->detail == Detail::kVarying;
    p.output = v->output;
    uint32_t slot = slot_of(p.name, p.type, p.elements, true, p.varying);
    p.slot = static_cast<int32_t>(slot);
    param_slots_[v] = slot;
    if (p.elements) arrays_[v] = b_.add_array(p.type, p.elements, p.slot);
  }
  for (size_t i = 0; i < shader_.params.size(); ++i)
    lower_init(*shader_.params[i], m_.params[i]);
  for (size_t i = 0; i < shader_.params.size(); ++i) { // after all inits: settle_defaults tells them apart
    const Expr* plain = spaceless_default(*shader_.params[i]);
    if (!plain) continue;
    values_.assign(variable_types_.size(), ir::kNoValue);
    ir::Region r = region([&] { b_.yield({value(*plain)}); });
    m_.params[i].default_space = shader_.params[i]->init_space;
    m_.params[i].default_value.elements =
        static_cast<uint32_t>(m_.inits.size()); // where the plain value is computed
    m_.inits.push_back(std::move(r));
  }
}

// The code of a default: yields the value, or all elements of an array.
void Lowering::lower_init(const Variable& param, slvm::Param& out) {
  values_.assign(variable_types_.size(), ir::kNoValue);
  ir::Region r = region([&] {
    values_[random_counter_] = b_.number(0);
    uniform_wanted_ = !out.varying;
    Values results;
    if (const auto* list = as<ArrayInitExpr>(param.init.get())) {
      for (const ExprPtr& e : list->elements)
        results.push_back(value(*e));
    } else {
      results.assign(std::max(out.elements, 1u), value(*param.init));
    }
    while (results.size() < out.elements)
      results.push_back(zero(param.type));
    uniform_wanted_ = false;
    b_.yield(std::move(results));
  });
  out.init = static_cast<int32_t>(m_.inits.size());
  m_.inits.push_back(std::move(r));
}

// What stands behind the space in `point "shader" (0, 0, 1)`: introspection shows it as written.
const Expr* Lowering::spaceless_default(const Variable& param) const {
  if (param.init_space.empty() || param.type == Type::kColor) return nullptr;
  const Expr* e = param.init.get();
  while (const auto* convert = as<ConvertExpr>(e))
    e = convert->operand.get();
  if (const auto* c = as<CallExpr>(e)) return c->args.empty() ? nullptr : c->args.back().get();
  if (const auto* o = as<OperatorExpr>(e)) return o->operands.size() == 2 ? o->operands[1].get() : nullptr;
  return nullptr;
}

// ---- Variables.

size_t Lowering::new_index(Type t) {
  variable_types_.push_back(t);
  values_.resize(variable_types_.size(), ir::kNoValue);
  return variable_types_.size() - 1;
}

size_t Lowering::index_of(const Variable& v) {
  if (v.kind == VariableKind::kGlobal)
    if (size_t i = global_index_[static_cast<size_t>(v.global)]) return i;
  auto it = indices_.find(&v);
  return it != indices_.end() ? it->second : indices_[&v] = new_index(v.type);
}

slvm::ir::ValueId Lowering::zero(Type t) {
  if (t == Type::kString) return b_.string("");
  return b_.constant({t, std::vector<float>(static_cast<size_t>(slvm::components(t)), 0.0f), {}});
}

slvm::ir::ValueId Lowering::read(const Variable& v) {
  size_t i = index_of(v);
  values_.resize(variable_types_.size(), ir::kNoValue);
  if (values_[i] != ir::kNoValue) return values_[i];
  if (v.kind == VariableKind::kGlobal) return b_.slot(global_slot(v.global));
  if (v.kind == VariableKind::kParameter) return b_.slot(param_slots_.at(&v));
  return zero(v.type); // read in a branch where its declaration was never reached
}

void Lowering::write(const Variable& v, ValueId value) {
  if (v.kind == VariableKind::kGlobal && !global_index_[static_cast<size_t>(v.global)]) {
    b_.store(global_slot(v.global),
             value); // L of lights, which illuminate and solar set too: it stays memory
    return;
  }
  size_t i = index_of(v);
  values_.resize(variable_types_.size(), ir::kNoValue);
  values_[i] = value;
}

void Lowering::forget(size_t declared_from) {
  values_.resize(variable_types_.size(), ir::kNoValue);
  for (size_t i = declared_from; i < declared_.size(); ++i)
    values_[declared_[i]] = ir::kNoValue;
  declared_.resize(declared_from);
}

uint32_t Lowering::array_of(const Variable& v) {
  auto it = arrays_.find(&v);
  assert(it != arrays_.end());
  return it->second;
}

// ---- The body.

namespace {

// Different shaders draw different random numbers: each counts from a place of its own. Exact in a float for
// the first 2^23 calls.
float random_start(std::string_view name) {
  uint32_t h = 2166136261u;
  for (char c : name)
    h = (h ^ static_cast<unsigned char>(c)) * 16777619u;
  return static_cast<float>(h & 0x7fffff);
}

bool returns_somewhere(const Stmt* s) {
  if (!s) return false;
  if (as<ReturnStmt>(s)) return true;
  if (const auto* x = as<BlockStmt>(s))
    return std::any_of(x->statements.begin(), x->statements.end(),
                       [](const StmtPtr& p) { return returns_somewhere(p.get()); });
  if (const auto* x = as<IfStmt>(s))
    return returns_somewhere(x->then_branch.get()) || returns_somewhere(x->else_branch.get());
  if (const auto* x = as<LoopStmt>(s)) return returns_somewhere(x->body.get());
  if (const auto* x = as<IlluminanceStmt>(s)) return returns_somewhere(x->body.get());
  if (const auto* x = as<EmissionStmt>(s)) return returns_somewhere(x->body.get());
  if (const auto* x = as<GatherStmt>(s))
    return returns_somewhere(x->body.get()) || returns_somewhere(x->else_body.get());
  return false;
}

bool only_tail_return(const BlockStmt& body) {
  for (size_t i = 0; i < body.statements.size(); ++i) {
    const Stmt* s = body.statements[i].get();
    bool last = i + 1 == body.statements.size();
    if (last && as<ReturnStmt>(s)) return true;
    if (returns_somewhere(s)) return false;
  }
  return true;
}

} // namespace

// Variables the shader may store to have a value from the start; the others are read where they are used.
void Lowering::begin_variables() {
  auto begin = [&](size_t variable, uint32_t slot) {
    values_[variable] = b_.slot(slot);
    stored_back_.emplace_back(variable, slot);
  };
  values_.assign(variable_types_.size(), ir::kNoValue);
  values_[random_counter_] = b_.number(random_start(shader_.name));
  for (int g = 0; g < slvm::kGlobalCount; ++g) {
    const slvm::GlobalInfo& info = slvm::global_info(static_cast<Global>(g));
    if (info.access[static_cast<size_t>(shader_.kind)] != 'w' || g == static_cast<int>(Global::kL)) continue;
    global_index_[g] = new_index(info.type);
    begin(global_index_[g], global_slot(static_cast<Global>(g)));
  }
  begin_copies();
  outputs_from_ = stored_back_.size();
  for (const Variable* v : shader_.params)
    if (v->output && v->array_length == kNotArray) begin(index_of(*v), param_slots_.at(v));
  initial_ = values_;
}

// What is read-only and changed all the same: variables of the shader's own, with these values at first.
void Lowering::begin_copies() {
  for (Global g : shader_.copied) {
    const size_t index = new_index(slvm::global_info(g).type);
    global_index_[static_cast<size_t>(g)] = index;
    values_[index] = b_.slot(global_slot(g));
  }
  for (const Variable* v : shader_.params) {
    if (!v->copied) continue;
    if (v->array_length == kNotArray) {
      const size_t index = index_of(*v);
      values_[index] = b_.slot(param_slots_.at(v));
      continue;
    }
    const uint32_t given = arrays_.at(v), own = b_.add_array(v->type, static_cast<uint32_t>(v->array_length));
    for (int i = 0; i < v->array_length; ++i) {
      const ValueId at = b_.number(static_cast<float>(i));
      b_.array_store(own, at, b_.array_load(given, at));
    }
    arrays_[v] = own;
  }
}

void Lowering::lower_body() {
  m_.body = region([&] {
    begin_variables();
    function_body(*shader_.body, 0);
    store_changed(false);
    b_.yield({});
  });
}

// A return that is the last statement just ends; any other leaves a block around the body.
void Lowering::function_body(const BlockStmt& body, size_t result) {
  functions_.push_back({result, !only_tail_return(body), frames_.size()});
  if (!functions_.back().in_block) {
    block(body);
    functions_.pop_back();
    return;
  }
  Frame frame;
  frame.carried = in_scope();
  frames_.push_back(frame);
  ir::Region inner = region([&] {
    block(body);
    if (!b_.terminated()) b_.break_out(0, values_for(frame.carried));
  });
  frames_.pop_back();
  functions_.pop_back();
  std::vector<ir::Region> regions;
  regions.push_back(std::move(inner));
  ir::InstId id = b_.region_inst(ir::Op::kBlock, 0, {}, std::move(regions), types_of(frame.carried));
  set_values(frame.carried, m_.insts[id].results);
}

// Stores what the shader changed of its variables: at the end, and where lights may look at output
// parameters.
void Lowering::store_changed(bool outputs_only) {
  for (size_t i = outputs_only ? outputs_from_ : 0; i < stored_back_.size(); ++i) {
    auto [variable, slot] = stored_back_[i];
    size_t current = variable;
    for (auto [passed, formal] : lent_)
      if (passed == current) current = formal;
    if (values_[current] != initial_[variable]) b_.store(slot, values_[current]);
  }
}

slvm::ir::Module lower_shader(const Shader& shader, std::vector<std::string> files,
                              std::vector<slvm::SourceCall>& calls) {
  return Lowering(shader, std::move(files), calls).run();
}

} // namespace slc
