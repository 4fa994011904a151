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
  for (int c = 0; c < pattern_.cells(); ++c)
    block_of_.push_back(static_cast<uint32_t>(pattern_.block_of(c)));
  if (!pattern_.is_net()) return;
  // The sequence is linear: its sample a + b, without common bits, is that of a xor that of b.
  const auto cells = static_cast<uint32_t>(pattern_.cells());
  for (auto& numbers : sequence_)
    numbers.resize(cells);
  for (uint32_t bit = 1; bit < cells; bit *= 2) {
    const slvm::SobolSample of_bit(bit);
    for (size_t use = 0; use < slvm::kSampleUses; ++use)
      for (uint32_t i = 0; i < bit; ++i)
        sequence_[use][bit + i] = sequence_[use][i] ^ of_bit.bits[use];
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
  if (pattern_.is_net())
    return draw(point, seed, static_cast<size_t>(pattern_.blocks()), static_cast<size_t>(pattern_.cells()),
                wanted);
  std::vector<int> cells;
  for (int c = 0; c < pattern_.cells(); ++c)
    if (const auto b = static_cast<size_t>(pattern_.block_of(c)); wanted[b] && chosen[b] != c)
      cells.push_back(c);
  draw_in_cells(point, seed, cells);
}

/// Samples of the sequence, only those in blocks that are `wanted` (empty: all). Passes take one part of it
/// after the other: parts as long as a power of two are nets, too, and together they are evener than each.
void HemisphereAim::draw(const HemispherePoint& point, uint64_t seed, size_t first, size_t last,
                         std::span<const uint8_t> wanted) {
  const size_t count = last - first;
  const slvm::SobolSample offset(point.pass * static_cast<uint32_t>(pattern_.cells()));
  auto numbers = [&](SampleUse use, size_t how_many, std::vector<float>& out, auto&& bits_of) {
    const auto u = static_cast<size_t>(use);
    const uint32_t scrambling = slvm::scramble_seed(static_cast<uint32_t>(seed ^ seed >> 32), use),
                   shift = offset.bits[u];
    const uint32_t* bits = sequence_[u].data() + first;
    out.resize(how_many);
    float* to = out.data();
    for (size_t i = 0; i < how_many; ++i)
      to[i] = slvm::scrambled(bits_of(bits, i) ^ shift, scrambling);
  };
  auto in_order = [](const uint32_t* bits, size_t i) { return bits[i]; };
  numbers(SampleUse::kRadius, count, radius_, in_order);
  numbers(SampleUse::kTurn, count, turn_, in_order);
  cell.resize(count);
  const auto rings = static_cast<float>(pattern_.rings), sectors = static_cast<float>(pattern_.sectors);
  for (size_t i = 0; i < count; ++i)
    cell[i] = static_cast<int>(radius_[i] * rings) * pattern_.sectors + static_cast<int>(turn_[i] * sectors);
  if (!wanted.empty()) keep_wanted(wanted);
  if (point.base > 0) {
    auto kept = [this](const uint32_t* bits, size_t i) { return bits[kept_[i]]; };
    for (size_t k = 0; k < 2; ++k) {
      const SampleUse use = k == 0 ? SampleUse::kBaseU : SampleUse::kBaseV;
      if (wanted.empty())
        numbers(use, count, base_[k], in_order);
      else
        numbers(use, cell.size(), base_[k], kept);
    }
  }
  finish(point);
}

/// Leaves those in wanted blocks, and in `kept_` which they were.
void HemisphereAim::keep_wanted(std::span<const uint8_t> wanted) {
  kept_.resize(cell.size());
  size_t count = 0;
  for (size_t i = 0; i < cell.size(); ++i) {
    kept_[count] = static_cast<uint32_t>(i);
    cell[count] = cell[i];
    radius_[count] = radius_[i];
    turn_[count] = turn_[i];
    count += wanted[block_of_[static_cast<size_t>(cell[i])]];
  }
  cell.resize(count);
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
