// Which thread makes which bucket. Each has a part of the picture to itself, in scan order, which keeps the
// life of grids short: threads in neighbouring buckets would wait for one another, as each grid is shaded
// once. Who has finished takes over half of what the slowest has left.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace render {

class BucketShares {
public:
  /// Buckets in rows of so many columns, for so many threads.
  BucketShares(size_t columns, size_t rows, size_t threads);
  /// The thread's next bucket, by number; none: there are no more.
  std::optional<size_t> next(size_t thread);

private:
  struct Share {
    size_t next, end;
    size_t left() const { return end - next; }
  };
  std::mutex mutex_;
  std::vector<Share> shares_;
};

} // namespace render
