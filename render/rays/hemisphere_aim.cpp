// Loops over the rays of a point, component by component, which compilers vectorise for each target.
#include "render/rays/hemisphere_aim.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/rays/hemisphere_aim.cpp"
#include <hwy/foreach_target.h>

#include "render/hider/random.h"
#include "slvm/support/sample_sequence.h"
#include "slvm/support/turn.h"
#include "slvm/wide/targets.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Numbers of samples of the sequence, all scrambled alike.
void scramble_all(const uint32_t* bits, size_t count, uint32_t shift, uint32_t scrambling,
                  float* __restrict out) {
  for (size_t i = 0; i < count; ++i)
    out[i] = slvm::scrambled(bits[i] ^ shift, scrambling);
}

/// The cells that places in the disk are in.
void find_cells(const float* radius, const float* turn, size_t count, int rings, int sectors,
                int* __restrict out) {
  const auto r = static_cast<float>(rings), s = static_cast<float>(sectors);
  for (size_t i = 0; i < count; ++i)
    out[i] = static_cast<int>(radius[i] * r) * sectors + static_cast<int>(turn[i] * s);
}

/// Directions about n of places in the disk.
void aim_all(const float* radius, const float* turn, size_t count, const CosineOfRadius& cosine_of, Vec3 x,
             Vec3 y, Vec3 n, float* __restrict dx, float* __restrict dy, float* __restrict dz) {
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
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {

namespace {

const auto kScramble = SL_BEST(scramble_all);
const auto kFindCells = SL_BEST(find_cells);
const auto kAim = SL_BEST(aim_all);

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
  auto bits_of = [&](SampleUse use) { return sequence_[static_cast<size_t>(use)].data() + first; };
  auto numbers = [&](SampleUse use, const uint32_t* bits, size_t how_many, std::vector<float>& out) {
    out.resize(how_many);
    kScramble(bits, how_many, offset.bits[static_cast<size_t>(use)],
              slvm::scramble_seed(static_cast<uint32_t>(seed ^ seed >> 32), use), out.data());
  };
  numbers(SampleUse::kRadius, bits_of(SampleUse::kRadius), count, radius_);
  numbers(SampleUse::kTurn, bits_of(SampleUse::kTurn), count, turn_);
  cell.resize(count);
  kFindCells(radius_.data(), turn_.data(), count, pattern_.rings, pattern_.sectors, cell.data());
  if (!wanted.empty()) keep_wanted(wanted);
  if (point.base > 0) {
    for (size_t k = 0; k < 2; ++k) {
      const SampleUse use = k == 0 ? SampleUse::kBaseU : SampleUse::kBaseV;
      const uint32_t* bits = bits_of(use);
      if (!wanted.empty()) {
        kept_bits_.resize(cell.size());
        for (size_t i = 0; i < cell.size(); ++i)
          kept_bits_[i] = bits[kept_[i]];
        bits = kept_bits_.data();
      }
      numbers(use, bits, cell.size(), base_[k]);
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
  kAim(radius_.data(), turn_.data(), count, CosineOfRadius(point.cone, cosine_weighted_), x, y, point.N,
       direction[0].data(), direction[1].data(), direction[2].data());
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
#endif // HWY_ONCE
