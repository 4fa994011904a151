// From operands to points that shoot rays.
#include "slvm/exec/rays/ray_source.h"

#include "slvm/exec/differences.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slvm {

// T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
void directions_across(const float (&z)[3], float (&x)[3], float (&y)[3]) {
  const float sign = std::copysign(1.0f, z[2]);
  const float a = -1.0f / (sign + z[2]), b = z[0] * z[1] * a;
  x[0] = 1.0f + sign * z[0] * z[0] * a;
  x[1] = sign * b;
  x[2] = -sign * z[0];
  y[0] = b;
  y[1] = sign + z[1] * z[1] * a;
  y[2] = -z[1];
}

namespace {

float at(const Operand& o, size_t component, size_t point) {
  return o.plane(component)[o.step ? point : 0];
}

void resize(PointTriples& triples, size_t size) {
  for (PointArray& component : triples)
    component.resize(size);
}

} // namespace

void RaySource::begin(const GridCall& call, const RaySpec& spec, uint32_t call_seed) {
  cosine = spec.cosine;
  differentials = spec.differentials;
  read_points(call.run, spec, call_seed);
  read_cones(spec);
  read_differences(call, spec, call_seed);
  scattered_ = !base.empty() || !cosine_of_angle.empty();
}

void RaySource::read_points(const ShaderRun& run, const RaySpec& spec, uint32_t call_seed) {
  point.clear();
  mask_for_each(run.mask.current(), run.points, [&](size_t i) { point.push_back(static_cast<uint32_t>(i)); });
  const size_t count = point.size();
  samples.resize(count);
  for (SampleUse use : {SampleUse::kTurn, SampleUse::kRadius})
    seeds[static_cast<size_t>(use)].resize(count);
  shoots.resize(count);
  resize(origin, count);
  resize(axis, count);
  const bool limited = spec.to_target || spec.max_distance.given;
  max_distance.resize(limited ? count : 0);
  bias.resize(spec.bias.given ? count : 0);
  for (PointArray& component : weight)
    component.resize(spec.weight.given ? count : 0);
  most_samples_ = 0;
  for (size_t i = 0; i < count; ++i) {
    const size_t from = point[i];
    const float asked = spec.samples.at(from);
    samples[i] = spec.may_be_none && asked < 0.5f ? 0 : sample_count(asked);
    most_samples_ = std::max(most_samples_, samples[i]);
    const uint32_t seed = point_seed(run.random_seed(), call_seed, point[i]);
    for (SampleUse use : {SampleUse::kTurn, SampleUse::kRadius})
      seeds[static_cast<size_t>(use)][i] = scramble_seed(seed, use);
    if (limited) max_distance[i] = spec.max_distance.at(from);
    if (spec.bias.given) bias[i] = spec.bias.at(from);
    for (size_t c = 0; c < 3 && spec.weight.given; ++c)
      weight[c][i] = spec.weight.at(from, c);
    read_direction(spec, i);
  }
}

void RaySource::read_direction(const RaySpec& spec, size_t i) {
  double d[3], squared = 0;
  bool finite = true;
  for (size_t c = 0; c < 3; ++c) {
    origin[c][i] = at(spec.origin, c, point[i]);
    d[c] = at(spec.direction, c, point[i]);
    if (spec.to_target) d[c] -= origin[c][i];
    squared += d[c] * d[c];
    finite = finite && std::isfinite(origin[c][i]);
  }
  const double length = std::sqrt(squared);
  const bool directed = length > 0 && std::isfinite(length);
  shoots[i] = !spec.direction_counts || (finite && directed);
  for (size_t c = 0; c < 3; ++c)
    axis[c][i] = directed ? static_cast<float>(d[c] / length) : 0.0f;
  if (spec.to_target) max_distance[i] = std::min(max_distance[i], static_cast<float>(length));
}

// The cone's edge is at z = cos(angle). Cosine-weighted cones go no farther than the half space, where the
// weight ends.
void RaySource::read_cones(const RaySpec& spec) {
  auto angle_at = [&](size_t i) {
    const float angle = spec.angle.at(point[i]);
    return angle > 0 ? std::min(angle, std::numbers::pi_v<float>) : 0.0f; // not a number: 0
  };
  bool cones = false;
  for (size_t i = 0; i < size() && !cones; ++i)
    cones = angle_at(i) > 0;
  const size_t count = cones ? size() : 0;
  for (PointTriples* triples : {&tangent, &bitangent})
    resize(*triples, count);
  cosine_of_angle.resize(count);
  squared_sine.resize(count);
  spread.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const float angle = cosine ? std::min(angle_at(i), std::numbers::pi_v<float> / 2) : angle_at(i);
    const float s = std::sin(angle);
    cosine_of_angle[i] = std::cos(angle);
    squared_sine[i] = s * s;
    // Solid angle of the cone, or what it is worth by cosine, in as many parts as there are samples.
    const float size_of_cone =
        cosine ? std::numbers::pi_v<float> * s * s : 2 * std::numbers::pi_v<float> * (1 - cosine_of_angle[i]);
    spread[i] = std::sqrt(std::max(size_of_cone, 0.0f) / static_cast<float>(std::max(samples[i], 1u)));
    float z[3] = {axis[0][i], axis[1][i], axis[2][i]}, x[3], y[3];
    directions_across(z, x, y);
    for (size_t c = 0; c < 3; ++c) {
      tangent[c][i] = x[c];
      bitangent[c][i] = y[c];
    }
  }
}

