#include "render/hider/bucket_shares.h"

#include <algorithm>

namespace render {

BucketShares::BucketShares(size_t columns, size_t rows, size_t threads) {
  // Whole rows, where there are as many.
  const size_t unit = rows >= threads ? columns : 1, units = columns * rows / unit;
  for (size_t t = 0; t < threads; ++t)
    shares_.push_back({units * t / threads * unit, units * (t + 1) / threads * unit});
}

std::optional<size_t> BucketShares::next(size_t thread) {
  std::lock_guard lock(mutex_);
  Share& own = shares_[thread];
  if (own.left() == 0) {
    Share& slowest = *std::max_element(shares_.begin(), shares_.end(),
                                       [](const Share& a, const Share& b) { return a.left() < b.left(); });
    if (slowest.left() == 0) return {};
    own = {slowest.next + slowest.left() / 2, slowest.end};
    slowest.end = own.next;
  }
  return own.next++;
}

} // namespace render
