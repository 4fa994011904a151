// The string table of running shaders.
#include "slvm/support/string_pool.h"

#include <mutex>

namespace slvm {

StringPool::StringPool() {
  intern("");
}

uint32_t StringPool::intern(std::string_view text) {
  {
    std::shared_lock lock(mutex_);
    if (auto it = ids_.find(text); it != ids_.end()) return it->second;
  }
  std::unique_lock lock(mutex_);
  if (auto it = ids_.find(text); it != ids_.end()) return it->second;
  auto id = static_cast<uint32_t>(texts_.size());
  texts_.emplace_back(text);
  ids_.emplace(texts_.back(), id);
  return id;
}

std::string_view StringPool::text(uint32_t id) const {
  std::shared_lock lock(mutex_);
  return id < texts_.size() ? std::string_view(texts_[id]) : std::string_view();
}

} // namespace slvm
