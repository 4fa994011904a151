// The strings of running shaders, interned: equal texts have equal ids, so that a string fits into a register
// plane and comparison is comparison of bits. PUBLIC. Thread-safe; ids and texts live as long as the pool.
#pragma once

#include <cstdint>
#include <deque>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <unordered_map>

namespace slvm {

class StringPool {
public:
  /// Id 0 is the empty string.
  StringPool();
  uint32_t intern(std::string_view text);
  std::string_view text(uint32_t id) const;

private:
  mutable std::shared_mutex mutex_;
  std::deque<std::string> texts_; // a deque: views of its elements stay valid as it grows
  std::unordered_map<std::string_view, uint32_t> ids_;
};

} // namespace slvm
