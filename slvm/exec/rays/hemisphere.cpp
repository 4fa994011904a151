// occlusion() and indirectdiffuse(): the renderer looks round for all points at once. And the diffuse light
// of a map.
#include "slvm/exec/differences.h"
#include "slvm/exec/rays/ray_buffer.h"
#include "slvm/exec/rays/shooting.h"
#include "slvm/exec/spaces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <numeric>

namespace slvm {
namespace {

constexpr float kHalfPi = std::numbers::pi_v<float> / 2;

/// Per-point arrays that a query points to.
class HemisphereCall {
public:
  explicit HemisphereCall(const GridCall& call)
      : call_(call), run_(call.run), stores_(count_stores(call)), tokens_(call, stores_ + 3),
        outputs_(call, tokens_) {
    query_.rays = tokens_.ray_options(RayKind::kDiffuse);
    query_.points = run_.points;
    read_points();
    read_tokens();
  }

  /// Asks the renderer for this and what tokens want.
  void ask(bool radiance) {
    query_.rays.shades = radiance;
    result_.assign(3 * run_.points, 0.0f);
    if (radiance)
      each_component([&](size_t c) { query_.radiance[c] = result_.data() + c * run_.points; });
    else
      query_.occlusion = result_.data();
    for (TokenOutput& o : outputs_.list())
      attach(o);
    RayServices* services = ray_services(run_, call_.code, mask_count(run_.mask.current(), run_.points));
    if (!services) return;
    const std::string problem = services->hemisphere(run_.shading_state(), query_);
    if (!problem.empty())
      run_.report(call_.code, MessageSeverity::kWarning, fmt::format("{}: {}", call_.info.name, problem),
                  mask_count(run_.mask.current(), run_.points));
  }

  void store() const {
    store_planes(run_, call_.operands[0], result_);
    outputs_.store();
  }

private:
  template <class F> static void each_component(F&& f) {
    for (size_t c = 0; c < 3; ++c)
      f(c);
  }

  // ---- Where.

  void read_points() {
    const size_t points = run_.points;
    const Operand &p = call_.operands[stores_].planes, &n = call_.operands[stores_ + 1].planes;
    mask_.assign(run_.mask.current(), run_.mask.current() + mask_words(run_.pitch));
    for (auto* triple : {&position_, &normal_, &along_u_, &along_v_})
      for (std::vector<float>& component : *triple)
        component.assign(points, 0.0f);
    mask_for_each(run_.mask.current(), points, [&](size_t i) {
      float squared = 0;
      each_component([&](size_t c) {
        position_[c][i] = p.plane(c)[p.step ? i : 0];
        normal_[c][i] = n.plane(c)[n.step ? i : 0];
        squared += normal_[c][i] * normal_[c][i];
      });
      if (!(squared > 0) || !std::isfinite(squared)) // nowhere to look
        mask_[i / kMaskWordLanes] &= ~(MaskWord{1} << (i % kMaskWordLanes));
      each_component([&](size_t c) { normal_[c][i] /= squared > 0 ? std::sqrt(squared) : 1.0f; });
    });
    const Differences differences(call_);
    for (bool along_u : {true, false})
      differences.for_each(along_u, [&](size_t lane, size_t lo, size_t hi, size_t steps) {
        if (steps && p.step)
          each_component([&](size_t c) {
            (along_u ? along_u_ : along_v_)[c][lane] =
                (p.plane(c)[hi] - p.plane(c)[lo]) / static_cast<float>(steps);
          });
      });
    query_.mask = mask_.data();
    each_component([&](size_t c) {
      query_.position[c] = position_[c].data();
      query_.normal[c] = normal_[c].data();
      query_.along_u[c] = along_u_[c].data();
      query_.along_v[c] = along_v_[c].data();
    });
  }

  // ---- How.

