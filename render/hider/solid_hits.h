// All surfaces of one solid that lie over the samples of a bucket, kept until they are complete: then the
// solid's tree tells for each sample which of them bound the solid. The others are inside it, or in parts
// that were taken away.
#pragma once

#include "render/prims/solid.h"
#include "render/state/math.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace render {

struct SolidHit {
  Color Ci, Oi;
  float z;
  uint32_t sample;
  SolidTree::NodeIndex primitive; ///< that the surface belongs to
  bool matte;
  bool unseen; ///< counts, but is not shown: cut away by a clipping plane, or seen from its back with Sides 1
  bool cut_near; ///< the primitive reaches in front of the near plane, where its surfaces are missing
};

class SolidHits {
public:
  bool empty() const { return hits_.empty(); }
  size_t size() const { return hits_.size(); }
  void add(const SolidHit& hit) { hits_.push_back(hit); }

  /// Calls `show` with the number and the content of each hit that is on the boundary of the solid and to be
  /// seen, and forgets all hits. All belong to `tree`.
  ///
  /// Along each ray, surfaces are crossed front to back. A primitive with an odd number of them starts at the
  /// near plane if it reaches beyond; else it is not closed there (a crack, an open surface), and its last
  /// surface bounds a volume without thickness: it is seen where the solid would begin or end, but nothing
  /// behind it changes. Of surfaces at the same depth, crossed together, the first that was added shows.
  void resolve(const SolidTree& tree, const std::function<void(size_t, const SolidHit&)>& show);

private:
  using Order = std::vector<uint32_t>;
  void resolve_ray(Order::const_iterator begin, Order::const_iterator end, SolidSide& side,
                   const std::function<void(size_t, const SolidHit&)>& show);
  void find_unpaired(Order::const_iterator begin, Order::const_iterator end, SolidSide& side);
  void cross_together(Order::const_iterator begin, Order::const_iterator end, SolidSide& side,
                      const std::function<void(size_t, const SolidHit&)>& show) const;

  static constexpr uint32_t kNone = 0xffffffffu;
  std::vector<SolidHit> hits_;
  std::vector<uint32_t> unpaired_; ///< for each primitive: the hit without a partner on the ray, or kNone
};

} // namespace render
