// Lights on a grid: running them, keeping what they emit, looping over it.
#include "slvm/exec/lights.h"

#include "slvm/exec/run.h"
#include "slvm/support/sample_sequence.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace slvm {

LightCache::LightCache() = default;
LightCache::~LightCache() = default;

namespace {

/// How often a light runs for each point it lights.
uint32_t samples_of(const Instance& light) {
  return light.emitter() ? light.emitter()->samples() : 1;
}

// A uniform triple of zeros. Kernels only read it.
alignas(kPlaneAlign) constexpr float kNothing[3 * kMaxLanes] = {};

size_t operand_floats(const Operand& o, size_t pitch) {
  return 3 * (o.step ? pitch : 1);
}

// Points and normals as plain numbers, to see whether they are the same another time.
void save(const Operand& o, size_t pitch, std::vector<float>& out) {
  out.resize(operand_floats(o, pitch));
  size_t lanes = out.size() / 3;
  for (size_t i = 0; i < 3; ++i)
    std::memcpy(out.data() + i * lanes, o.plane(i), lanes * sizeof(float));
}

bool same(const Operand& o, size_t pitch, const std::vector<float>& saved) {
  if (saved.size() != operand_floats(o, pitch)) return false;
  size_t lanes = saved.size() / 3;
  for (size_t i = 0; i < 3; ++i)
    if (std::memcmp(saved.data() + i * lanes, o.plane(i), lanes * sizeof(float)) != 0) return false;
  return true;
}

/// Brings the run of an area light to its points for this sample: for each lit point another one. All points
/// of a hit of a ray have the same, so that what shaders make of the light has derivatives there.
void place_on_emitter(GridState& state, LitGrid& g) {
  const Grid& lit = *state.grid;
  if (!g.on_emitter)
    g.on_emitter = std::make_unique<Grid>(lit.nu(), lit.nv());
  else
    g.on_emitter->reset(lit.nu(), lit.nv());
  const SobolSample sample(g.sample.sample);
  std::vector<float> x(lit.points()), y(lit.points());
  const size_t samples = lit.samples();
  for (size_t i = 0; i < samples; ++i) {
    const uint32_t seed = point_seed(lit.id, g.sample.light, static_cast<uint32_t>(i));
    x[i] = scrambled(sample.bits[0], scramble_seed(seed, SampleUse::kTurn));
    y[i] = scrambled(sample.bits[1], scramble_seed(seed, SampleUse::kRadius));
  }
  for (size_t i = samples; i < x.size(); ++i) {
    x[i] = x[i - samples];
    y[i] = y[i - samples];
  }
  g.light->emitter()->place(x, y, g.run->program, *g.on_emitter);
  g.run->on_emitter = g.on_emitter.get();
  g.run->emitter_seed = point_seed(lit.id, g.sample.light, g.sample.sample);
}

/// Makes the colours of a light that ran its part of the whole.
void share(ShaderRun& run, float part) {
  if (!run.slot(Global::kCl)) return; // it is black
  for (size_t i = 0; i < run.emission_count; ++i) {
    const Planes& colour = run.emissions[i].colour;
    for (size_t c = 0; c < 3; ++c)
      for (size_t k = 0; k < (colour.step ? run.pitch : kMaxLanes); ++k)
        colour.data[c * colour.pitch + k] *= part;
  }
}

} // namespace

LitGrid& LightCache::light(GridState& state, const ShaderRun& by, const Instance& light, LightSample sample,
                           const Operand& position, const Operand& normal, std::span<const SentValue> sent) {
  size_t pitch = state.grid->pitch();
  const Instance::Bound& bound = light.bound();
  bool uses_normal = bound.slot_of[static_cast<size_t>(Global::kNs)] >= 0;
  if (!bound.reads_messages && sent.empty())
    for (size_t i = 0; i < used_; ++i) {
      LitGrid& g = *grids_[i];
      if (g.light_id == light.id() && g.sample.sample == sample.sample && same(position, pitch, g.position) &&
          (!uses_normal || same(normal, pitch, g.normal))) {
        g.last_use = ++uses_;
        return g;
      }
    }
  const Instance& shader = sent.empty() ? light : open(state.machine, light);
  LitGrid& g = place_for(shader.id(), sample.sample);
  g.last_use = ++uses_;
  if (g.light_id != shader.id()) {
    g.run = std::make_unique<ShaderRun>(state, shader, &by);
    g.light = &light;
    g.light_id = shader.id();
  }
  g.sample = sample;
  g.run->outer = &by;
  if (light.emitter()) place_on_emitter(state, g);
  save(position, pitch, g.position);
  if (uses_normal) save(normal, pitch, g.normal);
  g.run->prepare(&position, &normal, sent);
  g.run->execute();
  end_light(*g.run);
  if (light.emitter()) share(*g.run, 1 / static_cast<float>(samples_of(light)));
  return g;
}

