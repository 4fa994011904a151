// Blocks of numbers of which not all stay in memory: the least recently used go to a temporary file and are
// read back when they are needed again (Tomson, 5.5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace subsurface {

/// Thread-safe.
class BlockPool {
public:
  using Block = std::vector<float>;
  using Handle = std::shared_ptr<const Block>;

  /// `most_bytes`: of blocks in memory, without those that somebody holds beyond their time.
  explicit BlockPool(size_t most_bytes) : most_bytes_(most_bytes) {}

  void set_limit(size_t most_bytes);
  /// Returns the number of the first; the others follow.
  uint32_t add(std::vector<Block> blocks);
  /// Null: the temporary file fails, problem() says how.
  Handle get(uint32_t number);
  /// Forgets blocks, whose numbers are not used again.
  void remove(uint32_t first, uint32_t count);

  size_t bytes() const;
  size_t most_bytes_held() const; ///< at any time so far
  uint64_t written() const;       ///< blocks that went to the file
  uint64_t read_back() const;
  /// What went wrong with the file, "" if nothing. Blocks that cannot be written stay in memory.
  std::string problem() const;

private:
  struct Slot {
    Handle block;
    size_t size = 0; ///< numbers
    long place = -1; ///< in the file; -1: not written
    std::list<uint32_t>::iterator used;
  };
  void keep(Slot& slot, uint32_t number, Handle block);
  void make_room(uint32_t except);
  bool write(Slot& slot);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  mutable std::mutex mutex_;
  size_t most_bytes_, bytes_ = 0, most_held_ = 0;
  uint64_t written_ = 0, read_back_ = 0;
  std::vector<Slot> slots_;
  std::list<uint32_t> in_memory_; // the least recently used first
  std::unique_ptr<std::FILE, Close> file_;
  std::string problem_;
};

} // namespace subsurface
