// The loops over rays that are open in a run of a shader, one in the other. Read next: gather.h.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace slvm {

class GatherLoop;

/// The loops that are open in a run, one in the other.
class GatherStack {
public:
  GatherStack();
  ~GatherStack();
  void clear() { open_ = 0, announced_ = false; }
  /// The loop that a call announces; it begins with the next open().
  GatherLoop& announce();
  /// False: nothing was announced.
  bool open(bool lanes_leave);
  void close() { --open_; }
  /// The innermost open one; null: none.
  GatherLoop* current() { return open_ ? loops_[open_ - 1].get() : nullptr; }
  bool any_scattered() const;

private:
  std::vector<std::unique_ptr<GatherLoop>> loops_; ///< kept with their memory
  size_t open_ = 0;
  bool announced_ = false;
};

} // namespace slvm
