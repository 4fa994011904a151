// transmission() and shadow("raytrace"): light that comes through from one point to another.
#include "slvm/exec/rays/ray_means.h"
#include "slvm/exec/rays/shooting.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace slvm {
namespace {

/// What comes through along the rays of each active point, by colour.
class Transmission {
public:
  Transmission(const GridCall& call, const RaySpec& spec, const RayOptions& options, float fewest)
      : call_(call), options_(options) {
    if (meet_nothing(call.run)) return; // no point has a result of its own
    source_.begin(call, spec, options.seed);
    for (auto& sums : sums_)
      sums.assign(source_.size(), 0.0);
    shot_.assign(source_.size(), 0);
    mixed_.assign(source_.size(), 0);
    first_.resize(source_.size());
    shoot(fewest);
  }

  size_t size() const { return source_.size(); }
  size_t point(size_t place) const { return source_.point[place]; }
  float through(size_t place, size_t component) const {
    return shot_[place] ? static_cast<float>(sums_[component][place] / shot_[place]) : 1.0f;
  }
  float mean(size_t place) const { return (through(place, 0) + through(place, 1) + through(place, 2)) / 3; }

private:
  // The first `fewest` rays of each point; then the rest of those points whose rays do not agree.
  void shoot(float fewest) {
    std::vector<uint32_t> places(source_.size());
    std::iota(places.begin(), places.end(), 0u);
    const uint32_t all = source_.most_samples();
    const uint32_t some = fewest >= 1 ? std::min(sample_count(fewest), all) : all;
    add(places, 0, some);
    std::erase_if(places, [&](uint32_t i) { return !mixed_[i]; });
    if (some < all) add(places, some, all);
  }

  void add(std::span<const uint32_t> places, uint32_t first, uint32_t last) {
    RayServices* services = ray_services(call_.run, call_.code, places.size());
    for_each_batch(source_, places, first, last, [&](const RayBuffer& rays) {
      const size_t count = rays.size();
      through_.assign(3 * count, 1.0f);
      float* const result[3] = {through_.data(), through_.data() + count, through_.data() + 2 * count};
      if (services && count)
        services->transmission(call_.run.shading_state(), options_, rays.batch(), result);
      for (size_t r = 0; r < count; ++r) {
        const uint32_t i = rays.place(r);
        const std::array<float, 3> t{result[0][r], result[1][r], result[2][r]};
        if (!shot_[i]++) first_[i] = t;
        mixed_[i] |= t != first_[i];
        for (size_t c = 0; c < 3; ++c)
          sums_[c][i] += static_cast<double>(t[c]);
      }
    });
  }

  const GridCall& call_;
  RayOptions options_;
  RaySource source_;
  std::vector<double> sums_[3];
  std::vector<uint32_t> shot_;
  std::vector<uint8_t> mixed_;
  std::vector<std::array<float, 3>> first_;
  std::vector<float> through_;
};

RaySpec spec_of(const GridCall& call, const CallTokens& tokens, const PointValue& cone,
                const PointValue& samples) {
  RaySpec spec;
  spec.to_target = true;
  spec.angle = tokens.has("samplecone") ? tokens.values("samplecone", 0) : cone;
  spec.samples = tokens.has("samples") ? PointValue(tokens.number("samples", 1)) : samples;
  spec.bias = tokens.values("bias", -1);
  spec.sample_base = tokens.values("samplebase", default_sample_base(call.run, spec.samples));
  spec.weight = tokens.weight();
  return spec;
}

/// Where the light is that shines on a point: in its own shader, or in the light loop of a surface.
class LightPosition {
public:
  explicit LightPosition(const ShaderRun& run) : run_(run) {
    in_light_ = run.program.kind == ShaderKind::kLight;
    const int32_t slot = run.bound.slot_of[static_cast<size_t>(Global::kL)];
    if (slot >= 0) l_ = &run.slots[static_cast<size_t>(slot)];
    inside_ = l_ && (in_light_ ? run.emitting != ShaderRun::Emitting::kNothing
                               : run.light_loop.current() != nullptr);
    distant_ = in_light_ ? run.emitting == ShaderRun::Emitting::kSolar : run.light_loop.is_distant();
    own_ = transform_point(run.instance.shader_to_current(), {0, 0, 0});
  }
  bool known() const { return inside_ || in_light_; }
  /// Seen from `from`; distant lights are far away.
  float component(size_t point, size_t c, float from) const {
    constexpr float kFar = 1e6f;
    if (!inside_) return run_.on_emitter ? run_.on_emitter->variable(Global::kP).get(c, point) : own_[c];
    const float to_light = (in_light_ ? -1.0f : 1.0f) * l_->get(c, point);
    return from + (distant_ ? kFar : 1.0f) * to_light;
  }

private:
  const ShaderRun& run_;
  const Planes* l_ = nullptr;
  bool in_light_ = false, inside_ = false, distant_ = false;
  std::array<float, 3> own_{};
};

} // namespace

