// A stream of decisions read from bytes: whoever makes something at random asks it, so that the bytes stand
// for what was made. A fuzzer can mutate them, and less of them makes less: 0, and whatever follows the end,
// is always the simplest choice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace slvm::test {

class Choices {
public:
  explicit Choices(std::vector<uint8_t> bytes) : bytes_(std::move(bytes)) {}

  /// 0 to n - 1, n up to 65536.
  size_t below(size_t n) {
    if (n <= 1) return 0;
    size_t value = next();
    if (n > 256) value = value * 256 + next();
    return value % n;
  }
  /// True in `percent` cases of 100; false at the end.
  bool chance(size_t percent) { return below(100) >= 100 - percent; }
  bool at_end() const { return at_ >= bytes_.size(); }

private:
  uint8_t next() { return at_ < bytes_.size() ? bytes_[at_++] : 0; }

  std::vector<uint8_t> bytes_;
  size_t at_ = 0;
};

} // namespace slvm::test
