// texture(), environment(), shadow(), textureinfo(): arguments become a TextureLookup, which the renderer
// answers.
//
// The region a lookup covers (RISpec 3.2, 15.7): with one position, what it moves by from one point of the
// grid to the next; with four, the quadrilateral between them. "width" scales it, "blur" is the renderer's to
// add.
#include "slvm/exec/differences.h"
#include "slvm/exec/query.h"
#include "slvm/exec/rays/ray_means.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace slvm {
namespace {

enum class MapKind : uint8_t { kTexture, kEnvironment, kShadow };

Matrix4 current_to_world(const ShaderRun& run) {
  Matrix4 m;
  run.state.services.current_to_space(run.shading_state(), "world", m);
  return m;
}

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
    scale_region();
    const ShaderRun& run = call_.run;
    uint64_t one_point = run.mask.any();
    lookup_.mask = out_.step ? run.mask.current() : &one_point;
    if (kind_ == MapKind::kShadow) lookup_.current_to_world = current_to_world(run);
    TextureServices* textures = run.state.services.textures();
    std::string problem = !textures                        ? "there are no textures here"
                          : kind_ == MapKind::kTexture     ? textures->texture(lookup_)
                          : kind_ == MapKind::kEnvironment ? textures->environment(lookup_)
                                                           : textures->shadow(lookup_);
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

  // Corners come row by row, as those of a patch, or in turn: the order in which they enclose more is meant.
  void four_corners() {
    for (size_t c = 0; c < dimensions_; ++c) {
      lookup_.centre[c].resize(lookup_.points);
      lookup_.along_u[c].resize(lookup_.points);
      lookup_.along_v[c].resize(lookup_.points);
    }
    for (size_t i = 0; i < lookup_.points; ++i) {
      float rows_u[3] = {}, rows_v[3] = {}, turn_u[3] = {}, turn_v[3] = {};
      for (size_t c = 0; c < dimensions_; ++c) {
        float k[4];
        for (size_t corner = 0; corner < 4; ++corner)
          k[corner] = at(component(corner, c), i);
        lookup_.centre[c][i] = 0.25f * (k[0] + k[1] + k[2] + k[3]);
        rows_u[c] = 0.5f * (k[1] - k[0] + k[3] - k[2]);
        rows_v[c] = 0.5f * (k[2] - k[0] + k[3] - k[1]);
        turn_u[c] = 0.5f * (k[1] - k[0] + k[2] - k[3]);
        turn_v[c] = 0.5f * (k[3] - k[0] + k[2] - k[1]);
      }
      bool rows = enclosed(rows_u, rows_v) >= enclosed(turn_u, turn_v);
      for (size_t c = 0; c < dimensions_; ++c) {
        lookup_.along_u[c][i] = rows ? rows_u[c] : turn_u[c];
        lookup_.along_v[c][i] = rows ? rows_v[c] : turn_v[c];
      }
    }
  }
  static float enclosed(const float (&u)[3], const float (&v)[3]) {
    float x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return x * x + y * y + z * z;
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
      if (token == "blur")
        lookup_.sblur = lookup_.tblur = values(value.planes);
      else if (token == "sblur")
        lookup_.sblur = values(value.planes);
      else if (token == "tblur")
        lookup_.tblur = values(value.planes);
      else if (token == "width")
        swidth_ = twidth_ = values(value.planes);
      else if (token == "swidth")
        swidth_ = values(value.planes);
      else if (token == "twidth")
        twidth_ = values(value.planes);
      else if (token == "bias")
        lookup_.bias = values(value.planes);
      else if (token == "samples")
        lookup_.options.samples = *value.planes.data;
      else if (token == "fill")
        lookup_.options.fill = *value.planes.data;
      else if (token == "lerp")
        lookup_.options.between_levels = *value.planes.data != 0;
      else
        call_.run.report(call_.code, MessageSeverity::kWarning,
                         fmt::format("{}: \"{}\" has no effect", call_.info.name, token), lookup_.points);
    }
  }

  void scale_region() {
    for (size_t c = 0; c < dimensions_; ++c) {
      const std::vector<float>& width = c == 1 && dimensions_ == 2 ? twidth_ : swidth_;
      if (width.empty()) continue;
      for (size_t i = 0; i < lookup_.points; ++i) {
        float scale = TextureLookup::at(width, i);
        lookup_.along_u[c][i] *= scale;
        lookup_.along_v[c][i] *= scale;
      }
    }
  }

  const GridCall& call_;
  MapKind kind_;
  TextureLookup lookup_;
  Operand out_;
  size_t dimensions_ = 2, tokens_from_ = 0;
  std::vector<float> swidth_, twidth_;
};

/// The map that stands for rays.
bool asks_for_rays(const GridCall& call) {
  return text_of(call.run, call.operands[1].planes) == "raytrace";
}

} // namespace

namespace grid_ops {

void texture_lookup(const GridCall& call) {
  LookupCall(call, MapKind::kTexture).run();
}
void environment_lookup(const GridCall& call) {
  if (asks_for_rays(call))
    trace_environment(call);
  else
    LookupCall(call, MapKind::kEnvironment).run();
}
void shadow_lookup(const GridCall& call) {
  if (asks_for_rays(call))
    trace_shadow(call);
  else
    LookupCall(call, MapKind::kShadow).run();
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
