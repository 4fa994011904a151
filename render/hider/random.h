// Random numbers that are functions of where they are used, never of when: images do not depend on threads,
// buckets or crop windows.
#pragma once

#include <cstdint>

namespace render {

/// Mixes two integers and a purpose; the finaliser of splitmix64 (Steele, Lea and Flood, 2014).
constexpr uint64_t hash_of(int64_t x, int64_t y, uint64_t purpose) {
  uint64_t h = static_cast<uint64_t>(x) * 0x9e3779b97f4a7c15u +
               static_cast<uint64_t>(y) * 0xc2b2ae3d27d4eb4fu + purpose * 0x165667b19e3779f9u;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

/// The upper and the lower half of a hash as floats in [0, 1).
constexpr float upper_unit(uint64_t h) {
  return static_cast<float>(h >> 40) * 0x1p-24f;
}
constexpr float lower_unit(uint64_t h) {
  return static_cast<float>(h & 0xffffffu) * 0x1p-24f;
}

enum RandomPurpose : uint64_t {
  kJitter = 1,
  kDither = 2,
  kImager = 3,
  kStrata = 4,
  kTime = 5,
  kLens = 6,
  kLensCells = 7,
  kLevelStrata = 8,
  kLevel = 9,
  kHits = 10,
  kDisplacedFaces = 11,
  kRayTime = 12,
  kHemisphere = 13,
  kPhotonOrigin = 14,
  kPhotonScattering = 15
};

} // namespace render
