// A loop in several threads, for work whose parts do not depend on each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace subsurface {

/// Calls f(begin, end) for pieces that together are [0, count), in `threads` threads at once (0: as many as
/// the machine has). f must not throw.
template <class F> void parallel_ranges(size_t count, unsigned threads, F&& f) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  const size_t pieces = std::clamp<size_t>(threads, 1, std::max<size_t>(count, 1));
  std::vector<std::thread> others;
  for (size_t i = 1; i < pieces; ++i)
    others.emplace_back([&f, i, count, pieces] { f(i * count / pieces, (i + 1) * count / pieces); });
  f(size_t{0}, count / pieces);
  for (std::thread& t : others)
    t.join();
}

} // namespace subsurface
