// Lights on a grid: running them, keeping what they emit, looping over it.
#include "slvm/exec/lights.h"

#include "slvm/exec/run.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace slvm {

LightCache::LightCache() = default;
LightCache::~LightCache() = default;

namespace {

size_t operand_floats(const Operand& o, size_t pitch) { return 3 * (o.step ? pitch : 1); }

// Points and normals as plain numbers, to see whether they are the same another time.
void save(const Operand& o, size_t pitch, std::vector<float>& out) {
  out.resize(operand_floats(o, pitch));
  size_t lanes = out.size() / 3;
  for (size_t i = 0; i < 3; ++i) std::memcpy(out.data() + i * lanes, o.plane(i), lanes * sizeof(float));
}

bool same(const Operand& o, size_t pitch, const std::vector<float>& saved) {
  if (saved.size() != operand_floats(o, pitch)) return false;
  size_t lanes = saved.size() / 3;
  for (size_t i = 0; i < 3; ++i)
    if (std::memcmp(saved.data() + i * lanes, o.plane(i), lanes * sizeof(float)) != 0) return false;
  return true;
}

} // namespace

LitGrid& LightCache::light(GridState& state, const ShaderRun& by, const Instance& light, const Operand& position,
                           const Operand& normal) {
  size_t pitch = state.grid->pitch();
  const Instance::Bound& bound = light.bound();
  bool uses_normal = bound.slot_of[static_cast<size_t>(Global::kNs)] >= 0;
  if (!bound.reads_messages)
    for (size_t i = 0; i < used_; ++i) {
      LitGrid& g = *grids_[i];
      if (g.light_id == light.id() && same(position, pitch, g.position) && (!uses_normal || same(normal, pitch, g.normal))) return g;
    }
  // A place whose run was of this light keeps its registers.
  size_t place = used_;
  while (place < grids_.size() && grids_[place]->light_id != light.id()) ++place;
  if (place == grids_.size()) grids_.push_back(std::make_unique<LitGrid>());
  std::swap(grids_[used_], grids_[place]);
  LitGrid& g = *grids_[used_++];
  if (g.light_id != light.id() || g.run->outer != &by) {
    g.run = std::make_unique<ShaderRun>(state, light, &by);
    g.light = &light;
    g.light_id = light.id();
  }
  save(position, pitch, g.position);
  if (uses_normal) save(normal, pitch, g.normal);
  g.run->prepare(&position, &normal);
  g.run->execute();
  // The colour at the end of the shader counts, for lights that finish it after their (only) block.
  if (g.run->emission_count == 0) {
    std::vector<MaskWord> lit(mask_words(pitch));
    mask_set_all(lit.data(), g.run->points);
    end_emission(*g.run, lit);
  } else if (g.run->emission_count == 1) {
    std::vector<MaskWord> lit = g.run->emissions[0].lit;
    g.run->emission_count = 0;
    end_emission(*g.run, lit);
  }
  return g;
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
  for (const Instance* light : run.state.services.lights(run.shading_state())) {
    if (!light->bound().emits || !category_matches(category, light->categories())) continue;
    LitGrid& lit = run.state.lights.light(run.state, run, *light, position, normal);
    for (size_t i = 0; i < lit.run->emission_count; ++i) rounds_.emplace_back(&lit, &lit.run->emissions[i]);
  }
}

// "" all; "a" lights in category a; "-a" lights that are not; "a,b" lights in any of them.
bool LightLoop::category_matches(std::string_view wanted, std::span<const std::string> categories) {
  if (wanted.empty()) return true;
  auto has = [&](std::string_view name) { return std::find(categories.begin(), categories.end(), name) != categories.end(); };
  bool any = false;
  while (!wanted.empty()) {
    size_t comma = wanted.find(',');
    std::string_view name = wanted.substr(0, comma);
    wanted = comma == wanted.npos ? std::string_view() : wanted.substr(comma + 1);
    while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
    while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
    any |= name.starts_with('-') ? !has(name.substr(1)) : has(name);
  }
  return any;
}

namespace {

// Lanes where the angle between axis and direction is at most `angle`: their cosine is compared, without division.
void cone_lanes(const Operand& axis, const Operand& direction, const Operand& angle, size_t points, float* inside) {
  const float *ax = axis.plane(0), *ay = axis.plane(1), *az = axis.plane(2);
  const float *lx = direction.plane(0), *ly = direction.plane(1), *lz = direction.plane(2);
  size_t as = axis.step, ls = direction.step;
  auto test = [&](size_t i, float cosine) {
    float dot = ax[i * as] * lx[i * ls] + ay[i * as] * ly[i * ls] + az[i * as] * lz[i * ls];
    float lengths = std::sqrt((ax[i * as] * ax[i * as] + ay[i * as] * ay[i * as] + az[i * as] * az[i * as]) *
                              (lx[i * ls] * lx[i * ls] + ly[i * ls] * ly[i * ls] + lz[i * ls] * lz[i * ls]));
    return dot >= cosine * lengths ? 1.0f : 0.0f;
  };
  // cos(PI/2) in floats is not 0: a right angle means the half space.
  auto cosine_of = [](float a) {
    float c = std::cos(a);
    return std::fabs(c) < 1e-6f ? 0.0f : c;
  };
  if (angle.step == 0) {
    float cosine = cosine_of(angle.data[0]);
    for (size_t i = 0; i < points; ++i) inside[i] = test(i, cosine);
  } else {
    for (size_t i = 0; i < points; ++i) inside[i] = test(i, cosine_of(angle.data[i]));
  }
}

void mask_of_floats(const float* inside, size_t points, std::vector<MaskWord>& mask, size_t pitch) {
  mask.assign(mask_words(pitch), 0);
  for (size_t i = 0; i < points; ++i)
    mask[i / kMaskWordLanes] |= MaskWord{inside[i] != 0} << (i % kMaskWordLanes);
}

Operand as_operand(const Planes& p) { return {p.data, p.pitch, p.step, 1}; }

} // namespace

