// Setting up a run: register memory, and where each external variable of the program is.
#include "slvm/exec/run.h"

#include "slvm/exec/observer.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>

namespace slvm {

ShaderRun::ShaderRun(GridState& s, const Instance& i, const ShaderRun* o)
    : state(s), instance(i), outer(o), program(i.program()), bound(i.bound()) {}

void ShaderRun::prepare(const Operand* position, const Operand* normal, std::span<const SentValue> sent) {
  sent_ = sent;
  points = state.grid->points();
  pitch = state.grid->pitch();
  extra_used_ = 0;
  unset_.clear();
  emission_count = 0;
  light_loop.end();
  gathers.clear();
  emitting = Emitting::kNothing;
  bind_registers();
  slots.resize(program.slots.size());
  for (size_t i = 0; i < slots.size(); ++i) // made in place, since to copy what was just written takes long
    new (&slots[i]) Planes(program.slots[i].parameter
                               ? bind_parameter(i)
                               : bind_variable(bound.globals[i], program.slots[i].stored, position, normal));
  mask.reset(pitch, points);
  resolved_.resize(program.code.size());
  for (uint32_t word : bound.fixed_operands)
    resolve(frame_, program.code[word], resolved_[word]);
}

void ShaderRun::compute_defaults() {
  rounds_left_ = state.machine.options().most_rounds;
  Frame frame = frame_;
  for (auto [section, slot] : bound.defaults)
    if (!override_for(slot)) run_code(frame, program.sections[section]);
}

void ShaderRun::execute() {
  if (state.observer) state.observer->begin_run(instance);
  compute_defaults();
  Frame frame = frame_;
  in_body_ = true;
  run_code(frame, program.sections[0]);
  in_body_ = false;
  if (state.observer) state.observer->end_run(instance);
}

void ShaderRun::bind_registers() {
  size_t strip = std::min<size_t>(state.machine.options().strip_points, pitch);
  size_t uniform = program.uniform_planes * kMaxLanes, strips = program.strip_planes * strip;
  size_t total = uniform + strips + program.grid_planes * pitch;
  float* memory = memory_.reserve(std::max<size_t>(total, 1));
  if (state.machine.options().poison_registers)
    std::fill_n(memory, total, std::numeric_limits<float>::signaling_NaN());
  frame_ = {};
  frame_.data[0] = bound.constants.data();
  frame_.data[1] = memory;
  frame_.data[2] = memory + uniform;
  frame_.data[3] = memory + uniform + strips;
  frame_.pitch[0] = frame_.pitch[1] = kMaxLanes;
  frame_.pitch[2] = strip;
  frame_.pitch[3] = pitch;
  frame_.step[2] = frame_.step[3] = 1;
  frame_.lanes = frame_.end = pitch;
  frame_.active = points;
  frame_.context = {&state.machine.strings(), random_seed()};
  operands_.resize(bound.most_operands);
}

float* ShaderRun::take(size_t floats) {
  if (extra_used_ == extra_.size()) extra_.emplace_back();
  return extra_[extra_used_++].reserve(floats);
}

Planes ShaderRun::take_uniform(Type type, std::initializer_list<float> value) {
  float* data = take(value.size() * kMaxLanes);
  size_t i = 0;
  for (float x : value)
    std::fill_n(data + i++ * kMaxLanes, kMaxLanes, x);
  return {data, kMaxLanes, 0, type, 0};
}

// A variable the program stores to, in memory of the run, with the values of `from` (zero when null).
Planes ShaderRun::take_copy(const Slot& slot, const Planes& from) {
  size_t planes = static_cast<size_t>(components(slot.type)) * std::max(slot.elements, 1u);
  size_t lanes = slot.varying ? pitch : kMaxLanes;
  Planes to{take(planes * lanes), lanes, slot.varying ? 1u : 0u, slot.type, slot.elements};
  if (!from.data) std::memset(to.data, 0, planes * lanes * sizeof(float));
  for (size_t i = 0; from.data && i < planes; ++i) {
    float* plane = to.data + i * lanes;
    if (from.step && slot.varying)
      std::memcpy(plane, from.data + i * from.pitch, lanes * sizeof(float));
    else
      std::fill_n(plane, lanes, from.data[i * from.pitch]);
  }
  return to;
}

const Planes* ShaderRun::override_for(size_t i) const {
  const Slot& slot = program.slots[i];
  auto fits = [&](const Planes& p) { return p.type == slot.type && p.elements == slot.elements; };
  for (const SentValue& sent : sent_)
    if (sent.name == slot.name && fits(sent.planes)) return &sent.planes;
  // Primitive variables belong to the surface that is lit, or to that of an area light.
  const Planes* primvar = on_emitter                           ? on_emitter->primvar(slot.name)
                          : program.kind == ShaderKind::kLight ? nullptr
                                                               : state.grid->primvar(slot.name);
  return primvar && fits(*primvar) ? primvar : nullptr;
}

Planes ShaderRun::bind_parameter(size_t i) {
  const Slot& slot = program.slots[i];
  const Planes* other = override_for(i);
  Planes value = other ? *other : bound.param_planes[i];
  // A uniform parameter takes its value at the first point of a varying one.
  bool must_copy = slot.stored || !value.data || (value.step && !slot.varying);
  return must_copy ? take_copy(slot, value) : value;
}

Planes ShaderRun::bind_variable(Global g, bool stored, const Operand* position, const Operand* normal) {
  auto from_operand = [](const Operand& o, Type t) { return Planes{o.data, o.pitch, o.step, t, 0}; };
  bool light = program.kind == ShaderKind::kLight;
  const Slot own{std::string(), global_info(g).type, 0, false, true, true};
  if (light) {
    if (g == Global::kPs && position) return from_operand(*position, Type::kPoint);
    if (g == Global::kNs && normal) return from_operand(*normal, Type::kNormal);
    if (g == Global::kL || g == Global::kCl || g == Global::kOl) return take_copy(own, {});
    if (g == Global::kP && !on_emitter) { // where the light is
      std::array<float, 3> at = transform_point(instance.shader_to_current(), {0, 0, 0});
      return take_uniform(Type::kPoint, {at[0], at[1], at[2]});
    }
  } else if (stored) {
    state.grid->varying(g);
    return state.grid->variable(g);
  } else if (g == Global::kL || g == Global::kCl || g == Global::kOl) {
    return take_uniform(own.type, {0, 0, 0}); // until a light loop binds them
  }
  const Planes& p = given(g);
  if (!p.data) return default_variable(g);
  bool uniform_needed = global_info(g).detail == Detail::kUniform && p.step;
  return uniform_needed ? take_copy({std::string(), p.type, 0, false, false, true}, p) : p;
}

// Parameters of the surface, as a renderer would set them: u and v from 0 to 1 over the grid.
Planes ShaderRun::lattice(Global g) {
  const Grid& grid = *state.grid;
  bool along_u = g == Global::ku || g == Global::kdu;
  int n = along_u ? grid.nu() : grid.rows_of_piece();
  float step = n > 1 ? 1.0f / static_cast<float>(n - 1) : 1.0f;
  if (g == Global::kdu || g == Global::kdv) return take_uniform(Type::kFloat, {step});
  float* data = take(pitch);
  for (int iv = 0, i = 0; iv < grid.nv(); ++iv)
    for (int iu = 0; iu < grid.nu(); ++iu, ++i)
      data[i] = static_cast<float>(along_u ? iu : iv % n) * (n > 1 ? step : 0);
  std::fill(data + points, data + pitch, 0.0f);
  return {data, pitch, 1, Type::kFloat, 0};
}

const Planes& ShaderRun::given(Global g) const {
  if (on_emitter)
    if (const Planes& own = on_emitter->variable(g); own.data) return own;
  return state.grid->variable(g);
}

const Planes& ShaderRun::variable(Global g) {
  const Planes& p = given(g);
  if (p.data) return p;
  auto [it, is_new] = unset_.try_emplace(g);
  if (is_new) it->second = default_variable(g);
  return it->second;
}

// What a variable is that the renderer did not set.
Planes ShaderRun::default_variable(Global g) {
  auto like = [&](Global other) {
    Planes p = state.grid->variable(other);
    if (!p.data) p = default_variable(other);
    p.type = global_info(g).type;
    return p;
  };
  switch (g) {
  case Global::ku:
  case Global::kv:
  case Global::kdu:
  case Global::kdv: return lattice(g);
  case Global::ks: return like(Global::ku);
  case Global::kt: return like(Global::kv);
  case Global::kNg:
  case Global::kNs: return like(Global::kN);
  case Global::kPs: return like(Global::kP);
  case Global::kI: return like(Global::kP); // the eye is at the origin of camera space
  case Global::kncomps: return take_uniform(Type::kFloat, {3});
  case Global::kalpha: return take_uniform(Type::kFloat, {1});
  case Global::kCs:
  case Global::kOs: return take_uniform(Type::kColor, {1, 1, 1});
  default: break;
  }
  Type type = global_info(g).type;
  return components(type) == 1 ? take_uniform(type, {0}) : take_uniform(type, {0, 0, 0});
}

const Planes* ShaderRun::parameter(std::string_view name) const {
  for (const Param& p : program.params)
    if (p.name == name && p.slot >= 0) return &slots[static_cast<size_t>(p.slot)];
  return nullptr;
}

void ShaderRun::report(uint32_t code, MessageSeverity severity, std::string text, size_t count) const {
  const SourcePlace place = place_of(program, code);
  RuntimeMessage message;
  message.severity = severity;
  message.file = place.line ? place.file : program.source_name;
  message.line = place.line;
  message.text = std::move(text);
  message.points = count;
  message.total = points;
  message.shader = std::string(shader_kind_name(program.kind)) + " \"" + program.name + "\"";
  state.machine.report(message);
}

} // namespace slvm
