// texture(), environment(), shadow(), textureinfo(): arguments become a TextureLookup, which the renderer
// answers.
//
// The region a lookup covers (RISpec 3.2, 15.7): with one position, what it moves by from one point of the
// grid to the next; with four, the quadrilateral between them. "width" scales it, "blur" is the renderer's to
// add.
#include "slvm/exec/differences.h"
#include "slvm/exec/lookup_region.h"
#include "slvm/exec/query.h"
#include "slvm/exec/rays/ray_means.h"
#include "slvm/exec/run.h"
#include "slvm/exec/spaces.h"

#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace slvm {
namespace {

class LookupCall {
public:
  LookupCall(const GridCall& call, MapKind kind) : call_(call), kind_(kind) {
    out_ = call.operands[0].planes;
    lookup_.map = text_of(call.run, call.operands[1].planes);
    lookup_.first_channel = channel(*call.operands[2].planes.data);
    lookup_.channels = static_cast<uint32_t>(components(call.operands[0].type));
    lookup_.points = out_.step ? call.run.points : 1;
    dimensions_ = kind == MapKind::kTexture ? 2 : 3;
    for (size_t c = 0; c < lookup_.channels; ++c) {
      lookup_.result[c] = out_.plane(c);
      std::fill_n(out_.plane(c), out_.step ? call.run.pitch : kMaxLanes, 0.0f);
    }
  }

  void run() {
    if (lookup_.map.empty()) return; // no map is no mistake
    read_region();
    read_tokens();
    scale_region(lookup_, dimensions_, widths_);
    const ShaderRun& run = call_.run;
    uint64_t one_point = run.mask.any();
    lookup_.mask = out_.step ? run.mask.current() : &one_point;
    if (kind_ == MapKind::kShadow) lookup_.current_to_world = current_to_world(run);
    const std::string problem = look_up(run.state.services.textures(), kind_, lookup_);
    if (!problem.empty())
      run.report(call_.code, MessageSeverity::kWarning,
                 fmt::format("{} \"{}\": {}", call_.info.name, lookup_.map, problem), lookup_.points);
    if (!out_.step)
      for (size_t c = 0; c < lookup_.channels; ++c)
        std::fill_n(out_.plane(c), kMaxLanes, *out_.plane(c));
  }

private:
  static uint32_t channel(float number) {
    return number >= 0 && number < 1e6f ? static_cast<uint32_t>(number) : 0;
  }

  // ---- Where to look.

  void read_region() {
    size_t positional = call_.info.signature.param_count - 2u; // behind name and channel
    size_t corners = positional * static_cast<size_t>(kind_ == MapKind::kTexture ? 1 : 3) / dimensions_;
    tokens_from_ = 3 + positional;
    if (corners == 4)
      four_corners();
    else
      one_position(corners == 1);
  }

  /// Component `c` of corner `k` as an operand of one plane.
  Operand component(size_t k, size_t c) const {
    if (kind_ == MapKind::kTexture) return call_.operands[3 + 2 * k + c].planes;
    Operand o = call_.operands[3 + k].planes;
    o.data = o.plane(c);
    return o;
  }
  static float at(const Operand& o, size_t point) { return o.data[o.step ? point : 0]; }

  void one_position(bool given) {
    Differences differences(call_);
    for (size_t c = 0; c < dimensions_; ++c) {
      Operand o;
      if (given) {
        o = component(0, c);
      } else {
        Planes p = call_.run.variable(c == 0 ? Global::ks : Global::kt);
        o = {p.data, p.pitch, p.step, 1};
      }
      std::vector<float>& centre = lookup_.centre[c];
      centre.resize(lookup_.points);
      for (size_t i = 0; i < lookup_.points; ++i)
        centre[i] = at(o, i);
      auto change = [&](bool along_u) {
        std::vector<float> out(lookup_.points, 0.0f);
        if (o.step && out_.step)
          differences.for_each(along_u, [&](size_t lane, size_t lo, size_t hi, size_t steps) {
            if (steps) out[lane] = (o.data[hi] - o.data[lo]) / static_cast<float>(steps);
          });
        return out;
      };
      lookup_.along_u[c] = change(true);
      lookup_.along_v[c] = change(false);
      if (o.step && out_.step) follow_footprint(lookup_.along_u[c], lookup_.along_v[c]);
    }
  }

  /// Where rays hit, regions are not along u and v but what the ray covers.
  void follow_footprint(std::vector<float>& along_u, std::vector<float>& along_v) const {
    const Grid& grid = *call_.run.state.grid;
    const float* const(&f)[4] = grid.footprint;
    if (!f[0]) return;
    for (size_t i = 0; i < lookup_.points; ++i) {
      size_t hit = i % static_cast<size_t>(grid.nu());
      float u = along_u[i], v = along_v[i];
      along_u[i] = u * f[0][hit] + v * f[1][hit];
      along_v[i] = u * f[2][hit] + v * f[3][hit];
    }
  }

  void four_corners() {
    for (size_t c = 0; c < dimensions_; ++c) {
      lookup_.centre[c].resize(lookup_.points);
      lookup_.along_u[c].resize(lookup_.points);
      lookup_.along_v[c].resize(lookup_.points);
    }
    for (size_t i = 0; i < lookup_.points; ++i) {
      float corners[4][3] = {};
      for (size_t k = 0; k < 4; ++k)
        for (size_t c = 0; c < dimensions_; ++c)
          corners[k][c] = at(component(k, c), i);
      set_region(lookup_, i, dimensions_, corners);
    }
  }

  // ---- Token-value pairs.

