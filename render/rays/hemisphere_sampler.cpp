// Where rays go and what their results come to; hemisphere_cast.cpp shoots them. Points are taken a few
// thousand rays at a time.
#include "render/rays/hemisphere_sampler.h"

#include "render/hider/random.h"
#include "render/rays/hemisphere_cache.h"
#include "render/rays/hemisphere_rays.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace render {

namespace {

constexpr size_t kRaysAtATime = 8192;
/// Blocks of cells whose distances differ by this factor, whose light by this part of the whole, or of which
/// so much more of one is blocked, are looked at again.
constexpr float kDistanceContrast = 1.5f, kLightContrast = 0.1f, kBlockedContrast = 0.1f;

uint64_t mix(uint64_t a, uint64_t b) {
  return hash_of(static_cast<int64_t>(a), static_cast<int64_t>(b), kHemisphere);
}
uint64_t mix(uint64_t a, float b) {
  return mix(a, uint64_t{std::bit_cast<uint32_t>(b)});
}
uint64_t mix(uint64_t a, std::string_view text) {
  for (char c : text)
    a = (a ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return mix(a, text.size());
}

} // namespace

HemisphereSampler::HemisphereSampler(RayTracer& tracer, const slvm::ShadingState& state,
                                     const slvm::HemisphereQuery& query, bool interpolated)
    : tracer_(tracer), state_(state), query_(query), shooter_(tracer.shooter(state, query.rays)),
      pattern_(make_pattern(query.samples, query.min_samples)), interpolated_(interpolated),
      aim_(pattern_, query.cosine) {
  for (int b = 0, across = pattern_.sectors / pattern_.sector_block; b < pattern_.blocks(); ++b)
    for (int ring = 0; ring < pattern_.ring_block; ++ring)
      for (int sector = 0; sector < pattern_.sector_block; ++sector)
        by_block_.push_back(
            static_cast<uint32_t>((b / across * pattern_.ring_block + ring) * pattern_.sectors +
                                  b % across * pattern_.sector_block + sector));
  for (int i = 0; i < 2 * pattern_.sectors; ++i) {
    const float angle = kPi * static_cast<float>(i) / static_cast<float>(pattern_.sectors);
    around_.emplace_back(std::cos(angle), std::sin(angle));
  }
  wants_light_ = query.radiance[0] && query.rays.shades;
  wants_map_ = !query.environment_map.empty() && (query.radiance[0] || query.environment_colour[0]);
  const slvm::RayFacts& f = state.grid.ray;
  uint64_t h = mix(query.rays.seed, f.label);
  for (float x : {query.samples, query.min_samples, query.falloff, f.depth, f.specular_depth, f.diffuse_depth,
                  f.most_specular_depth, f.most_diffuse_depth})
    h = mix(h, x);
  for (std::string_view text :
       {query.rays.label, query.rays.subset, query.environment_map, std::string_view(f.type)})
    h = mix(h, text);
  for (float x : query.to_environment.m)
    h = mix(h, wants_map_ ? x : 0.0f);
  for (bool flag : {query.cosine, query.falloff_is_power, query.radiance[0] != nullptr, interpolated,
                    wants_light_, query.environment_colour[0] != nullptr})
    h = mix(h, uint64_t{flag});
  const RayAttributes& a = shooter_.attributes;
  h = mix(mix(h, uint64_t(query.rays.sides) * 8 + uint64_t(query.rays.mode)), a.bias);
  h = mix(h, uint64_t(a.max_specular_depth) * 1001 + uint64_t(a.max_diffuse_depth) * 2 + a.sample_motion);
  call_ = h;
}

uint64_t HemisphereSampler::call_hash(const HemispherePoint& p) const {
  uint64_t h = mix(mix(mix(mix(call_, p.cone), p.max_distance), p.bias), p.base);
  if (p.base != 0 && !interpolated_) // else the element is a function of the place
    for (Vec3 side : {p.along_u, p.along_v})
      for (int c = 0; c < 3; ++c)
        h = mix(h, side[c]);
  return h;
}

/// Random numbers depend on the place, so that all grids see the same at a point they share.
uint64_t HemisphereSampler::seed_of(const HemispherePoint& p) const {
  return HemisphereCache::Key(p.P, p.N, mix(query_.rays.seed, uint64_t{1})).hash();
}

namespace {

/// What a ray stands for, as an angle.
float spread_of(const HemispherePattern& p) {
  return std::sqrt(2 * kPi / static_cast<float>(p.cells()));
}

} // namespace

/// Appends the rays that were aimed last, of the point with this number among those being sampled.
void HemisphereSampler::push_rays(Rays& rays, const HemispherePoint& p, size_t index) {
  const size_t count = aim_.size(), before = rays.size();
  auto append = [](std::vector<float>& to, const std::vector<float>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (size_t c = 0; c < 3; ++c) {
    append(rays.origin[c], aim_.origin[c]);
    append(rays.direction[c], aim_.direction[c]);
  }
  rays.max_distance.resize(before + count, p.max_distance);
  rays.bias.resize(before + count, p.bias);
  rays.point.resize(before + count, p.number);
  rays.index.resize(before + count, index);
  const size_t first_cell = index * static_cast<size_t>(pattern_.cells());
  rays.cell.resize(before + count);
  rays.sample.resize(before + count);
  for (size_t i = 0; i < count; ++i) {
    const auto number = static_cast<uint32_t>(aim_.cell[i]);
    const size_t cell = first_cell + number;
    cells_.direction[cell] = {aim_.direction[0][i], aim_.direction[1][i], aim_.direction[2][i]};
    cells_.shot[cell] = 1;
    rays.cell[before + i] = cell;
    rays.sample[before + i] = number;
  }
  if (!needs_width()) return;
  const float spread = spread_of(pattern_);
  for (size_t i = before; i < before + count; ++i) {
    Vec3 x, y;
    basis_about(cells_.direction[rays.cell[i]], x, y);
    for (int c = 0; c < 3; ++c) {
      rays.direction_du[c].push_back(x[c] * spread);
      rays.direction_dv[c].push_back(y[c] * spread);
      rays.still[c].push_back(0);
    }
  }
}

void HemisphereSampler::first_rays(std::span<const HemispherePoint> points, Rays& rays) {
  const auto blocks = static_cast<size_t>(pattern_.blocks());
  chosen_.resize(points.size() * blocks);
  for (size_t i = 0; i < points.size(); ++i) {
    aim_.first(points[i], seed_of(points[i]));
    for (int cell : aim_.cell)
      chosen_[i * blocks + static_cast<size_t>(pattern_.block_of(cell))] = cell;
    push_rays(rays, points[i], i);
  }
}

/// Whether there may be an edge between what two neighbouring rays met. Where nothing but what is in the way
/// counts, it does not matter how far away that is.
bool HemisphereSampler::differs(size_t a, size_t b) const {
  const float x = cells_.distance[a], y = cells_.distance[b];
  if ((x == kInfinity) != (y == kInfinity)) return true;
  if (std::abs(cells_.blocked[a] - cells_.blocked[b]) > kBlockedContrast) return true;
  if (!needs_width()) return false;
  if (x != kInfinity && std::max(x, y) > kDistanceContrast * std::min(x, y)) return true;
  const Color &p = cells_.light[a], &q = cells_.light[b];
  for (int c = 0; c < 3; ++c)
    if (std::abs(p[c] - q[c]) > kLightContrast * std::max({p[c], q[c], 0.1f})) return true;
  return false;
}

/// The cells left in blocks that differ from one of the four beside them.
void HemisphereSampler::more_rays(std::span<const HemispherePoint> points, Rays& rays) {
  const auto across = static_cast<size_t>(pattern_.sectors / pattern_.sector_block),
             blocks = static_cast<size_t>(pattern_.blocks());
  std::vector<uint8_t> wanted(blocks);
  for (size_t i = 0; i < points.size(); ++i) {
    const size_t first = i * static_cast<size_t>(pattern_.cells());
    const int* chosen = &chosen_[i * blocks];
    std::fill(wanted.begin(), wanted.end(), uint8_t{0});
    auto compare = [&](size_t a, size_t b) {
      if ((wanted[a] && wanted[b]) ||
          !differs(first + static_cast<size_t>(chosen[a]), first + static_cast<size_t>(chosen[b])))
        return;
      wanted[a] = wanted[b] = 1;
    };
    for (size_t b = 0; b < blocks; ++b) {
      compare(b, b % across + 1 < across ? b + 1 : b + 1 - across);
      if (b + across < blocks) compare(b, b + across);
    }
    aim_.others(points[i], seed_of(points[i]), wanted, {chosen, blocks});
    push_rays(rays, points[i], i);
  }
}

float HemisphereSampler::blocked_by(const HemispherePoint& p, float distance) const {
  if (!(distance < kInfinity)) return 0;
  if (query_.falloff == 0) return 1;
  if (!query_.falloff_is_power) return std::exp(-query_.falloff * distance);
  return p.max_distance < kInfinity
             ? std::pow(std::max(0.0f, (p.max_distance - distance) / p.max_distance), query_.falloff)
             : 1.0f;
}

void HemisphereSampler::finish(const HemispherePoint& p, size_t index, HemisphereSample& out) {
  const auto blocks = static_cast<size_t>(pattern_.blocks()), size = by_block_.size() / blocks;
  const size_t first = index * by_block_.size();
  double sum[HemisphereSample::kValues] = {}, nearness = 0;
  const bool coloured = needs_width();
  auto add = [&](size_t cell, float weight) {
    sum[0] += weight * cells_.blocked[cell];
    for (int c = 0; c < 3 && coloured; ++c) {
      sum[1 + c] += weight * cells_.light[cell][c];
      sum[4 + c] += weight * cells_.map[cell][c];
    }
    if (cells_.distance[cell] == kInfinity)
      for (int c = 0; c < 3; ++c)
        sum[7 + c] += weight * cells_.direction[cell][c];
    // Behind the farthest distance there may be anything.
    nearness += weight / std::max(std::min(cells_.distance[cell], p.max_distance), 1e-20f);
  };
  const bool fills = interpolated_ && query_.cosine && p.cone <= kPi / 2 + 1e-4f;
  for (size_t b = 0; b < blocks; ++b) {
    const auto block = std::span(by_block_).subspan(b * size, size);
    const auto chosen = static_cast<uint32_t>(chosen_[index * blocks + b]);
    if (cells_.shot[first + (block.front() == chosen ? block.back() : block.front())]) {
      for (uint32_t cell : block)
        add(first + cell, 1);
      continue;
    }
    // Cells that were left out are like the one of their block that was not.
    add(first + chosen, static_cast<float>(size));
    for (uint32_t cell : block)
      if (fills && cell != chosen) cells_.copy(first + chosen, first + cell);
  }
  const double count = pattern_.cells();
  for (size_t i = 0; i < HemisphereSample::kValues; ++i)
    out.value[i] = static_cast<float>(sum[i] / count);
  out.distance = nearness > 0 ? static_cast<float>(count / nearness) : kInfinity;
  if (fills) gradients(p, first, out);
}

/// Ward and Heckbert 1992, equations for the rotation and the translation gradient, for means instead of
/// integrals; turns are about right-handed axes.
void HemisphereSampler::gradients(const HemispherePoint& p, size_t first, HemisphereSample& out) {
  const auto M = static_cast<size_t>(pattern_.rings), N = static_cast<size_t>(pattern_.sectors);
  const float reach = std::sin(std::min(p.cone, kPi / 2)), norm = 1 / (kPi * reach * reach);
  auto sine = [&](float ring) { return reach * std::sqrt(ring / static_cast<float>(M)); };
  Vec3 x, y;
  basis_about(p.N, x, y);
  // For each value its numbers, `stride` apart. Light and map only where they are asked for.
  auto of_value = [&](const float* value, size_t stride, Vec3& move, Vec3& turn) {
    for (auto& sums : by_sector_)
      sums.assign(N, 0.0f);
    float *outwards = by_sector_[0].data(), *aside = by_sector_[1].data(), *tilt = by_sector_[2].data();
    const float* distance = &cells_.distance[first];
    auto change = [&](size_t cell, size_t other) {
      return (value[cell * stride] - value[other * stride]) /
             std::max(std::min(distance[cell], distance[other]), 1e-6f);
    };
    for (size_t j = 0; j < M; ++j) {
      const auto ring = static_cast<float>(j);
      const float s = sine(ring), middle = sine(ring + 0.5f), row_width = sine(ring + 1) - s;
      const float inner = 2 * kPi / static_cast<float>(N) * s * (1 - s * s);
      const float tangent = middle / std::sqrt(std::max(1 - middle * middle, 1e-4f));
      const float turned = tangent / static_cast<float>(M * N);
      const size_t row = j * N;
      for (size_t k = 0; k < N && j > 0; ++k)
        outwards[k] += inner * change(row + k, row + k - N);
      aside[0] += row_width * change(row, row + N - 1);
      for (size_t k = 1; k < N; ++k)
        aside[k] += row_width * change(row + k, row + k - 1);
      for (size_t k = 0; k < N; ++k)
        tilt[k] += turned * value[(row + k) * stride];
    }
    for (size_t k = 0; k < N; ++k) {
      const Vec2 edge = around_[2 * k], middle = around_[2 * k + 1];
      const Vec3 radial = x * middle.x + y * middle.y;
      move += radial * (norm * outwards[k]) + glm::cross(p.N, x * edge.x + y * edge.y) * (norm * aside[k]);
      turn += glm::cross(p.N, radial) * tilt[k];
    }
  };
  of_value(&cells_.blocked[first], 1, out.move[0], out.turn[0]);
  for (size_t c = 0; c < 3 && needs_width(); ++c) {
    of_value(&cells_.light[first][static_cast<int>(c)], 3, out.move[1 + c], out.turn[1 + c]);
    of_value(&cells_.map[first][static_cast<int>(c)], 3, out.move[4 + c], out.turn[4 + c]);
  }
}

HemisphereSampler::~HemisphereSampler() = default;

void HemisphereSampler::sample(std::span<const HemispherePoint> points, std::span<HemisphereSample> out) {
  auto cells = static_cast<size_t>(pattern_.cells());
  size_t at_a_time = std::max<size_t>(1, kRaysAtATime / cells);
  for (const HemispherePoint& p : points)
    tracer_.hemispheres_ += p.pass == 0;
  if (!rays_) rays_ = std::make_unique<Rays>();
  Rays& rays = *rays_;
  for (size_t first = 0; first < points.size();) {
    auto part = points.subspan(first, std::min(at_a_time, points.size() - first));
    if (interpolated_) { // a sample belongs to its place, whichever grid asks
      part = points.subspan(first, 1);
      shooter_.seed = mix(seed_of(part[0]), uint64_t{part[0].pass});
      shooter_.one_point = true;
    }
    cells_.reset(part.size() * cells, needs_width());
    rays.clear();
    first_rays(part, rays);
    cast(part, rays);
    if (pattern_.blocks() < pattern_.cells()) {
      rays.clear();
      more_rays(part, rays);
      if (rays.size() > 0) cast(part, rays);
    }
    for (size_t i = 0; i < part.size(); ++i)
      finish(part[i], i, out[first + i]);
    first += part.size();
  }
}

} // namespace render
