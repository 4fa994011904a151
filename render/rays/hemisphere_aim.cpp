// Loops over the rays of a point, component by component, which compilers vectorise.
#include "render/rays/hemisphere_aim.h"

#include "render/hider/random.h"
#include "slvm/support/sample_sequence.h"
#include "slvm/support/turn.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

using slvm::SampleUse;

uint64_t mix(uint64_t a, uint64_t b) {
  return hash_of(static_cast<int64_t>(a), static_cast<int64_t>(b), kHemisphere);
}

} // namespace

HemisphereAim::HemisphereAim(const HemispherePattern& pattern, bool cosine_weighted)
    : pattern_(pattern), cosine_weighted_(cosine_weighted) {
  for (int i = 0; pattern_.is_net() && i < pattern_.cells(); ++i) {
    const slvm::SobolSample sample(static_cast<uint32_t>(i));
    for (size_t use = 0; use < slvm::kSampleUses; ++use)
      sequence_[use].push_back(sample.bits[use]);
  }
}

void HemisphereAim::first(const HemispherePoint& point, uint64_t seed) {
  const auto blocks = static_cast<size_t>(pattern_.blocks());
  if (pattern_.is_net()) return draw(point, seed, 0, blocks);
  cell.resize(blocks);
  for (size_t b = 0; b < blocks; ++b)
    cell[b] = random_cell(static_cast<int>(b), mix(seed, point.pass));
  draw_in_cells(point, seed, std::vector<int>(cell));
}

void HemisphereAim::others(const HemispherePoint& point, uint64_t seed, std::span<const uint8_t> wanted,
                           std::span<const int> chosen) {
  std::vector<int> cells;
  for (int c = 0; c < pattern_.cells(); ++c)
    if (const auto b = static_cast<size_t>(pattern_.block_of(c)); wanted[b] && chosen[b] != c)
      cells.push_back(c);
  if (!pattern_.is_net()) return draw_in_cells(point, seed, cells);
  draw(point, seed, static_cast<size_t>(pattern_.blocks()), static_cast<size_t>(pattern_.cells()));
  size_t kept = 0;
  for (size_t i = 0; i < cell.size(); ++i) {
    if (!wanted[static_cast<size_t>(pattern_.block_of(cell[i]))]) continue;
    cell[kept] = cell[i];
    for (size_t c = 0; c < 3; ++c) {
      direction[c][kept] = direction[c][i];
      origin[c][kept] = origin[c][i];
    }
    ++kept;
  }
  cell.resize(kept);
  for (size_t c = 0; c < 3; ++c) {
    direction[c].resize(kept);
    origin[c].resize(kept);
  }
}

/// Samples of the sequence. Passes take one part of it after the other: parts as long as a power of two are
/// nets, too, and together they are evener than each.
void HemisphereAim::draw(const HemispherePoint& point, uint64_t seed, size_t first, size_t last) {
  const size_t count = last - first;
  // The sequence is linear: its sample a + b, without common bits, is that of a xor that of b.
  const slvm::SobolSample offset(point.pass * static_cast<uint32_t>(pattern_.cells()));
  auto numbers = [&](SampleUse use, std::vector<float>& out) {
    const auto u = static_cast<size_t>(use);
    const uint32_t scrambling = slvm::scramble_seed(static_cast<uint32_t>(seed ^ seed >> 32), use),
                   shift = offset.bits[u];
    const uint32_t* bits = sequence_[u].data() + first;
    out.resize(count);
    float* to = out.data();
    for (size_t i = 0; i < count; ++i)
      to[i] = slvm::scrambled(bits[i] ^ shift, scrambling);
  };
  numbers(SampleUse::kRadius, radius_);
  numbers(SampleUse::kTurn, turn_);
  if (point.base > 0) {
    numbers(SampleUse::kBaseU, base_[0]);
    numbers(SampleUse::kBaseV, base_[1]);
  }
  cell.resize(count);
  const auto rings = static_cast<float>(pattern_.rings), sectors = static_cast<float>(pattern_.sectors);
  for (size_t i = 0; i < count; ++i)
    cell[i] = static_cast<int>(radius_[i] * rings) * pattern_.sectors + static_cast<int>(turn_[i] * sectors);
  finish(point);
}

/// Random places in cells.
void HemisphereAim::draw_in_cells(const HemispherePoint& point, uint64_t seed, std::span<const int> cells) {
  cell.assign(cells.begin(), cells.end());
  for (auto* numbers : {&radius_, &turn_, &base_[0], &base_[1]})
    numbers->resize(cells.size());
  const uint64_t own = mix(seed, point.pass);
  for (size_t i = 0; i < cells.size(); ++i) {
    const uint64_t h = mix(own, uint64_t(cells[i])), place = mix(h, uint64_t{2});
    radius_[i] = (static_cast<float>(cells[i] / pattern_.sectors) + upper_unit(h)) /
                 static_cast<float>(pattern_.rings);
    turn_[i] = (static_cast<float>(cells[i] % pattern_.sectors) + lower_unit(h)) /
               static_cast<float>(pattern_.sectors);
    base_[0][i] = upper_unit(place);
    base_[1][i] = lower_unit(place);
  }
  finish(point);
}

int HemisphereAim::random_cell(int block, uint64_t seed) const {
  if (pattern_.blocks() == pattern_.cells()) return block;
  const int across = pattern_.sectors / pattern_.sector_block;
  const uint64_t h = mix(seed, uint64_t(block) + (uint64_t{1} << 32));
  const int in_ring = static_cast<int>(upper_unit(h) * static_cast<float>(pattern_.ring_block)),
            in_sector = static_cast<int>(lower_unit(h) * static_cast<float>(pattern_.sector_block));
  return (block / across * pattern_.ring_block + in_ring) * pattern_.sectors +
         block % across * pattern_.sector_block + in_sector;
}

/// From places in the disk and on the element to directions and origins.
void HemisphereAim::finish(const HemispherePoint& point) {
  const size_t count = cell.size();
  for (size_t c = 0; c < 3; ++c) {
    direction[c].resize(count);
    origin[c].resize(count);
  }
  Vec3 x, y;
  basis_about(point.N, x, y);
  const CosineOfRadius cosine_of(point.cone, cosine_weighted_);
  const Vec3 n = point.N;
  float *dx = direction[0].data(), *dy = direction[1].data(), *dz = direction[2].data();
  const float *radius = radius_.data(), *turn = turn_.data();
  for (size_t i = 0; i < count; ++i) {
    const float cosine = cosine_of(radius[i]), squared = 1 - cosine * cosine,
                sine = std::sqrt(squared > 0 ? squared : 0.0f);
    float up, across;
    slvm::sine_and_cosine(turn[i], up, across);
    const float a = sine * across, b = sine * up;
    dx[i] = x.x * a + y.x * b + n.x * cosine;
    dy[i] = x.y * a + y.y * b + n.y * cosine;
    dz[i] = x.z * a + y.z * b + n.z * cosine;
  }
  for (int c = 0; c < 3; ++c) {
    float* to = origin[c].data();
    const float middle = point.P[c], u = point.base * point.along_u[c], v = point.base * point.along_v[c];
    if (point.base > 0)
      for (size_t i = 0; i < count; ++i)
        to[i] = middle + ((base_[0][i] - 0.5f) * u + (base_[1][i] - 0.5f) * v);
    else
      std::fill_n(to, count, middle);
  }
}

} // namespace render