bool LightLoop::next(ShaderRun& run, const MaskWord* in_loop) {
  for (; at_ < rounds_.size(); ++at_) {
    auto [lit, emission] = rounds_[at_];
    if (has_cone_) {
      inside_.resize(run.pitch);
      cone_lanes(axis_, as_operand(emission->to_light), angle_, run.points, inside_.data());
      mask_of_floats(inside_.data(), run.points, lanes_, run.pitch);
      mask_and(lanes_.data(), lanes_.data(), emission->lit.data(), run.pitch);
    } else {
      std::copy(emission->lit.begin(), emission->lit.end(), lanes_.begin());
    }
    MaskWord some = 0;
    for (size_t i = 0; i < lanes_.size(); ++i) some |= lanes_[i] & in_loop[i];
    if (!some) continue;
    ++at_;
    current_ = lit;
    if (Planes* p = run.slot(Global::kL)) *p = emission->to_light;
    if (Planes* p = run.slot(Global::kCl)) *p = emission->colour;
    if (Planes* p = run.slot(Global::kOl)) *p = emission->opacity;
    return true;
  }
  return false;
}

void begin_illuminate(ShaderRun& run, const Operand& from, const Operand* axis, const Operand* angle,
                      std::vector<MaskWord>& lit) {
  Planes* l = run.slot(Global::kL);
  Planes ps = *run.slot(Global::kPs);
  for (size_t c = 0; c < 3; ++c) {
    float* to = l->data + c * l->pitch;
    const float *p = ps.data + c * ps.pitch, *f = from.plane(c);
    for (size_t i = 0; i < run.points; ++i) to[i] = p[i * ps.step] - f[i * from.step];
  }
  lit.assign(mask_words(run.pitch), 0);
  if (!axis) {
    mask_set_all(lit.data(), run.points);
    return;
  }
  std::vector<float> inside(run.pitch);
  cone_lanes(*axis, as_operand(*l), *angle, run.points, inside.data());
  mask_of_floats(inside.data(), run.points, lit, run.pitch);
}

// Light along the axis, of length 1; without axis from everywhere: towards the surface, -Ns.
void begin_solar(ShaderRun& run, const Operand* axis, const Operand*, std::vector<MaskWord>& lit) {
  Planes* l = run.slot(Global::kL);
  Operand direction = axis ? *axis : as_operand(*run.slot(Global::kNs));
  float sign = axis ? 1.0f : -1.0f;
  for (size_t i = 0; i < run.points; ++i) {
    float x = direction.plane(0)[i * direction.step], y = direction.plane(1)[i * direction.step],
          z = direction.plane(2)[i * direction.step];
    float length = std::sqrt(x * x + y * y + z * z);
    float scale = length > 0 ? sign / length : 0;
    l->data[i] = x * scale;
    l->data[l->pitch + i] = y * scale;
    l->data[2 * l->pitch + i] = z * scale;
  }
  lit.assign(mask_words(run.pitch), 0);
  mask_set_all(lit.data(), run.points);
}

void end_emission(ShaderRun& run, const std::vector<MaskWord>& lit) {
  if (run.emission_count == run.emissions.size()) run.emissions.emplace_back();
  Emission& e = run.emissions[run.emission_count++];
  size_t pitch = run.pitch;
  float* memory = e.memory.reserve(12 * pitch);
  e.pitch = pitch;
  e.lit = lit;
  auto take = [&](size_t plane, Type t, Global g, float sign) {
    Planes to{memory + plane * pitch, pitch, 1, t, 0};
    const Planes* from = run.slot(g);
    for (size_t c = 0; c < 3; ++c)
      for (size_t i = 0; i < pitch; ++i)
        to.data[c * pitch + i] = from ? sign * from->data[c * from->pitch + (from->step ? i : 0)] : 0.0f;
    return to;
  };
  e.from_light = take(0, Type::kVector, Global::kL, 1);
  e.to_light = take(3, Type::kVector, Global::kL, -1);
  e.colour = take(6, Type::kColor, Global::kCl, 1);
  e.opacity = take(9, Type::kColor, Global::kOl, 1);
}

namespace grid_ops {

// Sum of Cl over the lights that have no illuminate or solar.
void ambient(const GridCall& call) {
  ShaderRun& run = call.run;
  const Operand& out = call.operands[0].planes;
  for (size_t c = 0; c < 3; ++c) std::fill_n(out.plane(c), run.pitch, 0.0f);
  const Planes& p = run.state.grid->variable(Global::kP);
  const Planes& n = run.state.grid->variable(Global::kN);
  static constexpr float kOrigin[3 * kMaxLanes] = {};
  Operand origin{const_cast<float*>(kOrigin), kMaxLanes, 0, 1};
  Operand position = p.data ? as_operand(p) : origin, normal = n.data ? as_operand(n) : origin;
  for (const Instance* light : run.state.services.lights(run.shading_state())) {
    if (light->bound().emits) continue;
    const Emission& e = run.state.lights.light(run.state, run, *light, position, normal).run->emissions[0];
    for (size_t c = 0; c < 3; ++c) {
      const float* from = e.colour.data + c * e.colour.pitch;
      float* to = out.plane(c);
      for (size_t i = 0; i < run.pitch; ++i) to[i] += from[i];
    }
  }
}

} // namespace grid_ops
} // namespace slvm