  /// A value of every point, or null when the token is not given.
  const float* per_point(std::string_view token, std::vector<float>& memory) {
    if (!tokens_.has(token)) return nullptr;
    const PointValue value = tokens_.values(token, 0);
    memory.resize(run_.points);
    for (size_t i = 0; i < run_.points; ++i)
      memory[i] = value.at(i);
    return memory.data();
  }

  void read_tokens() {
    const float samples = PointValue(call_.operands[stores_ + 2].planes).at(first_point(run_));
    // Calls that mean a point cloud have no use for samples and say 0.
    const bool cloud =
        tokens_.number("pointbased", 0) != 0 || (samples <= 0 && !tokens_.text("filename").empty());
    constexpr float kInsteadOfCloud = 64;
    query_.samples = static_cast<float>(sample_count(cloud && samples <= 0 ? kInsteadOfCloud : samples));
    query_.min_samples = tokens_.fewest_samples();
    const std::string_view distribution = tokens_.text("distribution");
    query_.cosine = distribution != "uniform";
    query_.cone_angle = per_point("coneangle", cone_angle_);
    query_.max_distance = per_point("maxdist", max_distance_);
    query_.bias = per_point("bias", bias_);
    query_.sample_base = per_point("samplebase", sample_base_);
    if (const float base = default_sample_base(run_, samples); !query_.sample_base && base > 0) {
      sample_base_.assign(run_.points, base);
      query_.sample_base = sample_base_.data();
    }
    if (const PointValue weight = tokens_.weight(); weight.given)
      each_component([&](size_t c) {
        weight_[c].resize(run_.points);
        for (size_t i = 0; i < run_.points; ++i)
          weight_[c][i] = weight.at(i, c);
        query_.weight[c] = weight_[c].data();
      });
    query_.falloff = tokens_.number("falloff", 0);
    query_.falloff_is_power = tokens_.number("falloffmode", 0) != 0;
    query_.max_error = tokens_.number("maxerror", tokens_.number("maxvariation", -1));
    query_.max_pixel_distance = tokens_.number("maxpixeldist", -1);
    query_.environment_map = tokens_.text("environmentmap");
    read_environment_space();
    query_.cache_space = tokens_.text("coordsystem");
    if (cloud)
      run_.report(call_.code, MessageSeverity::kWarning,
                  fmt::format("{}: there are no point clouds here; rays are traced", call_.info.name),
                  mask_count(run_.mask.current(), run_.points));
  }

  void read_environment_space() {
    const std::string_view space = tokens_.text("environmentspace");
    if (!named_space(run_, space, false, query_.to_environment))
      run_.report(call_.code, MessageSeverity::kWarning,
                  fmt::format("{}: there is no coordinate system \"{}\"", call_.info.name, space),
                  mask_count(run_.mask.current(), run_.points));
  }

  void attach(TokenOutput& o) {
    auto zero = [&] { std::fill(o.values.begin(), o.values.end(), 0.0f); };
    if (o.token == "occlusion") {
      zero();
      query_.occlusion = o.values.data();
    } else if (o.token == "environmentcolor" || o.token == "environmentdir") {
      zero();
      each_component([&](size_t c) {
        (o.token == "environmentdir" ? query_.environment_direction : query_.environment_colour)[c] =
            o.values.data() + c * run_.points;
      });
    } else {
      run_.report(call_.code, MessageSeverity::kWarning,
                  fmt::format("{}: \"{}\" is not set", call_.info.name, o.token),
                  mask_count(run_.mask.current(), run_.points));
    }
  }

