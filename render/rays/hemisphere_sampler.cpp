// Where rays go and what their results come to; hemisphere_cast.cpp shoots them. Points are taken a few
// thousand rays at a time.
#include "render/rays/hemisphere_sampler.h"

#include "render/hider/random.h"
#include "render/rays/hemisphere_cache.h"
#include "render/rays/hemisphere_rays.h"

#include <cmath>
#include <functional>

namespace render {

namespace {

constexpr size_t kRaysAtATime = 8192;
/// Blocks of cells whose distances differ by this factor, or whose light by this part of the whole, are
/// looked at again.
constexpr float kDistanceContrast = 1.5f, kLightContrast = 0.1f;

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
      pattern_(make_pattern(query.samples, query.min_samples)), interpolated_(interpolated) {
  wants_light_ = query.radiance[0] && query.rays.shades;
  wants_map_ = !query.environment_map.empty() && (query.radiance[0] || query.environment_colour[0]);
  if (wants_map_ && !query.environment_space.empty())
    tracer.services_.current_to_space(state, query.environment_space, to_map_);
  const slvm::RayFacts& f = state.grid.ray;
  uint64_t h = mix(query.rays.seed, f.label);
  for (float x : {query.samples, query.min_samples, query.falloff, f.depth, f.specular_depth, f.diffuse_depth,
                  f.most_specular_depth, f.most_diffuse_depth})
    h = mix(h, x);
  for (std::string_view text : {query.rays.label, query.rays.subset, query.environment_map,
                                query.environment_space, std::string_view(f.type)})
    h = mix(h, text);
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
  if (p.base != 0)
    for (Vec3 side : {p.along_u, p.along_v})
      for (int c = 0; c < 3; ++c)
        h = mix(h, side[c]);
  return h;
}

/// Random numbers depend on the place, so that all grids see the same at a point they share.
uint64_t HemisphereSampler::seed_of(const HemispherePoint& p) const {
  return HemisphereCache::Key(p.P, p.N, mix(query_.rays.seed, uint64_t{1})).hash();
}

Vec3 HemisphereSampler::aim(const HemispherePoint& p, uint64_t seed, int cell, Vec3& origin) const {
  uint64_t h = mix(seed, uint64_t(cell));
  HemisphereDirection d = direction_in(pattern_, cell / pattern_.sectors, cell % pattern_.sectors,
                                       upper_unit(h), lower_unit(h), p.cone, query_.cosine);
  Vec3 x, y;
  basis_about(p.N, x, y);
  float sine = std::sqrt(std::max(0.0f, 1 - d.cosine * d.cosine));
  origin = p.P;
  if (p.base > 0) {
    uint64_t place = mix(h, uint64_t{2});
    origin += p.base * ((upper_unit(place) - 0.5f) * p.along_u + (lower_unit(place) - 0.5f) * p.along_v);
  }
  return x * (sine * std::cos(d.azimuth)) + y * (sine * std::sin(d.azimuth)) + p.N * d.cosine;
}

int HemisphereSampler::chosen_cell(int block, uint64_t seed) const {
  int across = pattern_.sectors / pattern_.sector_block;
  uint64_t h = mix(seed, uint64_t(block) + (uint64_t{1} << 32));
  int in_ring = static_cast<int>(upper_unit(h) * static_cast<float>(pattern_.ring_block)),
      in_sector = static_cast<int>(lower_unit(h) * static_cast<float>(pattern_.sector_block));
  return (block / across * pattern_.ring_block + in_ring) * pattern_.sectors +
         block % across * pattern_.sector_block + in_sector;
}

namespace {

template <class RaysT, class CellT>
void push_ray(RaysT& rays, const HemispherePoint& p, size_t index, Vec3 origin, Vec3 direction, float spread,
              int sample, Color weight, CellT* cell) {
  Vec3 x, y;
  basis_about(direction, x, y);
  for (int c = 0; c < 3; ++c) {
    rays.origin[c].push_back(origin[c]);
    rays.direction[c].push_back(direction[c]);
    rays.direction_du[c].push_back(x[c] * spread);
    rays.direction_dv[c].push_back(y[c] * spread);
    rays.still[c].push_back(0);
    rays.colour[c].push_back(0);
    rays.weight[c].push_back(weight[c]);
  }
  rays.max_distance.push_back(p.max_distance);
  rays.bias.push_back(p.bias);
  rays.point.push_back(p.number);
  rays.sample.push_back(static_cast<uint32_t>(sample));
  rays.cell.push_back(cell);
  rays.index.push_back(index);
  cell->direction = direction;
  cell->shot = true;
}

/// What a ray stands for, as an angle.
float spread_of(const HemispherePattern& p) {
  return std::sqrt(2 * kPi / static_cast<float>(p.cells()));
}

} // namespace

void HemisphereSampler::first_rays(std::span<const HemispherePoint> points, Rays& rays) {
  for (size_t i = 0; i < points.size(); ++i) {
    uint64_t seed = seed_of(points[i]);
    Color weight = shooter_.weight(query_.weight, points[i].number, points[i].number);
    for (int b = 0; b < pattern_.blocks(); ++b) {
      int cell = chosen_cell(b, seed);
      Vec3 origin, direction = aim(points[i], seed, cell, origin);
      push_ray(rays, points[i], i, origin, direction, spread_of(pattern_), cell, weight,
               &cells_[i * static_cast<size_t>(pattern_.cells()) + static_cast<size_t>(cell)]);
    }
  }
}

bool HemisphereSampler::differs(const Cell& a, const Cell& b) const {
  if ((a.distance == kInfinity) != (b.distance == kInfinity)) return true;
  if (a.distance != kInfinity &&
      std::max(a.distance, b.distance) > kDistanceContrast * std::min(a.distance, b.distance))
    return true;
  for (int c = 0; c < 3; ++c)
    if (std::abs(a.light[c] - b.light[c]) > kLightContrast * std::max({a.light[c], b.light[c], 0.1f}))
      return true;
  return false;
}

/// The cells left in blocks that differ from one of the four beside them.
void HemisphereSampler::more_rays(std::span<const HemispherePoint> points, Rays& rays) {
  int across = pattern_.sectors / pattern_.sector_block, down = pattern_.rings / pattern_.ring_block;
  for (size_t i = 0; i < points.size(); ++i) {
    uint64_t seed = seed_of(points[i]);
    Color weight = shooter_.weight(query_.weight, points[i].number, points[i].number);
    Cell* cells = &cells_[i * static_cast<size_t>(pattern_.cells())];
    std::vector<int> wanted;
    for (int b = 0; b < pattern_.blocks(); ++b) {
      int row = b / across, column = b % across;
      const Cell& own = cells[chosen_cell(b, seed)];
      auto other = [&](int r, int c) {
        return r >= 0 && r < down &&
               differs(own, cells[chosen_cell(r * across + (c + across) % across, seed)]);
      };
      if (other(row - 1, column) || other(row + 1, column) || other(row, column - 1) ||
          other(row, column + 1))
        wanted.push_back(b);
    }
    for (int b : wanted)
      for (int k = 0; k < pattern_.ring_block * pattern_.sector_block; ++k) {
        int cell = (b / across * pattern_.ring_block + k / pattern_.sector_block) * pattern_.sectors +
                   b % across * pattern_.sector_block + k % pattern_.sector_block;
        if (cells[cell].shot) continue;
        Vec3 origin, direction = aim(points[i], seed, cell, origin);
        push_ray(rays, points[i], i, origin, direction, spread_of(pattern_), cell, weight, &cells[cell]);
      }
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

/// Cells that were left out are like the one of their block that was not; of a block with several, all were
/// shot.
void HemisphereSampler::spread_blocks(Cell* cells) const {
  int across = pattern_.sectors / pattern_.sector_block;
  for (int b = 0; b < pattern_.blocks(); ++b) {
    auto cell_at = [&](int k) -> Cell& {
      return cells[(b / across * pattern_.ring_block + k / pattern_.sector_block) * pattern_.sectors +
                   b % across * pattern_.sector_block + k % pattern_.sector_block];
    };
    int size = pattern_.ring_block * pattern_.sector_block;
    const Cell* shot = nullptr;
    for (int k = 0; k < size; ++k)
      if (cell_at(k).shot) shot = &cell_at(k);
    for (int k = 0; k < size && shot; ++k)
      if (!cell_at(k).shot) {
        Cell copy = *shot;
        copy.shot = false;
        cell_at(k) = copy;
      }
  }
}

void HemisphereSampler::finish(const HemispherePoint& p, Cell* cells, HemisphereSample& out) const {
  spread_blocks(cells);
  auto count = static_cast<size_t>(pattern_.cells());
  double sum[HemisphereSample::kValues] = {}, nearness = 0;
  for (size_t k = 0; k < count; ++k) {
    const Cell& cell = cells[k];
    sum[0] += cell.blocked;
    for (int c = 0; c < 3; ++c) {
      sum[1 + c] += cell.light[c];
      sum[4 + c] += cell.map[c];
      if (cell.distance == kInfinity) sum[7 + c] += cell.direction[c];
    }
    // Behind the farthest distance there may be anything.
    float distance = std::min(cell.distance, p.max_distance);
    if (distance < kInfinity) nearness += 1 / std::max(distance, 1e-20f);
  }
  for (size_t i = 0; i < HemisphereSample::kValues; ++i)
    out.value[i] = static_cast<float>(sum[i] / static_cast<double>(count));
  out.distance = nearness > 0 ? static_cast<float>(static_cast<double>(count) / nearness) : kInfinity;
  if (interpolated_ && query_.cosine && p.cone <= kPi / 2 + 1e-4f) gradients(p, cells, out);
}

/// Ward and Heckbert 1992, equations for the rotation and the translation gradient, for means instead of
/// integrals; turns are about right-handed axes.
void HemisphereSampler::gradients(const HemispherePoint& p, const Cell* cells, HemisphereSample& out) const {
  const int M = pattern_.rings, N = pattern_.sectors;
  float reach = std::sin(std::min(p.cone, kPi / 2));
  Vec3 x, y;
  basis_about(p.N, x, y);
  auto values = [](const Cell& c) {
    return std::array<float, HemisphereSample::kGradients>{c.blocked, c.light.x, c.light.y, c.light.z,
                                                           c.map.x,   c.map.y,   c.map.z};
  };
  auto sine = [&](int ring) { return reach * std::sqrt(static_cast<float>(ring) / static_cast<float>(M)); };
  auto around = [&](float sector) {
    float a = 2 * kPi * sector / static_cast<float>(N);
    return x * std::cos(a) + y * std::sin(a);
  };
  float norm = 1 / (kPi * reach * reach);
  for (int k = 0; k < N; ++k) {
    Vec3 radial = around(static_cast<float>(k) + 0.5f);
    Vec3 turned = glm::cross(p.N, radial), at_edge = glm::cross(p.N, around(static_cast<float>(k)));
    for (int j = 0; j < M; ++j) {
      const Cell& cell = cells[j * N + k];
      auto here = values(cell);
      float middle = reach * std::sqrt((static_cast<float>(j) + 0.5f) / static_cast<float>(M));
      float tangent = middle / std::sqrt(std::max(1 - middle * middle, 1e-4f));
      auto add = [&](const Cell& other, Vec3 along, float factor) {
        float nearest = std::min(cell.distance, other.distance);
        if (!(nearest < kInfinity)) return;
        auto there = values(other);
        for (size_t i = 0; i < here.size(); ++i)
          out.move[i] += along * (factor * norm / std::max(nearest, 1e-6f) * (here[i] - there[i]));
      };
      if (j > 0) {
        float s = sine(j);
        add(cells[(j - 1) * N + k], radial, 2 * kPi / static_cast<float>(N) * s * (1 - s * s));
      }
      add(cells[j * N + (k + N - 1) % N], at_edge, sine(j + 1) - sine(j));
      for (size_t i = 0; i < here.size(); ++i)
        out.turn[i] += turned * (tangent * here[i] / static_cast<float>(M * N));
    }
  }
}

void HemisphereSampler::sample(std::span<const HemispherePoint> points, std::span<HemisphereSample> out) {
  auto cells = static_cast<size_t>(pattern_.cells());
  size_t at_a_time = std::max<size_t>(1, kRaysAtATime / cells);
  tracer_.hemispheres_ += points.size();
  Rays rays;
  for (size_t first = 0; first < points.size();) {
    auto part = points.subspan(first, std::min(at_a_time, points.size() - first));
    if (interpolated_) { // a sample belongs to its place, whichever grid asks
      part = points.subspan(first, 1);
      shooter_.seed = seed_of(part[0]);
      shooter_.one_point = true;
    }
    cells_.assign(part.size() * cells, {});
    rays.clear();
    first_rays(part, rays);
    cast(part, rays);
    if (pattern_.blocks() < pattern_.cells()) {
      rays.clear();
      more_rays(part, rays);
      if (rays.size() > 0) cast(part, rays);
    }
    for (size_t i = 0; i < part.size(); ++i)
      finish(part[i], &cells_[i * cells], out[first + i]);
    first += part.size();
  }
}

} // namespace render
