// trace(), and what all kinds of rays share.
#include "render/rays/ray_tracer.h"

#include "render/hider/random.h"
#include "render/rays/environment_distribution.h"
#include "render/rays/hemisphere_cache.h"
#include "render/rays/hemisphere_records.h"
#include "render/rays/shooter.h"

#include <cmath>

namespace render {

namespace {

float number_option(const Options& o, const char* name, float otherwise) {
  auto it = o.named.find(name);
  return it != o.named.end() && it->second.numbers.size() == 1 ? it->second.numbers[0] : otherwise;
}

Vec3 point_of(const float* const (&planes)[3], size_t i) {
  return {planes[0][i], planes[1][i], planes[2][i]};
}

constexpr std::string_view type_of(slvm::RayKind kind) {
  switch (kind) {
  case slvm::RayKind::kSpecular: return "specular";
  case slvm::RayKind::kDiffuse: return "diffuse";
  case slvm::RayKind::kTransmission: return "transmission";
  }
  return "";
}

} // namespace

RayTracer::RayTracer(const Scene& scene, const slvm::Machine& machine, const BoundShaders& shaders,
                     slvm::RendererServices& services)
    : scene_(scene), services_(services), camera_(scene.options),
      hits_(scene, camera_, machine, shaders, services), cache_(std::make_unique<HemisphereCache>()),
      records_(std::make_unique<HemisphereRecords>()) {
  min_weight_ = number_option(scene.options, "trace:minweight", 0);
  max_depth_ = number_option(scene.options, "trace:maxdepth", 10);
  float kilobytes = number_option(scene.options, "limits:geocachememory", 1 << 20);
  if (kilobytes > 0 && kilobytes < 1e9f)
    geometry_settings_.most_bytes = static_cast<size_t>(kilobytes) * 1024;
}

RayTracer::~RayTracer() = default;

RayGeometry& RayTracer::geometry() {
  std::call_once(geometry_made_, [&] {
    geometry_ = std::make_unique<RayGeometry>(scene_, camera_, &hits_, geometry_settings_);
  });
  return *geometry_;
}

/// The deepest rays of a kind: as the object that shoots allows, counted from where it is, and as those
/// before it do.
RayTracer::Shooter RayTracer::shooter(const slvm::ShadingState& state,
                                      const slvm::RayOptions& options) const {
  const slvm::RayFacts& facts = state.grid.ray;
  Shooter out{state, facts, attributes_of(state.grid), facts};
  auto limit = [](float before, float depth, int allowed) {
    return std::min(before, depth + static_cast<float>(allowed));
  };
  slvm::RayFacts& next = out.next;
  next.most_specular_depth =
      limit(facts.most_specular_depth, facts.specular_depth, out.attributes.max_specular_depth);
  next.most_diffuse_depth =
      limit(facts.most_diffuse_depth, facts.diffuse_depth, out.attributes.max_diffuse_depth);
  switch (options.kind) {
  case slvm::RayKind::kSpecular:
    // Mirrors are not looked into by the way of diffuse rays.
    out.may_shoot =
        facts.specular_depth < next.most_specular_depth && !(facts.type == "diffuse" && options.shades);
    ++next.specular_depth;
    break;
  case slvm::RayKind::kDiffuse:
    out.may_shoot = facts.diffuse_depth < next.most_diffuse_depth;
    ++next.diffuse_depth;
    break;
  case slvm::RayKind::kTransmission:
    // Lights that a surface's opacity asks for would look for shadows in turn, at each of those surfaces
    // again.
    out.may_shoot = facts.type != "transmission" || state.running.shader().kind() != slvm::ShaderKind::kLight;
    ++next.shadow_depth;
    break;
  }
  out.may_shoot = out.may_shoot && facts.depth < max_depth_;
  ++next.depth;
  next.type = type_of(options.kind);
  next.label = options.label;
  std::fill_n(next.weight, 3, nullptr);
  out.min_weight = min_weight_;
  out.seed = state.grid.id;
  return out;
}

RaySegment RayTracer::segment(const Shooter& shooter, const slvm::RayOptions& options,
                              const slvm::RayBatch& batch, size_t ray) const {
  RaySegment out;
  out.origin = point_of(batch.origin, ray);
  out.direction = point_of(batch.direction, ray);
  out.nearest = batch.bias && batch.bias[ray] >= 0 ? batch.bias[ray] : shooter.attributes.bias;
  if (batch.max_distance) out.farthest = batch.max_distance[ray];
  if (shooter.attributes.sample_motion && scene_.options.shutter_close > scene_.options.shutter_open) {
    auto number = static_cast<int64_t>(shooter.number(batch, ray));
    out.time = upper_unit(hash_of(static_cast<int64_t>(shooter.seed), number, options.seed));
  }
  return out;
}

HitRay RayTracer::hit_ray(const Shooter& shooter, const slvm::RayBatch& batch, size_t ray, float time,
                          const RayHit& hit) {
  const auto number = static_cast<uint32_t>(ray);
  return {number, number, shooter.point(batch, ray), geometry_->place(hit), hit.distance, time};
}

std::vector<Color> RayTracer::weights(const Shooter& shooter, const slvm::RayBatch& batch) const {
  std::vector<Color> out;
  if (!batch.weight[0] && !shooter.facts.weight[0]) return out;
  out.reserve(batch.count);
  for (size_t i = 0; i < batch.count; ++i)
    out.push_back(shooter.weight(batch.weight, i, shooter.point(batch, i)));
  return out;
}

void RayTracer::trace(const slvm::ShadingState& state, const slvm::RayOptions& options,
                      const slvm::RayBatch& batch, std::span<const slvm::RayOutput> outputs, float* distance,
                      slvm::RayCursor* cursors) {
  rays_ += trace_by(shooter(state, options), options, batch, outputs, distance, cursors);
}

size_t RayTracer::trace_by(const Shooter& by, const slvm::RayOptions& options, const slvm::RayBatch& batch,
                           std::span<const slvm::RayOutput> outputs, float* distance,
                           slvm::RayCursor* cursors) {
  if (!by.may_shoot || batch.count == 0) {
    std::fill_n(distance, batch.count, slvm::kNotShot);
    return 0;
  }
  RayGeometry& g = geometry();
  const RayRule rule = g.rule(options.kind, options.subset, options.sides);
  const std::vector<Color> weight = weights(by, batch);
  const bool any_hit_will_do = !options.wants_distance && outputs.empty() && !cursors;
  size_t shot = 0;
  std::vector<HitRay> hits = hits_.take_list();
  if (!outputs.empty()) hits.reserve(batch.count);
  {
    auto tracing = g.tracing();
    // Where hits lie is looked up for a few at a time: one look-up need not wait for another.
    struct {
      size_t ray;
      float time;
      RayHit hit;
    } some[64];
    size_t waiting = 0;
    auto place_hits = [&] {
      for (const auto& at : std::span(some, waiting))
        hits.push_back(hit_ray(by, batch, at.ray, at.time, at.hit));
      waiting = 0;
    };
    for (size_t i = 0; i < batch.count; ++i) {
      if (!weight.empty() && by.too_light(weight[i])) {
        distance[i] = slvm::kNotShot;
        continue;
      }
      ++shot;
      RaySegment ray = segment(by, options, batch, i);
      if (any_hit_will_do) {
        distance[i] = g.world().any(rule, ray) ? 0 : kInfinity;
        continue;
      }
      RayHit hit;
      bool found = g.world().nearest(rule, ray, cursors ? &cursors[i] : nullptr, hit);
      distance[i] = found ? hit.distance : kInfinity;
      if (!found) continue;
      if (cursors) cursors[i] = {hit.distance, hit.item, hit.face};
      if (outputs.empty()) continue;
      some[waiting++] = {i, ray.time, hit};
      if (waiting == std::size(some)) place_hits();
    }
    place_hits();
  }
  g.trim();
  uint64_t seed = hash_of(static_cast<int64_t>(by.seed), options.seed, kHits);
  seed = hash_of(static_cast<int64_t>(seed), static_cast<int64_t>(by.number(batch, 0)), kHits);
  hits_.shade(hits, {by.state, {batch, weight}, options.kind, options.mode, options.shades, by.next, seed},
              outputs);
  hits_.give_back(std::move(hits));
  return shot;
}

std::string RayTracer::problem() const {
  return geometry_ ? geometry_->problem() : std::string();
}

RayUsage RayTracer::usage() const {
  RayUsage out{rays_, shadow_rays_, hemisphere_rays_, hemispheres_, hits_.usage().grids, hits_.usage().points,
               {}};
  if (geometry_) out.geometry = geometry_->usage();
  return out;
}

} // namespace render