float cone_of_corners(std::span<const GridOperand> corners, size_t point, float* mean, size_t pitch) {
  float unit[4][3], length = 0;
  for (size_t c = 0; c < 3; ++c)
    mean[c * pitch] = 0;
  for (size_t k = 0; k < 4; ++k) {
    const Operand& o = corners[k].planes;
    float squared = 0;
    for (size_t c = 0; c < 3; ++c) {
      unit[k][c] = o.plane(c)[o.step ? point : 0];
      squared += unit[k][c] * unit[k][c];
    }
    for (size_t c = 0; c < 3; ++c) {
      unit[k][c] = squared > 0 ? unit[k][c] / std::sqrt(squared) : 0.0f;
      mean[c * pitch] += unit[k][c] / 4;
    }
  }
  for (size_t c = 0; c < 3; ++c)
    length += mean[c * pitch] * mean[c * pitch];
  length = std::sqrt(length);
  float least = 1;
  for (size_t k = 0; k < 4 && length > 0; ++k) {
    float cosine = 0;
    for (size_t c = 0; c < 3; ++c)
      cosine += unit[k][c] * mean[c * pitch] / length;
    least = std::min(least, cosine);
  }
  return least < 1 - 1e-6f ? std::acos(std::max(least, -1.0f)) : 0.0f;
}

// Operands: result, map, channel, one position or four, pairs. Light is missing where it does not come
// through.
void trace_shadow(const GridCall& call) {
  const ShaderRun& run = call.run;
  const size_t corners = call.info.signature.param_count - 2u, pitch = run.pitch;
  const CallTokens tokens(call, 3 + corners);
  const LightPosition light(run);
  fill(run, call.operands[0], 0);
  if (!light.known()) {
    run.report(call.code, MessageSeverity::kWarning, "shadow \"raytrace\": there is no light here",
               mask_count(run.mask.current(), run.points));
    return;
  }
  std::vector<float> from(3 * pitch), to(3 * pitch), angle(pitch);
  RaySpec spec = spec_of(call, tokens, 0, 1);
  const PointValue blur = tokens.values("blur", 0), cone = spec.angle;
  bool cones = false;
  mask_for_each(run.mask.current(), run.points, [&](size_t i) {
    for (size_t c = 0; c < 3; ++c) {
      float& middle = from[c * pitch + i];
      for (size_t k = 0; k < corners; ++k) {
        const Operand& o = call.operands[3 + k].planes;
        middle += o.plane(c)[o.step ? i : 0] / static_cast<float>(corners);
      }
      to[c * pitch + i] = light.component(i, c, middle);
    }
    angle[i] = cone.at(i) + std::numbers::pi_v<float> * blur.at(i);
    cones = cones || angle[i] > 0;
  });
  spec.sample_base = 0;         // positions of masked points are not there to be differentiated
  if (!cones) spec.samples = 1; // of a map one samples an area; these rays would all be the same
  spec.origin = {from.data(), pitch, 1, 1};
  spec.direction = {to.data(), pitch, 1, 1};
  spec.angle = PointValue(Operand{angle.data(), pitch, 1, 1});
  const Transmission through(call, spec, tokens.ray_options(RayKind::kTransmission), 0);
  for (size_t i = 0; i < through.size(); ++i)
    for (size_t c = 0; c < static_cast<size_t>(components(call.operands[0].type)); ++c)
      put(call.operands[0].planes, c, through.point(i),
          1 - (call.operands[0].type == Type::kFloat ? through.mean(i) : through.through(i, c)));
}

namespace grid_ops {

// Operands: result, a, b, perhaps cone and samples, pairs.
void transmission(const GridCall& call) {
  const bool positional = call.info.signature.param_count == 4;
  const CallTokens tokens(call, positional ? 5 : 3);
  RaySpec spec = spec_of(call, tokens, positional ? PointValue(call.operands[3].planes) : PointValue(0),
                         positional ? PointValue(call.operands[4].planes) : PointValue(1));
  spec.origin = call.operands[1].planes;
  spec.direction = call.operands[2].planes;
  spec.differentials = true; // surfaces on the way may be textured
  const Transmission through(call, spec, tokens.ray_options(RayKind::kTransmission), tokens.fewest_samples());
  fill(call.run, call.operands[0], 1);
  for (size_t i = 0; i < through.size(); ++i)
    for (size_t c = 0; c < static_cast<size_t>(components(call.operands[0].type)); ++c)
      put(call.operands[0].planes, c, through.point(i),
          call.operands[0].type == Type::kFloat ? through.mean(i) : through.through(i, c));
}

} // namespace grid_ops
} // namespace slvm
