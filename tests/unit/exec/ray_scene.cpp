#include "tests/unit/exec/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slvm::test {
namespace {

double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec along(const Vec& o, const Vec& d, double t) {
  return {o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]};
}

Vec triple(const float* const (&planes)[3], size_t i) {
  return {planes[0][i], planes[1][i], planes[2][i]};
}

AskedRay ray_of(const RayBatch& batch, size_t r) {
  AskedRay ray;
  ray.origin = triple(batch.origin, r);
  ray.direction = triple(batch.direction, r);
  if (batch.weight[0]) ray.weight = triple(batch.weight, r);
  if (batch.max_distance) ray.max_distance = batch.max_distance[r];
  if (batch.bias) ray.bias = batch.bias[r];
  ray.point = batch.point[r];
  ray.sample = batch.sample[r];
  ray.has_differentials = batch.origin_du[0] != nullptr;
  if (ray.has_differentials) {
    ray.origin_du = triple(batch.origin_du, r);
    ray.origin_dv = triple(batch.origin_dv, r);
    ray.direction_du = triple(batch.direction_du, r);
    ray.direction_dv = triple(batch.direction_dv, r);
  }
  return ray;
}

AskedCall call_of(const RayOptions& o) {
  return {
      o.kind, o.sides, o.mode, std::string(o.label), std::string(o.subset), o.shades, false, o.wants_distance,
      o.seed, 0,       {}};
}

const char* name_of(RayOutput::From from) {
  constexpr const char* kNames[] = {"surface:",  "displacement:", "volume:",    "atmosphere:", "interior:",
                                    "exterior:", "primitive:",    "attribute:", "shaded:"};
  return kNames[static_cast<size_t>(from)];
}

} // namespace

TestSurface plane_at(double z, std::array<float, 3> colour) {
  TestSurface s;
  s.sphere = false;
  s.at = {0, 0, z};
  s.colour = colour;
  return s;
}

TestSurface sphere_at(Vec centre, double radius, std::array<float, 3> colour) {
  TestSurface s;
  s.at = centre;
  s.radius = radius;
  s.colour = colour;
  return s;
}

std::vector<RayScene::Meeting> RayScene::meetings(const AskedRay& ray, const RayOptions& options) const {
  std::vector<Meeting> out;
  const double nearest = ray.bias >= 0 ? ray.bias : self_distance;
  for (uint32_t i = 0; i < surfaces.size(); ++i) {
    const TestSurface& s = surfaces[i];
    if (!options.subset.empty() && options.subset != s.group) continue;
    auto meet = [&](double t, uint32_t face) {
      if (t > nearest && t <= ray.max_distance) out.push_back({t, i, face});
    };
    const Vec to{s.at[0] - ray.origin[0], s.at[1] - ray.origin[1], s.at[2] - ray.origin[2]};
    if (s.sphere) {
      const double middle = dot(to, ray.direction),
                   squared = s.radius * s.radius - dot(to, to) + middle * middle;
      if (squared < 0) continue;
      meet(middle - std::sqrt(squared), 0);
      meet(middle + std::sqrt(squared), 1);
    } else if (const double cosine = dot(s.normal, ray.direction); cosine != 0) {
      meet(dot(s.normal, to) / cosine, 0);
    }
  }
  std::sort(out.begin(), out.end(), [](const Meeting& a, const Meeting& b) {
    return std::tie(a.distance, a.surface, a.face) < std::tie(b.distance, b.surface, b.face);
  });
  return out;
}