  std::vector<float> values(const Operand& o) const {
    std::vector<float> out(o.step ? lookup_.points : 1);
    for (size_t i = 0; i < out.size(); ++i)
      out[i] = at(o, i);
    return out;
  }

  void read_tokens() {
    for (size_t i = tokens_from_; i + 1 < call_.operands.size(); i += 2) {
      std::string_view token = text_of(call_.run, call_.operands[i].planes);
      const GridOperand& value = call_.operands[i + 1];
      if (value.array) continue;
      if (value.type == Type::kString) {
        if (token == "filter") lookup_.options.filter = text_of(call_.run, value.planes);
        continue;
      }
      // For rays, which the same call shoots when the map is named "raytrace".
      if (token == "maxdist" || token == "samplecone") continue;
      if (!set_lookup_option(lookup_, widths_, token, values(value.planes)))
        call_.run.report(call_.code, MessageSeverity::kWarning,
                         fmt::format("{}: \"{}\" has no effect", call_.info.name, token), lookup_.points);
    }
  }

  const GridCall& call_;
  MapKind kind_;
  TextureLookup lookup_;
  Operand out_;
  size_t dimensions_ = 2, tokens_from_ = 0;
  LookupWidths widths_;
};

/// The map that stands for rays.
bool asks_for_rays(const GridCall& call) {
  return text_of(call.run, call.operands[1].planes) == "raytrace";
}

void look_up_texture(const GridCall& call) {
  LookupCall(call, MapKind::kTexture).run();
}
void look_up_environment(const GridCall& call) {
  if (asks_for_rays(call))
    trace_environment(call);
  else
    LookupCall(call, MapKind::kEnvironment).run();
}
void look_up_shadow(const GridCall& call) {
  if (asks_for_rays(call))
    trace_shadow(call);
  else
    LookupCall(call, MapKind::kShadow).run();
}

/// One map and one number of samples serve a whole lookup: points are taken together that have the same ones.
class AlikePoints {
public:
  explicit AlikePoints(const GridCall& call) : call_(call) {
    if (call.operands[1].planes.step) differing_.push_back(1);
    for (size_t i = call.info.signature.param_count + 1u; i + 1 < call.operands.size(); i += 2) {
      if (call.operands[i + 1].planes.step && text_of(call.run, call.operands[i].planes) == "samples")
        differing_.push_back(i + 1);
    }
  }

  void run(GridOp look_up) {
    if (differing_.empty() || !call_.operands[0].planes.step) return look_up(call_);
    const ShaderRun& run = call_.run;
    std::map<std::vector<float>, std::vector<MaskWord>, std::less<>> groups;
    mask_for_each(run.mask.current(), run.points, [&](size_t point) {
      std::vector<MaskWord>& mask = groups[key(point)];
      mask.resize(run.mask.words());
      mask[point / kMaskWordLanes] |= MaskWord{1} << point % kMaskWordLanes;
    });
    const auto planes = static_cast<size_t>(components(call_.operands[0].type));
    result_.resize(planes * run.pitch + kMaxLanes);
    for (const auto& [values, mask] : groups) {
      look_up_some(look_up, values, mask);
      for (size_t c = 0; c < planes; ++c)
        mask_for_each(mask.data(), run.points, [&](size_t point) {
          call_.operands[0].planes.plane(c)[point] = result_[c * run.pitch + point];
        });
    }
  }

private:
  /// What a point has of the operands that differ: handles of names, numbers of samples, in whole ones.
  std::vector<float> key(size_t point) const {
    std::vector<float> out;
    for (size_t i : differing_) {
      const float value = call_.operands[i].planes.data[point];
      if (i == 1)
        out.push_back(static_cast<float>(std::bit_cast<uint32_t>(value)));
      else
        out.push_back(std::isfinite(value) ? std::max(std::round(value), 0.0f) : 0.0f);
    }
    return out;
  }

  void look_up_some(GridOp look_up, const std::vector<float>& values, const std::vector<MaskWord>& mask) {
    std::vector<GridOperand> operands(call_.operands.begin(), call_.operands.end());
    operands[0].planes = {result_.data(), call_.run.pitch, 1, 1};
    std::vector<std::array<float, kMaxLanes>> uniform(differing_.size());
    for (size_t k = 0; k < differing_.size(); ++k) {
      const bool name = differing_[k] == 1;
      uniform[k].fill(name ? std::bit_cast<float>(static_cast<uint32_t>(values[k])) : values[k]);
      operands[differing_[k]].planes = {uniform[k].data(), kMaxLanes, 0, 1};
    }
    call_.run.mask.push_if(mask.data());
    look_up({call_.run, call_.info, operands, call_.level, call_.code});
    call_.run.mask.pop_if();
  }

  const GridCall& call_;
  std::vector<size_t> differing_; ///< operands: the name, the value of "samples"
  std::vector<float> result_;
};

} // namespace

namespace grid_ops {

void texture_lookup(const GridCall& call) {
  AlikePoints(call).run(look_up_texture);
}
void environment_lookup(const GridCall& call) {
  AlikePoints(call).run(look_up_environment);
}
void shadow_lookup(const GridCall& call) {
  AlikePoints(call).run(look_up_shadow);
}

// Operands: result, value stored, map, field, value before.
void texture_query(const GridCall& call) {
  Query q(call, 3);
  std::string_view map = text_of(call.run, call.operands[2].planes);
  TextureServices* textures = call.run.state.services.textures();
  Value value;
  if (!textures || map.empty() || !textures->info(map, q.name, current_to_world(call.run), value))
    return q.not_found();
  q.give(value);
}

} // namespace grid_ops
} // namespace slvm
