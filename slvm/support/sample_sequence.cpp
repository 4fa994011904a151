// Sobol's sequence, by its direction numbers.
#include "slvm/support/sample_sequence.h"

#include <array>
#include <cstddef>

namespace slvm {
namespace {

constexpr int kBits = 32;
using Directions = std::array<uint32_t, kBits>;

/// Direction numbers of a primitive polynomial of this degree, whose inner coefficients are the bits of
/// `coefficients`, from the first m (Joe and Kuo, equations 2 and 3).
template <size_t kDegree>
constexpr Directions directions(uint32_t coefficients, const std::array<uint32_t, kDegree>& first) {
  Directions v{};
  for (size_t i = 0; i < kBits; ++i) {
    if (i < kDegree) {
      v[i] = first[i] << (kBits - 1 - i);
      continue;
    }
    v[i] = v[i - kDegree] ^ v[i - kDegree] >> kDegree;
    for (size_t k = 1; k < kDegree; ++k)
      if (coefficients >> (kDegree - 1 - k) & 1) v[i] ^= v[i - k];
  }
  return v;
}

/// The first dimension: the bits of the index in reverse order (van der Corput).
constexpr Directions van_der_corput() {
  Directions v{};
  for (size_t i = 0; i < kBits; ++i)
    v[i] = 1u << (kBits - 1 - i);
  return v;
}

constexpr std::array<Directions, kSampleUses> kDirections{
    van_der_corput(), directions<1>(0, {1}), directions<2>(1, {1, 3}), directions<3>(1, {1, 3, 1})};

} // namespace

SobolSample::SobolSample(uint32_t index) {
  for (size_t use = 0; use < kSampleUses; ++use) {
    uint32_t x = 0;
    for (size_t bit = 0; index >> bit; ++bit) {
      if (index >> bit & 1) x ^= kDirections[use][bit];
      if (bit + 1 == kBits) break;
    }
    bits[use] = reversed_bits(x);
  }
}

} // namespace slvm
