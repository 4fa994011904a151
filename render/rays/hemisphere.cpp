// hemisphere(): the surroundings of the points of a grid, at each point by rays or interpolated between few
// of them.
#include "render/rays/hemisphere_cache.h"
#include "render/rays/hemisphere_lattice.h"
#include "render/rays/hemisphere_sampler.h"

#include <cmath>

namespace render {

namespace {

Vec3 vector_at(const float* const (&planes)[3], size_t i) {
  return planes[0] ? Vec3(planes[0][i], planes[1][i], planes[2][i]) : Vec3(0.0f);
}

bool is_on(const slvm::HemisphereQuery& q, size_t i) {
  return !q.mask || (q.mask[i / 64] >> (i % 64) & 1) != 0;
}

HemispherePoint point_of(const slvm::HemisphereQuery& q, size_t i) {
  HemispherePoint p;
  p.P = vector_at(q.position, i);
  p.N = vector_at(q.normal, i);
  p.along_u = vector_at(q.along_u, i);
  p.along_v = vector_at(q.along_v, i);
  if (q.cone_angle) p.cone = q.cone_angle[i];
  if (q.max_distance) p.max_distance = q.max_distance[i];
  if (q.bias) p.bias = q.bias[i];
  if (q.sample_base) p.base = q.sample_base[i];
  p.number = static_cast<uint32_t>(i);
  return p;
}

void store(const slvm::HemisphereQuery& q, size_t i, const HemisphereSample& s) {
  if (q.occlusion) q.occlusion[i] = s.value[0];
  Vec3 direction(s.value[7], s.value[8], s.value[9]);
  float length = glm::length(direction);
  if (length > 0) direction /= length;
  for (int c = 0; c < 3; ++c) {
    if (q.radiance[c]) q.radiance[c][i] = s.value[static_cast<size_t>(1 + c)];
    if (q.environment_colour[c]) q.environment_colour[c][i] = s.value[static_cast<size_t>(4 + c)];
    if (q.environment_direction[c]) q.environment_direction[c][i] = direction[c];
  }
}

bool is_usable(const HemispherePoint& p) {
  return std::isfinite(p.P.x + p.P.y + p.P.z + p.N.x + p.N.y + p.N.z) && glm::dot(p.N, p.N) > 0.5f;
}

} // namespace

std::string RayTracer::hemisphere(const slvm::ShadingState& state, const slvm::HemisphereQuery& query) {
  const slvm::Grid& grid = state.grid;
  const auto* primitive = static_cast<const Primitive*>(grid.user);
  const RayAttributes& attributes = attributes_of(grid);
  float max_error = query.max_error >= 0 ? query.max_error : attributes.max_error;
  float most_pixels =
      query.max_pixel_distance >= 0 ? query.max_pixel_distance : attributes.max_pixel_distance;
  bool lattice =
      grid.lattice == slvm::Lattice::kRows && query.points == grid.points() && grid.nu() > 1 && grid.nv() > 1;
  bool interpolates = max_error > 0 && lattice;
  HemisphereSampler sampler(*this, state, query, interpolates);
  std::vector<HemispherePoint> points;
  std::vector<uint64_t> mask(query.points / 64 + 1);
  // Of hits only those that count.
  size_t asked = query.points == grid.points() ? std::min(query.points, grid.samples()) : query.points;
  for (size_t i = 0; i < asked; ++i) {
    HemispherePoint p = point_of(query, i);
    if (interpolates) p.base = 0; // samples stand for more than their element
    bool wanted = is_on(query, i) && is_usable(p) && sampler.may_shoot();
    if (wanted) mask[i / 64] |= uint64_t{1} << (i % 64);
    if (is_on(query, i) && !wanted) store(query, i, {});
    if (interpolates || wanted) points.push_back(p);
  }
  if (!sampler.may_shoot()) return "";
  if (!interpolates) {
    std::vector<HemisphereSample> samples(points.size());
    sampler.sample(points, samples);
    for (size_t k = 0; k < points.size(); ++k)
      for (size_t i = points[k].number; i < query.points; i += asked)
        store(query, i, samples[k]); // and the neighbours of a hit
    return sampler.problem();
  }
  LatticeProblem problem;
  problem.nu = grid.nu();
  problem.nv = grid.nv();
  problem.points = points;
  problem.mask = mask.data();
  problem.max_error = max_error;
  // Half of what is noise in a sample does not count.
  problem.tolerance = 0.1f * max_error + 0.3f / std::sqrt(std::max(query.samples, 1.0f));
  float step = primitive ? std::sqrt(primitive->attributes().shading_rate) : 1.0f;
  problem.most_steps = static_cast<int>(std::clamp(most_pixels / step, 1.0f, 1e6f));
  problem.sample = [&](const HemispherePoint& p) {
    HemisphereCache::Key key(p.P, p.N, sampler.call_hash(p));
    if (auto known = cache_->find(key)) return *known;
    HemisphereSample s;
    sampler.sample({&p, 1}, {&s, 1});
    cache_->add(key, s);
    return s;
  };
  std::vector<HemisphereSample> samples = fill_lattice(problem);
  for (size_t i = 0; i < samples.size(); ++i)
    if (mask[i / 64] >> (i % 64) & 1) store(query, i, samples[i]);
  return sampler.problem();
}

} // namespace render
