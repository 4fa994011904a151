#include "stdlib/subsurface/block_pool.h"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <system_error>

namespace subsurface {

void BlockPool::set_limit(size_t most_bytes) {
  std::lock_guard lock(mutex_);
  most_bytes_ = most_bytes;
  make_room(~0u);
}

uint32_t BlockPool::add(std::vector<Block> blocks) {
  std::lock_guard lock(mutex_);
  const auto first = static_cast<uint32_t>(slots_.size());
  for (Block& block : blocks) {
    const auto number = static_cast<uint32_t>(slots_.size());
    Slot& slot = slots_.emplace_back();
    slot.size = block.size();
    keep(slot, number, std::make_shared<const Block>(std::move(block)));
  }
  return first;
}

void BlockPool::keep(Slot& slot, uint32_t number, Handle block) {
  slot.block = std::move(block);
  slot.used = in_memory_.insert(in_memory_.end(), number);
  bytes_ += slot.size * sizeof(float);
  make_room(number);
  most_held_ = std::max(most_held_, bytes_);
}

BlockPool::Handle BlockPool::get(uint32_t number) {
  std::lock_guard lock(mutex_);
  Slot& slot = slots_[number];
  if (slot.block) {
    in_memory_.splice(in_memory_.end(), in_memory_, slot.used);
    return slot.block;
  }
  Block block(slot.size);
  if (std::fseek(file_.get(), slot.place, SEEK_SET) != 0 ||
      std::fread(block.data(), sizeof(float), block.size(), file_.get()) != block.size()) {
    problem_ = "samples of a scatter map cannot be read back from a temporary file";
    return nullptr;
  }
  ++read_back_;
  auto handle = std::make_shared<const Block>(std::move(block));
  keep(slot, number, handle);
  return handle;
}

void BlockPool::remove(uint32_t first, uint32_t count) {
  std::lock_guard lock(mutex_);
  for (uint32_t i = first; i < first + count; ++i) {
    Slot& slot = slots_[i];
    if (!slot.block) continue;
    bytes_ -= slot.size * sizeof(float);
    in_memory_.erase(slot.used);
    slot.block.reset();
  }
}

void BlockPool::make_room(uint32_t except) {
  auto next = in_memory_.begin();
  while (bytes_ > most_bytes_ && next != in_memory_.end()) {
    const uint32_t number = *next;
    Slot& slot = slots_[number];
    if (number == except || (slot.place < 0 && !write(slot))) {
      ++next;
      continue;
    }
    bytes_ -= slot.size * sizeof(float);
    slot.block.reset();
    next = in_memory_.erase(next);
  }
}

/// False: it cannot be, and stays in memory.
bool BlockPool::write(Slot& slot) {
  if (!problem_.empty()) return false; // one failure is enough
  if (!file_) file_.reset(std::tmpfile());
  if (file_ && std::fseek(file_.get(), 0, SEEK_END) == 0) {
    const long place = std::ftell(file_.get());
    if (place >= 0 && std::fwrite(slot.block->data(), sizeof(float), slot.size, file_.get()) == slot.size &&
        std::fflush(file_.get()) == 0) {
      slot.place = place;
      ++written_;
      return true;
    }
  }
  problem_ = fmt::format("samples of a scatter map that are not in use stay in memory: no temporary file can "
                         "be written: {}",
                         std::generic_category().message(errno));
  return false;
}

size_t BlockPool::bytes() const {
  std::lock_guard lock(mutex_);
  return bytes_;
}
size_t BlockPool::most_bytes_held() const {
  std::lock_guard lock(mutex_);
  return most_held_;
}
uint64_t BlockPool::written() const {
  std::lock_guard lock(mutex_);
  return written_;
}
uint64_t BlockPool::read_back() const {
  std::lock_guard lock(mutex_);
  return read_back_;
}
std::string BlockPool::problem() const {
  std::lock_guard lock(mutex_);
  return problem_;
}

} // namespace subsurface
