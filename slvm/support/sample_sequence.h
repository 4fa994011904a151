// Where the samples of a point go: four numbers from 0 to 1 for each, as evenly spread as can be for every
// count of samples, and different at every point. PUBLIC.
//
// The first two numbers of the first 2^m samples are a net: of all 2^m rectangles of the unit square that any
// one grid of 2^k columns and 2^(m - k) rows has, each holds one; scrambling keeps that.
//
// Sobol's sequence (I. M. Sobol, 1967), dimensions and direction numbers of S. Joe and F. Y. Kuo,
// "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30(5), 2008.
// Each point has a scrambling of its own after A. B. Owen, by the hash of S. Laine and T. Karras in the form
// of B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020, section 3.
#pragma once

#include <cstdint>

namespace slvm {

/// A bijection in which every input bit changes about half of the output bits (C. Wellons, "Prospecting for
/// Hash Functions", 2018).
constexpr uint32_t mixed_bits(uint32_t h) {
  h = (h ^ h >> 16) * 0x21f0aaadu;
  h = (h ^ h >> 15) * 0x735a2d97u;
  return h ^ h >> 15;
}

constexpr uint32_t reversed_bits(uint32_t x) {
  x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
  x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
  x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
  x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
  return x >> 16 | x << 16;
}

/// What numbers of one dimension are used for.
enum class SampleUse : uint8_t { kTurn, kRadius, kBaseU, kBaseV };
inline constexpr int kSampleUses = 4;

/// Sample `index` of the unscrambled sequence, its bits from the last to the first.
struct SobolSample {
  explicit SobolSample(uint32_t index);
  uint32_t bits[kSampleUses];
};

/// The seed of a point's scrambling, for one use.
constexpr uint32_t scramble_seed(uint32_t point_seed, SampleUse use) {
  return mixed_bits(point_seed + 0x9e3779b9u * (static_cast<uint32_t>(use) + 1));
}

/// A sample's number in [0, 1), a multiple of 2^-24.
inline float scrambled(uint32_t bits, uint32_t seed) {
  uint32_t x = bits + seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return static_cast<float>(static_cast<int32_t>(reversed_bits(x) >> 8)) * 0x1p-24f;
}

/// The seed of a point: of its grid, of the call.
constexpr uint32_t point_seed(uint64_t grid, uint32_t call, uint32_t point) {
  uint32_t h = mixed_bits(static_cast<uint32_t>(grid) + 0x3c6ef372u * call);
  h = mixed_bits(h ^ static_cast<uint32_t>(grid >> 32));
  return mixed_bits(h + point);
}

} // namespace slvm
