// transmission(): how much light passes between two points.
#include "render/hider/random.h"
#include "render/rays/shooter.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace render {

/// A ray and what is still to be found on it.
struct LightPath {
  size_t ray = 0;
  RaySegment segment;
  Color through{1.0f};
  std::vector<RayHit> layers; ///< nearest first; those from `next` on are not looked at yet
  size_t next = 0;
  slvm::RayCursor end;   ///< the last layer that was looked for
  bool complete = false; ///< there are no layers behind
};

namespace {

/// Layers taken from the world at a time; with more on a ray the nearer ones come first.
constexpr size_t kLayers = 64;
/// Layers of a ray shaded before it is seen whether light is left.
constexpr size_t kShadedAtATime = 4;
/// Less light than this is none.
constexpr float kDark = 1e-4f;
/// Layers of a ray in all, against scenes gone wrong.
constexpr size_t kMostLayers = 10'000;

bool is_dark(Color through) {
  return std::max({through.x, through.y, through.z}) < kDark;
}

/// Nearest first. Where a ray meets the edge between two faces of an item, or the diagonal of one, it has hit
/// a surface once.
void put_in_order(const RayGeometry& geometry, std::vector<RayHit>& layers) {
  std::sort(layers.begin(), layers.end(), [](const RayHit& a, const RayHit& b) {
    return std::tie(a.distance, a.item, a.face) < std::tie(b.distance, b.item, b.face);
  });
  auto same = [&](const RayHit& a, const RayHit& b) {
    return a.item == b.item && b.distance - a.distance <= 2e-6f * b.distance &&
           geometry.same_surface(a.item, a.face, b.face);
  };
  layers.erase(std::unique(layers.begin(), layers.end(), same), layers.end());
}

/// False: something solid is in the way.
bool find_layers(const RayGeometry& geometry, const RayRule& rule, LightPath& path) {
  if (geometry.world().all(rule, path.segment, geometry.solid(), kLayers, path.layers)) return false;
  if (path.layers.size() < kLayers) {
    put_in_order(geometry, path.layers);
    path.complete = true;
    return true;
  }
  path.layers.clear();
  return true;
}

/// The next few layers of a path that has very many, in order. False: one of them is solid.
bool find_more(const RayGeometry& geometry, const RayRule& rule, LightPath& path) {
  path.layers.clear();
  path.next = 0;
  for (size_t i = 0; i < kLayers; ++i) {
    RayHit hit;
    if (!geometry.world().nearest(rule, path.segment, &path.end, hit)) {
      path.complete = true;
      return true;
    }
    path.end = {hit.distance, hit.item, hit.face};
    if (geometry.shadow(hit) == RayOpacity::kOpaque) return false;
    path.layers.push_back(hit);
  }
  return true;
}

/// The opacity of a primitive whose Os does not vary.
const Color* constant_opacity(const Primitive& p) {
  for (const PatchVar& var : p.vars)
    if (replaced_variable(var) == slvm::Global::kOs) return nullptr;
  return &p.attributes().opacity;
}

RayOpacity opacity_of(RayOpacity own, slvm::HitMode mode) {
  if (mode == slvm::HitMode::kPrimitive) return RayOpacity::kOs;
  return mode == slvm::HitMode::kShader ? RayOpacity::kShader : own;
}

} // namespace

