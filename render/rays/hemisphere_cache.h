// Hemisphere samples of a frame by the points they were taken at. A sample is a function of its key, so that
// it does not matter who takes it, or whether it is found here: the cache saves rays only. Grids that meet at
// an edge share the samples on it.
#pragma once

#include "render/rays/hemisphere_sample.h"

#include <array>
#include <bit>
#include <cstdint>
#include <mutex>
#include <optional>
#include <unordered_map>

namespace render {

class HemisphereCache {
public:
  struct Key {
    std::array<uint32_t, 6> place{}; ///< bits of P and N
    uint64_t call = 0;               ///< of all else that the sample depends on
    Key(Vec3 p, Vec3 n, uint64_t c)
        : place{bits(p.x), bits(p.y), bits(p.z), bits(n.x), bits(n.y), bits(n.z)}, call(c) {}
    bool operator==(const Key&) const = default;
    uint64_t hash() const {
      uint64_t h = call;
      for (uint32_t x : place) {
        h = (h ^ x) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
      }
      return h ^ (h >> 32);
    }

  private:
    static uint32_t bits(float x) { return std::bit_cast<uint32_t>(x + 0.0f); } // -0 is 0
  };

  std::optional<HemisphereSample> find(const Key& key) {
    Shard& shard = shard_of(key);
    std::lock_guard lock(shard.mutex);
    auto it = shard.samples.find(key);
    if (it == shard.samples.end()) return {};
    return it->second;
  }
  void add(const Key& key, const HemisphereSample& sample) {
    Shard& shard = shard_of(key);
    std::lock_guard lock(shard.mutex);
    if (shard.samples.size() < kMostInShard) shard.samples.try_emplace(key, sample);
  }

private:
  static constexpr size_t kShards = 64, kMostInShard = (size_t{1} << 20) / kShards; // some 250 MB
  struct Hash {
    size_t operator()(const Key& key) const { return static_cast<size_t>(key.hash()); }
  };
  struct Shard {
    std::mutex mutex;
    std::unordered_map<Key, HemisphereSample, Hash> samples;
  };
  Shard& shard_of(const Key& key) { return shards_[(key.hash() >> 40) % kShards]; }
  std::array<Shard, kShards> shards_;
};

} // namespace render