LitGrid& LightCache::place_for(uint64_t light_id, uint32_t sample) {
  // The open loop looks at the latest of each light only: the one not asked for longest can go.
  LitGrid* oldest = nullptr;
  size_t kept = 0;
  for (size_t i = 0; i < used_; ++i) {
    LitGrid& g = *grids_[i];
    if (g.light_id != light_id || g.sample.sample != sample) continue;
    ++kept;
    if (!oldest || g.last_use < oldest->last_use) oldest = &g;
  }
  if (kept >= kKept) return *oldest;
  size_t place = used_;
  auto is_other = [&](const LitGrid& g) { return g.light_id != light_id || g.sample.sample != sample; };
  while (place < grids_.size() && is_other(*grids_[place]))
    ++place;
  if (place == grids_.size()) grids_.push_back(std::make_unique<LitGrid>());
  std::swap(grids_[used_], grids_[place]);
  return *grids_[used_++];
}

const Instance& LightCache::open(const Machine& machine, const Instance& light) {
  auto [entry, is_new] = open_.try_emplace(light.id());
  std::unique_ptr<const Instance>& known = entry->second;
  if (is_new) {
    auto again = machine.unspecialised(light);
    if (again)
      known = std::move(*again);
    else
      machine.report({MessageSeverity::kError, light.program().source_name, 0,
                      "light \"" + light.shader().name() + "\"",
                      "no values can be sent to it: " + again.error()});
  }
  return known ? *known : light;
}

void LightLoop::send(std::string_view name, Type type, uint32_t elements, const Operand& value,
                     size_t pitch) {
  SentValue& sent = sent_.emplace_back();
  const size_t lanes = value.step ? pitch : kMaxLanes;
  const size_t planes = static_cast<size_t>(components(type)) * std::max(elements, 1u);
  sent.name = name;
  sent.planes = {sent.memory.reserve(planes * lanes), lanes, value.step, type, elements};
  for (size_t i = 0; i < planes; ++i)
    std::memcpy(sent.planes.data + i * lanes, value.plane(i), lanes * sizeof(float));
}

void LightLoop::begin(ShaderRun& run, std::string_view category, const Operand& position, const Operand* axis,
                      const Operand* angle) {
  rounds_.clear();
  at_ = 0;
  has_cone_ = axis != nullptr;
  if (has_cone_) axis_ = *axis, angle_ = *angle;
  lanes_.resize(mask_words(run.pitch));
  Operand normal = position;
  if (axis) {
    normal = *axis;
  } else {
    const Planes& n = run.state.grid->variable(Global::kN);
    if (n.data) normal = {n.data, n.pitch, n.step, 1};
  }
  uint32_t number = 0;
  for (const Instance* light : run.state.services.lights(run.shading_state())) {
    ++number;
    if (!light->bound().emits || !category_matches(category, light->categories())) continue;
    for (uint32_t sample = 0; sample < samples_of(*light); ++sample) {
      LitGrid& lit =
          run.state.lights.light(run.state, run, *light, {number, sample}, position, normal, sent_);
      for (size_t i = 0; i < lit.run->emission_count; ++i)
        rounds_.emplace_back(&lit, &lit.run->emissions[i]);
    }
  }
}

// "" all; "a" lights in category a; "-a" lights that are not; "a,b" lights in any of them.
bool LightLoop::category_matches(std::string_view wanted, std::span<const std::string> categories) {
  if (wanted.empty()) return true;
  auto has = [&](std::string_view name) {
    return std::find(categories.begin(), categories.end(), name) != categories.end();
  };
  bool any = false;
  while (!wanted.empty()) {
    size_t comma = wanted.find(',');
    std::string_view name = wanted.substr(0, comma);
    wanted = comma == wanted.npos ? std::string_view() : wanted.substr(comma + 1);
    while (!name.empty() && name.front() == ' ')
      name.remove_prefix(1);
    while (!name.empty() && name.back() == ' ')
      name.remove_suffix(1);
    any |= name.starts_with('-') ? !has(name.substr(1)) : has(name);
  }
  return any;
}

