// From all surfaces of a solid to those that bound it.
#include "render/hider/solid_hits.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Depths closer than this part of them are the same: the rounding of two interpolations.
constexpr float kSameDepth = 1e-6f;

} // namespace

void SolidHits::resolve(const SolidTree& tree, const std::function<void(size_t, const SolidHit&)>& show) {
  Order order(hits_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const SolidHit &x = hits_[a], &y = hits_[b];
    if (x.sample != y.sample) return x.sample < y.sample;
    return x.z != y.z ? x.z < y.z : a < b;
  });
  SolidSide side(tree); // outside again after each ray
  unpaired_.assign(tree.size(), kNone);
  for (auto ray = order.cbegin(); ray != order.cend();) {
    auto end =
        std::find_if(ray, order.cend(), [&](uint32_t h) { return hits_[h].sample != hits_[*ray].sample; });
    resolve_ray(ray, end, side, show);
    ray = end;
  }
  hits_.clear();
}

void SolidHits::resolve_ray(Order::const_iterator begin, Order::const_iterator end, SolidSide& side,
                            const std::function<void(size_t, const SolidHit&)>& show) {
  find_unpaired(begin, end, side);
  for (auto at = begin; at != end;) {
    float limit = hits_[*at].z + kSameDepth * std::abs(hits_[*at].z);
    auto next = std::find_if(at, end, [&](uint32_t h) { return hits_[h].z > limit; });
    cross_together(at, next, side, show);
    at = next;
  }
  for (auto h = begin; h != end; ++h)
    unpaired_[hits_[*h].primitive] = kNone;
}

/// The last hit of each primitive that has an odd number of them; none if the ray starts inside it, where
/// `side` then is.
void SolidHits::find_unpaired(Order::const_iterator begin, Order::const_iterator end, SolidSide& side) {
  for (auto h = begin; h != end; ++h) {
    uint32_t& last = unpaired_[hits_[*h].primitive];
    last = last == kNone ? *h : kNone;
  }
  for (auto h = begin; h != end; ++h) {
    const SolidHit& hit = hits_[*h];
    if (unpaired_[hit.primitive] != *h || !hit.cut_near) continue;
    unpaired_[hit.primitive] = kNone;
    side.cross(hit.primitive);
  }
}

void SolidHits::cross_together(Order::const_iterator begin, Order::const_iterator end, SolidSide& side,
                               const std::function<void(size_t, const SolidHit&)>& show) const {
  auto unpaired = [&](uint32_t h) { return unpaired_[hits_[h].primitive] == h; };
  bool before = side.inside();
  for (auto h = begin; h != end; ++h)
    if (!unpaired(*h)) side.cross(hits_[*h].primitive);
  bool after = side.inside(), changes = before != after;
  for (auto h = begin; h != end; ++h) {
    bool bounds = changes;
    if (unpaired(*h)) {
      side.cross(hits_[*h].primitive);
      bounds = changes || side.inside() != after;
      side.cross(hits_[*h].primitive);
    }
    if (!bounds || hits_[*h].unseen) continue;
    show(*h, hits_[*h]);
    return;
  }
}

} // namespace render
