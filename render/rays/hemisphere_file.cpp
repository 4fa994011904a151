#include "render/rays/hemisphere_file.h"

#include "slvm/machine.h"

#include <algorithm>
#include <fmt/format.h>

namespace render {

namespace {

/// From "current" to the space of the cache: "world", unless it has a name. None: there is no such space, or
/// it is flat.
std::optional<Matrix4> matrix_to(const slvm::ShadingState& state, std::string_view space,
                                 slvm::RendererServices& services) {
  Matrix4 to, from;
  if (space == "current") return to;
  if (space == "object" || space == "shader") {
    from = space == "object" ? state.grid.object_to_current : state.running.shader_to_current();
    return slvm::invert(from, to) ? std::optional(to) : std::nullopt;
  }
  if (!services.current_to_space(state, space.empty() ? "world" : space, to)) return {};
  return slvm::invert(to, from) ? std::optional(to) : std::nullopt;
}

} // namespace

HemisphereFile::HemisphereFile(CacheFiles* files, const slvm::ShadingState& state,
                               const slvm::HemisphereQuery& query, slvm::RendererServices& services,
                               const RayAttributes& attributes)
    : files_(files), attributes_(attributes) {
  const std::string& name = attributes.irradiance_file;
  if (!files || name.empty() || attributes.irradiance_mode == CacheMode::kNone) return;
  auto want = [&](const float* result, CacheValue v) { wanted_ |= result ? uint32_t{v} : 0u; };
  want(query.occlusion, kOcclusion);
  want(query.radiance[0], kIrradiance);
  want(query.environment_colour[0], kEnvironmentColour);
  want(query.environment_direction[0], kEnvironmentDirection);
  mode_ = attributes.irradiance_mode;
  const auto to = matrix_to(state, query.cache_space, services);
  if (!to) { // the query says so, too
    problem_ = fmt::format("the irradiance cache '{}' is not used: there is no coordinate system \"{}\"",
                           name, query.cache_space);
    if (mode_ != CacheMode::kOnly) mode_ = CacheMode::kNone;
    return;
  }
  space_.emplace(*to);
  writes_ = (mode_ == CacheMode::kWrite || mode_ == CacheMode::kSeedAndWrite) && state.grid.ray.depth == 0;
  if (mode_ == CacheMode::kWrite) return;
  const CacheFiles::Source& source = files->source(name);
  cache_ = source.cache.get();
  // What is written for the first time is not there yet.
  if (!(mode_ == CacheMode::kSeedAndWrite && source.missing)) problem_ = source.problem;
}

std::optional<HemisphereSample> HemisphereFile::find(const HemispherePoint& p, float max_error) const {
  if (!cache_) return {};
  auto found = cache_->find(
      {space_->point_to(p.P), space_->normal_to(p.N), wanted_, is_all() ? -1 : std::max(max_error, 0.0f)});
  if (found) found = space_->sample_from(*found);
  return found;
}

void HemisphereFile::keep(const HemispherePoint& p, const HemisphereSample& sample, float radius,
                          bool interpolated) {
  IrradianceRecord& r = kept_.emplace_back();
  r.P = space_->point_to(p.P);
  r.N = space_->normal_to(p.N);
  r.radius = space_->length_to(radius);
  // Whether anything is in the way is found in any case.
  r.holds = wanted_ | kOcclusion | (interpolated ? uint32_t{kSurroundings} : 0u);
  r.sample = space_->sample_to(sample);
}

void HemisphereFile::finish() {
  if (writes_) files_->add(attributes_.irradiance_file, mode_ == CacheMode::kSeedAndWrite, std::move(kept_));
}

std::vector<float> sample_radii(std::span<const HemispherePoint> points, int nu, int nv, const uint64_t* mask,
                                std::span<const uint32_t> samples) {
  /// What is nearly as near counts as nearest, too: on a regular lattice four samples are.
  constexpr float kNearly = 1.5f;
  std::vector<float> radii(samples.size()), distances(samples.size());
  auto on = [&](int k) { return mask[k / 64] >> (k % 64) & 1; };
  auto at = [&](int k) { return points[static_cast<size_t>(k)].P; };
  auto reach = [&](Vec3 place) {
    float least = kInfinity;
    for (size_t s = 0; s < samples.size(); ++s)
      least = std::min(least, distances[s] = glm::distance(points[samples[s]].P, place));
    for (size_t s = 0; s < samples.size(); ++s)
      if (distances[s] <= kNearly * least) radii[s] = std::max(radii[s], 2 * distances[s]);
  };
  for (int k = 0; k < nu * nv; ++k)
    if (on(k)) reach(at(k));
  // The middles of micropolygons, too: where all points have samples there is nothing else between them.
  for (int v = 0; v + 1 < nv; ++v)
    for (int u = 0; u + 1 < nu; ++u) {
      const int k = v * nu + u;
      if (on(k) && on(k + 1) && on(k + nu) && on(k + nu + 1))
        reach(0.25f * (at(k) + at(k + 1) + at(k + nu) + at(k + nu + 1)));
    }
  return radii;
}

} // namespace render