namespace {

Operand as_operand(const Planes& p) {
  return {p.data, p.pitch, p.step, 1};
}

void call(Kernel kernel, const Operand& out, std::initializer_list<Operand> in, size_t lanes) {
  Operand operands[4] = {out};
  std::copy(in.begin(), in.end(), operands + 1);
  kernel(operands, static_cast<uint32_t>(1 + in.size()), out.step ? lanes : kMaxLanes, {});
}

// cos(PI/2) in floats is not 0: a right angle means the half space.
float cosine_of(float angle) {
  float c = std::cos(angle);
  return std::fabs(c) < 1e-6f ? 0.0f : c;
}

/// Lanes where the angle between axis and direction is at most `angle`.
void cone_lanes(ShaderRun& run, const Operand& axis, const Operand& direction, const Operand& angle,
                PlaneMemory& memory, std::vector<MaskWord>& lanes) {
  size_t pitch = run.pitch;
  float* inside = memory.reserve(2 * pitch);
  Operand cosine{inside + pitch, pitch, angle.step, 1};
  if (angle.step)
    std::transform(angle.data, angle.data + run.points, cosine.data, cosine_of);
  else
    std::fill_n(cosine.data, kMaxLanes, cosine_of(*angle.data));
  call(run.state.light_kernels.in_cone, {inside, pitch, 1, 1}, {axis, direction, cosine}, pitch);
  lanes.resize(mask_words(pitch));
  run.state.machine.kernels().mask_of_bools(lanes.data(), inside, pitch);
}

void all_points(const ShaderRun& run, std::vector<MaskWord>& lit) {
  lit.resize(mask_words(run.pitch));
  mask_set_all(lit.data(), run.points);
}

} // namespace

namespace {

/// Whether an area light shines from the origin of its space, as lights do that know nothing of surfaces: it
/// then means the points of the surface.
bool stands_at_origin(const ShaderRun& run, const Operand& from) {
  if (!run.on_emitter) return false;
  constexpr float kRounding = 1e-6f;
  const Matrix4& m = run.instance.shader_to_current();
  const std::array<float, 3> origin = transform_point(m, {0, 0, 0});
  const float near = kRounding * (std::fabs(origin[0]) + std::fabs(origin[1]) + std::fabs(origin[2]));
  for (size_t i = 0; i < (from.step ? run.points : 1); ++i)
    for (size_t c = 0; c < 3; ++c)
      if (!(std::fabs(from.plane(c)[i] - origin[c]) <= near)) return false;
  return true;
}

} // namespace

LightKernels::LightKernels(const KernelTable& kernels) {
  auto find = [&](std::string_view name, std::string_view signature) {
    return kernels[static_cast<ShadeopId>(find_shadeop(name, signature))];
  };
  subtract = find("operator-", "vector(point a, point b)");
  negate = find("operator-", "vector(vector a)");
  normalize = find("normalize", "vector(vector v)");
  in_cone = find("incone", "bool(vector axis, vector direction, float cosine)");
}

bool LightLoop::next(ShaderRun& run, const MaskWord* in_loop) {
  for (; at_ < rounds_.size(); ++at_) {
    auto [lit, emission] = rounds_[at_];
    if (has_cone_) {
      cone_lanes(run, axis_, as_operand(emission->to_light), angle_, inside_, lanes_);
      mask_and(lanes_.data(), lanes_.data(), emission->lit.data(), run.pitch);
    } else {
      lanes_ = emission->lit;
    }
    MaskWord some = 0;
    for (size_t i = 0; i < lanes_.size(); ++i)
      some |= lanes_[i] & in_loop[i];
    if (!some) continue;
    ++at_;
    current_ = lit;
    distant_ = emission->distant;
    if (Planes* p = run.slot(Global::kL)) *p = emission->to_light;
    if (Planes* p = run.slot(Global::kCl)) *p = emission->colour;
    if (Planes* p = run.slot(Global::kOl)) *p = emission->opacity;
    return true;
  }
  return false;
}

void begin_illuminate(ShaderRun& run, const Operand& from, const Operand* axis, const Operand* angle,
                      std::vector<MaskWord>& lit) {
  Operand l = as_operand(*run.slot(Global::kL));
  const Operand& place =
      stands_at_origin(run, from) ? as_operand(run.on_emitter->variable(Global::kP)) : from;
  call(run.state.light_kernels.subtract, l, {as_operand(*run.slot(Global::kPs)), place}, run.pitch);
  all_points(run, lit);
  if (!axis) return;
  std::vector<MaskWord> points = lit;
  cone_lanes(run, *axis, l, *angle, run.cone_memory, lit);
  mask_and(lit.data(), lit.data(), points.data(), run.pitch);
}

// Light along the axis, of length 1; without axis from everywhere: towards the surface, -Ns.
void begin_solar(ShaderRun& run, const Operand* axis, const Operand*, std::vector<MaskWord>& lit) {
  Operand l = as_operand(*run.slot(Global::kL));
  call(run.state.light_kernels.normalize, l, {axis ? *axis : as_operand(*run.slot(Global::kNs))}, run.pitch);
  if (!axis) call(run.state.light_kernels.negate, l, {l}, run.pitch);
  all_points(run, lit);
}