void RayScene::bring(const RayOutput& output, size_t r, const AskedRay& ray, const Meeting& meeting) const {
  const TestSurface& s = surfaces[meeting.surface];
  const Vec p = along(ray.origin, ray.direction, meeting.distance);
  std::vector<float> value;
  auto triple_of = [](const Vec& v) {
    return std::vector<float>{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
  };
  auto known = s.variables.find(std::string(name_of(output.from)) + std::string(output.name));
  if (known != s.variables.end()) {
    if (known->second.type != output.type || known->second.elements != output.elements) return;
    value = known->second.numbers;
  } else if (output.from == RayOutput::From::kSurface || output.from == RayOutput::From::kPrimitive ||
             output.from == RayOutput::From::kShaded) {
    const bool colour = output.type == Type::kColor;
    if (output.name == "Ci" && colour) value.assign(s.colour.begin(), s.colour.end());
    if ((output.name == "Oi" || output.name == "Os") && colour)
      value.assign(s.opacity.begin(), s.opacity.end());
    if (output.name == "P" && output.type == Type::kPoint) value = triple_of(p);
    if (output.name == "N" && is_triple(output.type)) {
      value = triple_of(s.normal);
      for (size_t c = 0; c < 3 && s.sphere; ++c)
        value[c] = static_cast<float>((p[c] - s.at[c]) / s.radius);
    }
  }
  if (value.empty()) return;
  for (size_t i = 0; i < value.size(); ++i)
    output.data[i * output.pitch + r] = value[i];
  output.found[r] = 1;
}

void RayScene::note(const RayOptions& options, const RayBatch& batch, std::span<const RayOutput> outputs,
                    bool transmission) {
  const std::lock_guard lock(mutex_);
  AskedCall call = call_of(options);
  call.transmission = transmission;
  call.rays = batch.count;
  for (const RayOutput& o : outputs)
    call.outputs.push_back(std::string(name_of(o.from)) + std::string(o.name));
  calls.push_back(call);
  for (size_t r = 0; r < batch.count; ++r)
    rays.push_back(ray_of(batch, r));
}

void RayScene::trace(const ShadingState&, const RayOptions& options, const RayBatch& batch,
                     std::span<const RayOutput> outputs, float* distance, RayCursor* cursors) {
  note(options, batch, outputs, false);
  for (size_t r = 0; r < batch.count; ++r) {
    const AskedRay ray = ray_of(batch, r);
    if (too_deep.contains(ray.sample)) {
      distance[r] = kNotShot;
      continue;
    }
    const std::vector<Meeting> met = meetings(ray, options);
    auto it = met.begin();
    if (cursors)
      it = std::find_if(met.begin(), met.end(), [&](const Meeting& m) {
        const RayCursor& c = cursors[r];
        return std::tuple(static_cast<float>(m.distance), m.surface + 1, m.face) >
               std::tuple(c.distance, c.primitive, c.face);
      });
    if (it == met.end()) continue; // stays infinite
    const bool any_will_do = !options.wants_distance && outputs.empty() && !cursors;
    distance[r] = any_will_do ? 0 : static_cast<float>(it->distance);
    if (cursors) cursors[r] = {distance[r], it->surface + 1, it->face};
    for (const RayOutput& o : outputs)
      if (options.shades || o.from == RayOutput::From::kPrimitive || o.from == RayOutput::From::kAttribute)
        bring(o, r, ray, *it);
  }
}

void RayScene::transmission(const ShadingState&, const RayOptions& options, const RayBatch& batch,
                            float* const (&through)[3]) {
  note(options, batch, {}, true);
  for (size_t r = 0; r < batch.count; ++r) {
    const std::vector<Meeting> met = meetings(ray_of(batch, r), options);
    for (size_t c = 0; c < 3; ++c) {
      float left = 1;
      for (const Meeting& m : met)
        left *= 1 - surfaces[m.surface].opacity[c];
      through[c][r] = left;
    }
  }
}

std::string RayScene::hemisphere(const ShadingState&, const HemisphereQuery& q) {
  const std::lock_guard lock(mutex_);
  AskedHemisphere& h = hemispheres.emplace_back();
  h.call = call_of(q.rays);
  h.samples = q.samples, h.min_samples = q.min_samples, h.falloff = q.falloff;
  h.max_error = q.max_error, h.max_pixel_distance = q.max_pixel_distance;
  h.cosine = q.cosine, h.power = q.falloff_is_power;
  auto number = [](const float* x) { return x ? static_cast<double>(x[0]) : -7; };
  h.cone_angle = number(q.cone_angle), h.max_distance = number(q.max_distance), h.bias = number(q.bias);
  h.sample_base = number(q.sample_base);
  h.position = triple(q.position, 0), h.normal = triple(q.normal, 0);
  h.along_u = triple(q.along_u, 0), h.along_v = triple(q.along_v, 0);
  if (q.weight[0]) h.weight = triple(q.weight, 0);
  h.map = q.environment_map, h.to_map = q.to_environment, h.cache_space = q.cache_space;
  h.wants_radiance = q.radiance[0], h.wants_occlusion = q.occlusion;
  h.wants_colour = q.environment_colour[0], h.wants_direction = q.environment_direction[0];
  for (size_t i = 0; i < q.points; ++i) {
    h.active.push_back(q.mask[i / 64] >> (i % 64) & 1);
    if (!h.active.back()) continue;
    const auto x = static_cast<float>(i);
    if (q.occlusion) q.occlusion[i] = 0.25f + x;
    for (size_t c = 0; c < 3; ++c) {
      if (q.radiance[c]) q.radiance[c][i] = x + static_cast<float>(c);
      if (q.environment_colour[c]) q.environment_colour[c][i] = 10 * x + static_cast<float>(c);
      if (q.environment_direction[c]) q.environment_direction[c][i] = 100 * x + static_cast<float>(c);
    }
  }
  return map_problem;
}

std::string RayScene::sample_environment(const ShadingState&, const EnvironmentSamples& s) {
  if (!map_problem.empty()) return map_problem;
  for (size_t i = 0; i < s.count; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(s.random[1][i]);
    const double y = 0.5 + 0.5 * static_cast<double>(s.random[0][i]), across = std::sqrt(1 - y * y);
    s.direction[0][i] = static_cast<float>(across * std::cos(turn));
    s.direction[1][i] = static_cast<float>(y);
    s.direction[2][i] = static_cast<float>(across * std::sin(turn));
    s.density[i] = static_cast<float>(1 / std::numbers::pi);
    for (size_t c = 0; c < 3; ++c)
      s.colour[c][i] = static_cast<float>(c + 1);
  }
  return "";
}

} // namespace slvm::test