/// Dims each path by its next few layers.
void RayTracer::shade_layers(const Shooter& by, const slvm::RayOptions& options, const slvm::RayBatch& batch,
                             std::vector<LightPath>& paths) {
  std::vector<HitRay> to_shade, to_evaluate;
  std::vector<size_t> path_of; // by number of the hit
  auto tracing = geometry_->tracing();
  for (size_t i = 0; i < paths.size(); ++i) {
    LightPath& path = paths[i];
    size_t end = std::min(path.layers.size(), path.next + kShadedAtATime);
    for (; path.next < end; ++path.next) {
      const RayHit& layer = path.layers[path.next];
      RayOpacity opacity = opacity_of(geometry_->shadow(layer), options.mode);
      if (opacity == RayOpacity::kTransparent) continue;
      if (opacity == RayOpacity::kOpaque) path.through = Color(0.0f);
      if (opacity == RayOpacity::kOs) {
        const Primitive p = scene_.primitives[geometry_->primitive(layer)];
        if (const Color* constant = constant_opacity(p)) {
          path.through *= Color(1.0f) - *constant;
          continue;
        }
      }
      HitRay hit = hit_ray(by, batch, path.ray, path.segment.time, layer);
      hit.slot = static_cast<uint32_t>(path_of.size());
      path_of.push_back(i);
      (opacity == RayOpacity::kShader ? to_shade : to_evaluate).push_back(hit);
    }
  }
  tracing.unlock();
  const std::vector<Color> weight = weights(by, batch);
  const HitRays rays{batch, weight};
  std::vector<float> values(3 * path_of.size());
  slvm::RayOutput out;
  out.type = slvm::Type::kColor;
  out.data = values.data();
  out.pitch = path_of.size();
  uint64_t seed = hash_of(static_cast<int64_t>(by.seed), options.seed, kHits);
  out.from = slvm::RayOutput::From::kPrimitive;
  out.name = "Os";
  hits_.shade(to_evaluate, {by.state, rays, options.kind, options.mode, false, by.next, seed}, {&out, 1});
  out.from = slvm::RayOutput::From::kSurface;
  out.name = "Oi";
  hits_.shade(to_shade, {by.state, rays, options.kind, slvm::HitMode::kShader, true, by.next, seed},
              {&out, 1});
  for (size_t k = 0; k < path_of.size(); ++k)
    for (int c = 0; c < 3; ++c)
      paths[path_of[k]].through[c] *= 1 - values[static_cast<size_t>(c) * out.pitch + k];
}

void RayTracer::transmission(const slvm::ShadingState& state, const slvm::RayOptions& options,
                             const slvm::RayBatch& batch, float* const (&through)[3]) {
  auto store = [&](size_t ray, Color c) {
    for (int i = 0; i < 3; ++i)
      through[i][ray] = c[i];
  };
  slvm::RayOptions shadow = options;
  shadow.kind = slvm::RayKind::kTransmission;
  Shooter by = shooter(state, shadow);
  if (!by.may_shoot) {
    for (float* plane : through)
      std::fill_n(plane, batch.count, 1.0f);
    return;
  }
  RayGeometry& g = geometry();
  const RayRule rule = g.rule(shadow.kind, options.subset, options.sides);
  const std::vector<Color> weight = weights(by, batch);
  std::vector<LightPath> paths;
  size_t shot = 0;
  {
    auto tracing = g.tracing();
    LightPath path;
    for (size_t i = 0; i < batch.count; ++i) {
      if (!weight.empty() && by.too_light(weight[i])) {
        store(i, Color(1.0f));
        continue;
      }
      ++shot;
      path = {};
      path.ray = i;
      path.segment = segment(by, shadow, batch, i);
      path.segment.farthest -= path.segment.nearest;
      bool dark = !find_layers(g, rule, path);
      store(i, Color(dark ? 0.0f : 1.0f));
      if (!dark && (!path.complete || !path.layers.empty())) paths.push_back(std::move(path));
    }
  }
  shadow_rays_ += shot;
  for (size_t round = 0; !paths.empty() && round < kMostLayers / kShadedAtATime; ++round) {
    {
      auto tracing = g.tracing();
      for (LightPath& path : paths)
        if (path.next == path.layers.size() && !path.complete && !find_more(g, rule, path)) {
          path.through = Color(0.0f);
          path.complete = true;
        }
    }
    shade_layers(by, shadow, batch, paths);
    std::erase_if(paths, [&](const LightPath& path) {
      bool done = is_dark(path.through) || (path.complete && path.next == path.layers.size());
      store(path.ray, is_dark(path.through) ? Color(0.0f) : path.through);
      return done;
    });
  }
  g.trim();
}

} // namespace render
