// The samples of a scatter map by the faces of the mesh they come from, in place of an octree (Tomson, 5.5):
// each face has a box and a list of the faces near it. What this takes depends on the mesh, not on how many
// samples there are; and faces are what goes to disk when memory is short.
#pragma once

#include "stdlib/subsurface/block_pool.h"
#include "stdlib/subsurface/point_cloud.h"

#include <map>
#include <shared_mutex>
#include <span>

namespace subsurface {

/// A sample of a scatter map: a piece of surface.
struct ScatterSample {
  Vec3 position, normal;
  float area = 0;
};

struct FaceBox {
  Vec3 low, high;

  /// To the nearest place of it, squared; 0 inside.
  float distance2(Vec3 x) const;
  float distance2(const FaceBox& other) const;
};

/// Not changed once made, but for lists of near faces, which are made when they are first asked for.
class FaceMap {
public:
  /// The samples [starts[f], starts[f + 1]) are those of face f. All go into `pool`.
  FaceMap(std::span<const ScatterSample> samples, std::vector<uint32_t> starts,
          std::shared_ptr<BlockPool> pool);
  ~FaceMap() { pool_->remove(first_block_, static_cast<uint32_t>(boxes_.size())); }
  FaceMap(const FaceMap&) = delete;
  FaceMap& operator=(const FaceMap&) = delete;

  size_t size() const { return starts_.back(); } ///< samples
  size_t faces() const { return boxes_.size(); }
  const FaceBox& box(uint32_t face) const { return boxes_[face]; }
  uint32_t first_sample(uint32_t face) const { return starts_[face]; }
  uint32_t face_of(uint32_t sample) const;
  /// The face whose box is nearest to x. `hint`: one that may be it.
  uint32_t face_at(Vec3 x, uint32_t hint) const;
  /// The faces whose boxes are within D of that of `face`, or a little farther; itself, too.
  std::span<const uint32_t> near(uint32_t face, float D) const;
  /// Seven numbers a sample: position, normal, area. Null: they are lost.
  BlockPool::Handle samples(uint32_t face) const { return pool_->get(first_block_ + face); }
  /// Memory of all but the samples.
  size_t bytes() const;

private:
  std::vector<uint32_t> starts_;
  std::vector<FaceBox> boxes_;
  std::shared_ptr<BlockPool> pool_;
  uint32_t first_block_ = 0;

  using Key = std::pair<int, uint32_t>; // D in steps, face
  mutable std::shared_mutex lists_mutex_;
  mutable std::map<Key, std::vector<uint32_t>> lists_;
};

/// What one thread reads of a map, kept in memory until forget().
class FaceReader {
public:
  explicit FaceReader(const FaceMap& map) : map_(&map) {}

  ScatterSample sample(uint32_t i);
  /// Calls f(number, distance squared) for each sample not farther from x than D, always in the same order.
  template <class F> void for_each_within(Vec3 x, float D, F&& f) {
    if (map_->faces() == 0) return;
    hint_ = map_->face_at(x, hint_);
    const float off = std::sqrt(map_->box(hint_).distance2(x));
    for (uint32_t face : map_->near(hint_, D + off)) {
      if (map_->box(face).distance2(x) > D * D) continue;
      const BlockPool::Block* block = read(face);
      const uint32_t first = map_->first_sample(face);
      for (uint32_t k = 0; block && k < block->size() / kNumbers; ++k)
        if (const float d2 = length2(x - position(*block, k)); d2 <= D * D) f(first + k, d2);
    }
  }
  void forget() { held_.clear(); }

private:
  static constexpr size_t kNumbers = 7;
  static Vec3 position(const BlockPool::Block& block, size_t k) {
    return {block[kNumbers * k], block[kNumbers * k + 1], block[kNumbers * k + 2]};
  }
  const BlockPool::Block* read(uint32_t face);

  const FaceMap* map_;
  uint32_t hint_ = 0;
  std::map<uint32_t, BlockPool::Handle> held_;
};

} // namespace subsurface