void RaySource::read_differences(const GridCall& call, const RaySpec& spec, uint32_t call_seed) {
  bool based = false;
  for (size_t i = 0; i < size() && !based; ++i)
    based = spec.sample_base.at(point[i]) > 0;
  base.resize(based ? size() : 0);
  for (SampleUse use : {SampleUse::kBaseU, SampleUse::kBaseV})
    seeds[static_cast<size_t>(use)].resize(base.size());
  for (size_t i = 0; i < base.size(); ++i) {
    base[i] = std::clamp(spec.sample_base.at(point[i]), 0.0f, 1.0f);
    const uint32_t seed = point_seed(call.run.random_seed(), call_seed, point[i]);
    for (SampleUse use : {SampleUse::kBaseU, SampleUse::kBaseV})
      seeds[static_cast<size_t>(use)][i] = scramble_seed(seed, use);
  }
  if ((!based && !differentials) || size() == 0) return;
  std::vector<uint32_t> place(call.run.points, ~0u);
  for (size_t i = 0; i < size(); ++i)
    place[point[i]] = static_cast<uint32_t>(i);
  auto take = [&](const Operand& o, bool along_u, PointTriples& out) {
    for (PointArray& component : out)
      component.assign(size(), 0.0f);
    if (!o.step) return;
    Differences(call).for_each(along_u, [&](size_t lane, size_t lo, size_t hi, size_t steps) {
      if (!steps || place[lane] == ~0u) return;
      for (size_t c = 0; c < 3; ++c)
        out[c][place[lane]] = (o.plane(c)[hi] - o.plane(c)[lo]) / static_cast<float>(steps);
    });
  };
  take(spec.origin, true, origin_u);
  take(spec.origin, false, origin_v);
  if (!differentials) return;
  take(spec.direction, true, axis_u);
  take(spec.direction, false, axis_v);
  turn_axes(spec);
  read_widths();
}

// Of the direction at length 1: what lies along it does not turn it.
void RaySource::turn_axes(const RaySpec& spec) {
  for (size_t i = 0; i < size(); ++i) {
    double squared = 0, d[3];
    for (size_t c = 0; c < 3; ++c) {
      d[c] = at(spec.direction, c, point[i]) - (spec.to_target ? origin[c][i] : 0.0f);
      squared += d[c] * d[c];
    }
    const float scale = squared > 0 ? static_cast<float>(1 / std::sqrt(squared)) : 0.0f;
    for (auto [along, moves] : {std::pair(&axis_u, &origin_u), std::pair(&axis_v, &origin_v)}) {
      float turn[3], parallel = 0;
      for (size_t c = 0; c < 3; ++c) {
        turn[c] = ((*along)[c][i] - (spec.to_target ? (*moves)[c][i] : 0.0f)) * scale;
        parallel += turn[c] * axis[c][i];
      }
      for (size_t c = 0; c < 3; ++c)
        (*along)[c][i] = turn[c] - parallel * axis[c][i];
    }
  }
}

// From one point to the next (Igehy 1999, section 3.1.1), wider by the sample's part of the cone; narrower
// where several samples share the element.
void RaySource::read_widths() {
  any_across = false;
  for (PointTriples* triples : {&ray_origin_u, &ray_origin_v})
    resize(*triples, size());
  for (size_t k = 0; k < 2; ++k) {
    turn_scale[k].resize(size());
    across[k].resize(size());
    const PointTriples& turns = k == 0 ? axis_u : axis_v;
    const PointTriples& moves = k == 0 ? origin_u : origin_v;
    PointTriples& ray_moves = k == 0 ? ray_origin_u : ray_origin_v;
    for (size_t i = 0; i < size(); ++i) {
      const float share = 1 / std::sqrt(static_cast<float>(std::max(samples[i], 1u)));
      const float part = base.empty() ? 1.0f : 1 - base[i] * (1 - share);
      const float side = spread.empty() ? 0.0f : spread[i];
      float squared = 0;
      for (size_t c = 0; c < 3; ++c) {
        ray_moves[c][i] = part * moves[c][i];
        squared += turns[c][i] * turns[c][i];
      }
      const float narrow = std::sqrt(squared), wide = std::sqrt(squared + side * side);
      const bool turns_enough = narrow > 1e-3f * wide;
      turn_scale[k][i] = turns_enough ? wide / narrow : 0.0f;
      across[k][i] = turns_enough ? 0.0f : wide;
      any_across |= across[k][i] > 0 && side > 0;
    }
  }
}

} // namespace slvm
