// Importance sampling of maps (Pharr, Jakob and Humphreys, Physically Based Rendering, 3rd edition, 14.2.4).
#include "render/rays/environment_distribution.h"

#include "render/rays/ray_tracer.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

/// Latitude-longitude as environment() has it: z up, s = longitude / 2 PI, t = (PI/2 - latitude) / PI.
Vec3 direction_at(float s, float t) {
  float latitude = kPi * (0.5f - t), longitude = 2 * kPi * s;
  return {std::cos(longitude) * std::cos(latitude), std::sin(longitude) * std::cos(latitude),
          std::sin(latitude)};
}

/// The place of `wanted` in a table of sums, and how far into it.
size_t find(const double* sums, size_t count, double wanted, float& part) {
  auto at = static_cast<size_t>(std::upper_bound(sums + 1, sums + count, wanted) - sums) - 1;
  double size = sums[at + 1] - sums[at];
  part = size > 0 ? static_cast<float>(std::clamp((wanted - sums[at]) / size, 0.0, 1.0)) : 0.5f;
  return at;
}

} // namespace

EnvironmentDistribution::EnvironmentDistribution(slvm::TextureServices& textures, std::string_view map,
                                                 std::string& problem) {
  constexpr size_t count = kRows * kColumns;
  slvm::TextureLookup lookup;
  lookup.map = map;
  lookup.channels = 3;
  lookup.points = count;
  std::vector<uint64_t> mask(count / 64 + 1, ~uint64_t{0});
  lookup.mask = mask.data();
  std::vector<float> result[3];
  for (size_t c = 0; c < 3; ++c) {
    result[c].resize(count);
    lookup.result[c] = result[c].data();
    for (auto* planes : {lookup.centre, lookup.along_u, lookup.along_v})
      planes[c].resize(count);
  }
  for (size_t j = 0, k = 0; j < kRows; ++j)
    for (size_t i = 0; i < kColumns; ++i, ++k) {
      float s = (static_cast<float>(i) + 0.5f) / kColumns, t = (static_cast<float>(j) + 0.5f) / kRows;
      Vec3 centre = direction_at(s, t);
      Vec3 u = direction_at(s + 0.5f / kColumns, t) - direction_at(s - 0.5f / kColumns, t),
           v = direction_at(s, t + 0.5f / kRows) - direction_at(s, t - 0.5f / kRows);
      for (int c = 0; c < 3; ++c) {
        lookup.centre[c][k] = centre[c];
        lookup.along_u[c][k] = u[c];
        lookup.along_v[c][k] = v[c];
      }
    }
  problem = textures.environment(lookup);
  rows_.push_back(0);
  for (size_t j = 0, k = 0; j < kRows; ++j) {
    double sum = 0, area = std::sin(M_PI * (static_cast<double>(j) + 0.5) / kRows);
    columns_.push_back(0);
    for (size_t i = 0; i < kColumns; ++i, ++k) {
      Color colour{result[0][k], result[1][k], result[2][k]};
      colours_.push_back(colour);
      sum += std::max(0.0f, (colour.x + colour.y + colour.z) / 3) * area;
      columns_.push_back(sum);
    }
    rows_.push_back(rows_.back() + sum);
  }
}

void EnvironmentDistribution::sample(float row, float column, Vec3& direction, Color& colour,
                                     float& density) const {
  direction = {0, 0, 1};
  colour = Color(0.0f);
  density = 0;
  double whole = rows_.back();
  if (!(whole > 0)) return;
  float in_row, in_column;
  size_t j = find(rows_.data(), kRows, std::clamp(row, 0.0f, 1.0f) * whole, in_row);
  const double* sums = &columns_[j * (kColumns + 1)];
  size_t i = find(sums, kColumns, std::clamp(column, 0.0f, 1.0f) * sums[kColumns], in_column);
  float t = (static_cast<float>(j) + in_row) / kRows;
  direction = direction_at((static_cast<float>(i) + in_column) / kColumns, t);
  colour = colours_[j * kColumns + i];
  double texel = (sums[i + 1] - sums[i]) / whole * kRows * kColumns; // relative to an even one, by s and t
  double sine = std::sin(M_PI * t);
  density = sine > 0 ? static_cast<float>(texel / (2 * M_PI * M_PI * sine)) : 0.0f;
}

std::string RayTracer::sample_environment(const slvm::ShadingState&, const slvm::EnvironmentSamples& s) {
  std::string problem = "there are no textures here";
  const EnvironmentDistribution* map = nullptr;
  if (slvm::TextureServices* textures = services_.textures()) {
    std::lock_guard lock(maps_mutex_);
    auto [it, is_new] = maps_.try_emplace(std::string(s.map));
    problem.clear();
    if (is_new) it->second = std::make_unique<EnvironmentDistribution>(*textures, s.map, problem);
    map = it->second.get();
  }
  for (size_t i = 0; i < s.count; ++i) {
    Vec3 direction(0, 0, 1);
    Color colour(0.0f);
    float density = 0;
    if (map) map->sample(s.random[0][i], s.random[1][i], direction, colour, density);
    for (int c = 0; c < 3; ++c) {
      s.direction[c][i] = direction[c];
      s.colour[c][i] = colour[c];
    }
    s.density[i] = density;
  }
  return problem;
}

} // namespace render
