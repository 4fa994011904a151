// Hemisphere samples of a frame that other points near them can use: the cache of Ward, Rubinstein and Clear
// (A Ray Tracing Solution for Diffuse Interreflection, SIGGRAPH 1988) with gradients (Ward and Heckbert,
// Irradiance Gradients, 1992). It serves points that are no lattice worth interpolating in itself: polygons
// smaller than a few micropolygons, and what rays hit. Larger grids (hemisphere_lattice.h) put their samples
// here, but take none out, so that they do not depend on the order of work; results of the others depend on
// it within the error that is allowed.
//
// Two things keep small objects from being overlooked. The distance of a sample is no more than that of
// another one plus the way between them (Krivanek and others, Making Radiance and Irradiance Caching
// Practical, 2006), and where a new sample is not what those before it foretell, these reach less far.
#pragma once

#include "render/rays/hemisphere_sample.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <unordered_map>
#include <vector>

namespace render {

/// How far samples may be used.
struct RecordRule {
  uint64_t call = 0;      ///< of all that samples depend on but the place
  float max_error = 0.5f; ///< of Ward's estimate: distance by the sample's own, plus the turn of the normal
  float tolerance = 0.1f; ///< by which a new sample may differ from what was foretold, relative to the whole
  float nearest = 0, farthest = kInfinity; ///< bounds of the distance samples are used at
};

class HemisphereRecords {
public:
  /// The mean of the samples near a point, as they foretell it; none: there are none near enough.
  std::optional<HemisphereSample> find(const RecordRule& rule, Vec3 P, Vec3 N);
  /// Adds a sample, and lets those around it know.
  void add(const RecordRule& rule, Vec3 P, Vec3 N, const HemisphereSample& sample);

  size_t size() const { return count_; }

private:
  struct Record {
    Record(Vec3 p, Vec3 n, const HemisphereSample& s, float r) : P(p), N(n), sample(s), reach(r) {}
    Vec3 P, N;
    HemisphereSample sample;
    std::atomic<float> reach; ///< Ward's distance; times max_error, the farthest it is used at
  };
  /// Cubes whose side is a power of two; a record is in those of its size that it reaches into.
  struct Cell {
    uint64_t call;
    int32_t level, x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct Hash {
    size_t operator()(const Cell& c) const;
  };
  struct Shard {
    std::shared_mutex mutex;
    std::deque<Record> records;
    std::unordered_map<Cell, std::vector<Record*>, Hash> cells;
  };
  static constexpr size_t kShards = 64, kMost = size_t{1} << 20;
  static constexpr int kLowest = -40, kHighest = 40; ///< levels

  template <class F> void near(const RecordRule& rule, Vec3 P, F&& f);
  Shard& shard_of(const Cell& cell) { return shards_[Hash()(cell) >> 20 & (kShards - 1)]; }

  std::array<Shard, kShards> shards_;
  std::array<std::atomic<bool>, kHighest - kLowest + 1> used_{}; ///< levels with records
  std::atomic<size_t> count_{0};
};

} // namespace render