void end_emission(ShaderRun& run, const std::vector<MaskWord>& lit) {
  if (run.emission_count == run.emissions.size()) run.emissions.emplace_back();
  Emission& e = run.emissions[run.emission_count++];
  e.lit = lit;
  e.distant = run.emitting == ShaderRun::Emitting::kSolar;
  size_t pitch = run.pitch;
  bool stays = run.bound.emits_once || !run.bound.emits; // nothing will overwrite the run's own variables
  float* memory = e.memory.reserve((stays ? 3 : 12) * pitch);
  auto take = [&](Global g) {
    const Planes* own = run.slot(g);
    if (!own) return Planes{const_cast<float*>(kNothing), kMaxLanes, 0, Type::kColor, 0};
    if (stays) return *own;
    memory += 3 * pitch;
    for (size_t c = 0; c < 3; ++c)
      std::memcpy(memory + c * pitch, own->data + c * own->pitch, pitch * sizeof(float));
    return Planes{memory, pitch, 1, own->type, 0};
  };
  e.to_light = {memory, pitch, 1, Type::kVector, 0};
  e.from_light = take(Global::kL);
  e.colour = take(Global::kCl);
  e.opacity = take(Global::kOl);
  call(run.state.light_kernels.negate, as_operand(e.to_light), {as_operand(e.from_light)}, pitch);
}

void end_light(ShaderRun& run) {
  if (run.emission_count > 0) {
    if (run.emission_count > 1 || run.bound.emits_once) return;
    // One block ran, of several: its colour is what the shader made of it.
    std::vector<MaskWord> lit = run.emissions[0].lit;
    const bool distant = run.emissions[0].distant;
    run.emission_count = 0;
    end_emission(run, lit);
    run.emissions[0].distant = distant;
  } else if (!run.bound.emits) {
    std::vector<MaskWord> lit;
    all_points(run, lit);
    end_emission(run, lit);
  }
}

namespace grid_ops {

void send_to_lights(const GridCall& call) {
  const GridOperand& name = call.operands[0];
  const GridOperand& value = call.operands[1];
  call.run.light_loop.send(call.run.state.machine.strings().text(std::bit_cast<uint32_t>(*name.planes.data)),
                           value.type, value.array ? value.planes.elements : 0, value.planes, call.run.pitch);
}

void send_nothing(const GridCall& call) {
  call.run.light_loop.send_nothing();
}

void light_cache(const GridCall& call) {
  std::string_view mode =
      call.run.state.machine.strings().text(std::bit_cast<uint32_t>(*call.operands[0].planes.data));
  if (mode == "refresh")
    call.run.state.lights.clear();
  else if (mode != "reuse")
    call.run.report(call.code, MessageSeverity::kError,
                    fmt::format("\"lightcache\" is \"reuse\" or \"refresh\", not \"{}\"", mode),
                    call.run.points);
}

namespace {

void add_colour(const Emission& e, const Operand& out, size_t lanes) {
  for (size_t c = 0; c < 3; ++c) {
    const float* from = e.colour.data + c * e.colour.pitch;
    float* to = out.plane(c);
    if (e.colour.step)
      for (size_t i = 0; i < lanes; ++i)
        to[i] += from[i];
    else
      for (size_t i = 0; i < lanes; ++i)
        to[i] += *from;
  }
}

} // namespace

// Sum of Cl over the lights that have no illuminate or solar.
void ambient(const GridCall& call) {
  ShaderRun& run = call.run;
  const Operand& out = call.operands[0].planes;
  for (size_t c = 0; c < 3; ++c)
    std::fill_n(out.plane(c), run.pitch, 0.0f);
  const Planes& p = run.state.grid->variable(Global::kP);
  const Planes& n = run.state.grid->variable(Global::kN);
  Operand origin{const_cast<float*>(kNothing), kMaxLanes, 0, 1};
  Operand position = p.data ? as_operand(p) : origin, normal = n.data ? as_operand(n) : origin;
  uint32_t number = 0;
  for (const Instance* light : run.state.services.lights(run.shading_state())) {
    ++number;
    if (light->bound().emits) continue;
    for (uint32_t sample = 0; sample < samples_of(*light); ++sample)
      add_colour(run.state.lights.light(run.state, run, *light, {number, sample}, position, normal)
                     .run->emissions[0],
                 out, run.pitch);
  }
}

} // namespace grid_ops
} // namespace slvm
