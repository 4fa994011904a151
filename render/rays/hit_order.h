// The order in which hits of a batch are shaded: those whose points can be in one grid together, and among
// them those of one primitive.
#pragma once

#include "render/rays/hit_grid.h"
#include "render/shading/bound_shaders.h"

#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

namespace render {

/// Which primitives can be diced and shaded side by side: their shaders, lights and variables are the same,
/// and nothing that shaders may ask for tells one from the other. Numbers from 1 on are given as primitives
/// are met.
class HitGroups {
public:
  /// All arguments must outlive this.
  HitGroups(const Scene& scene, const BoundShaders& shaders);
  ~HitGroups();

private:
  friend class HitOrder;
  struct Numbers;
  uint32_t group_of(uint32_t primitive);
  size_t count() const;

  const Scene& scene_;
  const BoundShaders& shaders_;
  std::mutex mutex_;
  std::vector<uint32_t> of_run_; ///< by run of the scene's primitives; 0: not known yet
  std::unordered_map<uint32_t, uint32_t> of_primitive_; ///< of runs whose variables differ
  std::unique_ptr<Numbers> numbers_;
};

/// One batch after another; memory is used again.
class HitOrder {
public:
  /// The hits by group, then primitive, then ray; groups and primitives in the order of their first hits
  /// here, whatever their numbers. Valid until the next call, as long as `hits` are.
  std::span<const HitRay> sort(std::span<const HitRay> hits, HitGroups& groups);
  /// Of each group, the number of the hit that follows.
  std::span<const size_t> group_ends() const { return group_ends_; }

private:
  struct Bucket { ///< hits of one primitive
    uint32_t primitive, group, first = 0, count = 0;
  };
  static constexpr uint32_t kNone = ~0u;
  size_t fill_buckets(std::span<const HitRay> hits, HitGroups& groups);

  std::vector<HitRay> in_order_;
  std::vector<Bucket> buckets_;
  std::vector<uint32_t> bucket_of_; ///< by number of the hit
  std::vector<uint32_t> table_;     ///< buckets by a hash of their primitives, kNone where there is none
  std::vector<uint32_t> in_groups_; ///< buckets
  std::vector<size_t> group_ends_;
};

} // namespace render
