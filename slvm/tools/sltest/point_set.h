// Points of a grid at which something was found, each counted once.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace slvm::sltest {

class PointSet {
public:
  void add(size_t point, size_t points) {
    if (marked_.size() < points) marked_.resize(points);
    if (marked_[point]) return;
    marked_[point] = true;
    ++count_;
  }
  bool empty() const { return count_ == 0; }
  /// "3 of 64 points: (1, 0), (2, 0), (5, 1)"; the first few.
  std::string text(size_t nu) const {
    constexpr size_t kShown = 4;
    std::string out =
        fmt::format("{} of {} point{}: ", count_, marked_.size(), marked_.size() == 1 ? "" : "s");
    size_t shown = 0;
    for (size_t i = 0; i < marked_.size() && shown < kShown; ++i)
      if (marked_[i]) out += fmt::format("{}({}, {})", shown++ ? ", " : "", i % nu, i / nu);
    return count_ > kShown ? out + "..." : out;
  }

private:
  std::vector<bool> marked_;
  size_t count_ = 0;
};

} // namespace slvm::sltest