  const GridCall& call_;
  const ShaderRun& run_;
  size_t stores_;
  CallTokens tokens_;
  TokenOutputs outputs_;
  HemisphereQuery query_;
  std::vector<MaskWord> mask_;
  std::vector<float> position_[3], normal_[3], along_u_[3], along_v_[3], weight_[3];
  std::vector<float> cone_angle_, max_distance_, bias_, sample_base_, result_;
};

/// Lookups of a map for one ray of every point, each over the ray's part of the half space.
class DiffuseLookup {
public:
  DiffuseLookup(const ShaderRun& run, std::string_view map, TextureServices& textures) : textures_(textures) {
    lookup_.map = map;
    lookup_.channels = 3;
    lookup_.points = run.points;
    for (auto* triple : {&lookup_.centre, &lookup_.along_u, &lookup_.along_v})
      for (std::vector<float>& component : *triple)
        component.assign(run.points, 0.0f);
    for (size_t c = 0; c < 3; ++c) {
      result_[c].resize(run.points);
      lookup_.result[c] = result_[c].data();
    }
    lookup_.mask = run.mask.current();
  }

  /// "" or why there is nothing to be seen.
  std::string look(const RaySource& source, const RayBuffer& rays) {
    for (size_t r = 0; r < rays.size(); ++r) {
      float z[3], x[3], y[3];
      for (size_t c = 0; c < 3; ++c)
        z[c] = rays.direction(c, r);
      directions_across(z, x, y);
      const float side = source.spread[rays.place(r)];
      for (size_t c = 0; c < 3; ++c) {
        lookup_.centre[c][rays.point(r)] = z[c];
        lookup_.along_u[c][rays.point(r)] = side * x[c];
        lookup_.along_v[c][rays.point(r)] = side * y[c];
      }
    }
    for (std::vector<float>& component : result_)
      std::fill(component.begin(), component.end(), 0.0f);
    return textures_.environment(lookup_);
  }
  float result(size_t component, size_t point) const { return result_[component][point]; }

private:
  TextureServices& textures_;
  TextureLookup lookup_;
  std::vector<float> result_[3];
};

} // namespace

namespace grid_ops {

void occlusion(const GridCall& call) {
  HemisphereCall hemisphere(call);
  hemisphere.ask(false);
  hemisphere.store();
}

void indirect_diffuse(const GridCall& call) {
  HemisphereCall hemisphere(call);
  hemisphere.ask(true);
  hemisphere.store();
}

// Operands: result, map, direction. The mean of the map in the half space about the direction, by the cosine
// to it.
void environment_diffuse(const GridCall& call) {
  constexpr float kSamples = 64;
  const ShaderRun& run = call.run;
  const GridOperand& out = call.operands[0];
  fill(run, out, 0);
  const std::string_view map = text_of(run, call.operands[1].planes);
  TextureServices* textures = run.state.services.textures();
  if (map.empty()) return; // no map is no mistake
  RaySpec spec;
  const Planes& p = call.run.variable(Global::kP);
  spec.origin = {p.data, p.pitch, p.step, 1};
  spec.direction = call.operands[2].planes;
  spec.angle = kHalfPi;
  spec.samples = kSamples;
  spec.cosine = true;
  RaySource source;
  source.begin(call, spec, 0);
  std::vector<uint32_t> places(source.size());
  std::iota(places.begin(), places.end(), 0u);
  std::string problem = textures ? "" : "there are no textures here";
  if (textures) {
    DiffuseLookup lookup(run, map, *textures);
    RayBuffer rays;
    for (uint32_t sample = 0; sample < source.most_samples() && problem.empty(); ++sample) {
      rays.clear();
      rays.add(source, places, sample);
      problem = lookup.look(source, rays);
      for (size_t r = 0; r < rays.size(); ++r)
        for (size_t c = 0; c < 3; ++c) {
          const size_t at = out.planes.step ? rays.point(r) : 0;
          put(out.planes, c, rays.point(r),
              out.planes.plane(c)[at] + lookup.result(c, rays.point(r)) / kSamples);
        }
    }
  }
  if (!problem.empty())
    run.report(call.code, MessageSeverity::kWarning,
               fmt::format("{} \"{}\": {}", call.info.name, map, problem), source.size());
}

} // namespace grid_ops
} // namespace slvm
