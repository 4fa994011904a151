// Shooting the rays of a HemisphereSampler.
#include "render/rays/hemisphere_rays.h"

namespace render {

void HemisphereSampler::cast(std::span<const HemispherePoint> points, Rays& rays) {
  slvm::RayOptions options = query_.rays;
  options.wants_distance = !only_blocked();
  slvm::RayBatch batch;
  batch.count = rays.size();
  slvm::RayOutput light;
  light.from = slvm::RayOutput::From::kShaded;
  light.name = "Ci";
  light.type = slvm::Type::kColor;
  rays.colours.assign(wants_light_ ? 3 * rays.size() : 0, 0.0f);
  light.data = rays.colours.data();
  light.pitch = rays.size();
  for (int c = 0; c < 3; ++c) {
    batch.origin[c] = rays.origin[c].data();
    batch.direction[c] = rays.direction[c].data();
    if (query_.weight[c]) {
      rays.weight[c].clear();
      for (uint32_t point : rays.point)
        rays.weight[c].push_back(query_.weight[c][point]);
      batch.weight[c] = rays.weight[c].data();
    }
    if (!needs_width()) continue;
    batch.origin_du[c] = batch.origin_dv[c] = rays.still[c].data();
    batch.direction_du[c] = rays.direction_du[c].data();
    batch.direction_dv[c] = rays.direction_dv[c].data();
  }
  batch.max_distance = rays.max_distance.data();
  batch.bias = rays.bias.data();
  batch.point = rays.point.data();
  batch.sample = rays.sample.data();
  rays.distance.resize(rays.size());
  tracer_.hemisphere_rays_ +=
      tracer_.trace_by(shooter_, options, batch, {&light, wants_light_ ? size_t{1} : size_t{0}},
                       rays.distance.data(), nullptr);
  for (size_t i = 0; i < rays.size(); ++i) {
    const size_t cell = rays.cell[i];
    const float d = rays.distance[i] == slvm::kNotShot ? kInfinity : rays.distance[i];
    cells_.distance[cell] = d;
    cells_.blocked[cell] = blocked_by(points[rays.index[i]], d);
    if (wants_light_ && d < kInfinity)
      cells_.light[cell] = {rays.colours[i], rays.colours[rays.size() + i],
                            rays.colours[2 * rays.size() + i]};
  }
  if (wants_map_) look_up_map(rays);
}

void HemisphereSampler::look_up_map(Rays& rays) {
  slvm::TextureServices* textures = tracer_.services_.textures();
  if (!textures) {
    problem_ = "there are no textures here";
    return;
  }
  slvm::TextureLookup lookup;
  lookup.map = query_.environment_map;
  lookup.channels = 3;
  lookup.points = rays.size();
  std::vector<uint64_t> mask(rays.size() / 64 + 1);
  std::vector<float> result[3];
  for (size_t i = 0; i < rays.size(); ++i) {
    if (cells_.distance[rays.cell[i]] == kInfinity) mask[i / 64] |= uint64_t{1} << (i % 64);
    Vec3 planes[3];
    const std::vector<float>* from[3] = {rays.direction, rays.direction_du, rays.direction_dv};
    for (size_t k = 0; k < 3; ++k)
      planes[k] = transform_vector(query_.to_environment, Vec3(from[k][0][i], from[k][1][i], from[k][2][i]));
    for (int c = 0; c < 3; ++c) {
      lookup.centre[c].push_back(planes[0][c]);
      lookup.along_u[c].push_back(planes[1][c]);
      lookup.along_v[c].push_back(planes[2][c]);
    }
  }
  lookup.mask = mask.data();
  for (size_t c = 0; c < 3; ++c) {
    result[c].resize(rays.size());
    lookup.result[c] = result[c].data();
  }
  if (std::string why = textures->environment(lookup); !why.empty()) problem_ = why;
  for (size_t i = 0; i < rays.size(); ++i)
    if (lookup.active(i)) {
      const size_t cell = rays.cell[i];
      cells_.light[cell] = cells_.map[cell] = {result[0][i], result[1][i], result[2][i]};
    }
}

} // namespace render
