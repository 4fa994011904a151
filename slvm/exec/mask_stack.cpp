// Masks of nested control flow.
#include "slvm/exec/mask_stack.h"

#include <cassert>

namespace slvm {

void MaskStack::update() {
  MaskWord some = 0, missing = 0;
  for (size_t i = 0; i < words_; ++i) {
    some |= current_[i];
    missing |= current_[i] ^ full_[i];
  }
  any_ = some != 0;
  all_ = missing == 0;
}

void MaskStack::reset_from(const MaskStack& grid, size_t first, size_t lanes, size_t active) {
  words_ = mask_words(lanes);
  full_.resize(words_);
  current_.resize(words_);
  entries_.clear();
  storage_.clear();
  size_t word = first / kMaskWordLanes, shift = first % kMaskWordLanes;
  for (size_t i = 0; i < words_; ++i) {
    MaskWord bits = word + i < grid.words_ ? grid.current_[word + i] >> shift : 0;
    if (shift && word + i + 1 < grid.words_) bits |= grid.current_[word + i + 1] << (kMaskWordLanes - shift);
    full_[i] = full_mask_word(i, active);
    current_[i] = bits & full_[i];
  }
  update();
}

const MaskWord* MaskStack::at_level(size_t level) const {
  if (level == 0) return full_.data();
  return level >= entries_.size() ? current_.data() : saved(level);
}

void MaskStack::push(bool loop) {
  entries_.push_back({loop});
  storage_.resize(2 * entries_.size() * words_);
  std::copy(current_.begin(), current_.end(), saved(entries_.size() - 1));
}

void MaskStack::push_if(const MaskWord* condition) {
  push(false);
  MaskWord* other = iter(entries_.size() - 1);
  for (size_t i = 0; i < words_; ++i) {
    other[i] = current_[i] & ~condition[i];
    current_[i] &= condition[i];
  }
  update();
}

void MaskStack::flip_else() {
  const MaskWord* other = iter(entries_.size() - 1);
  std::copy(other, other + words_, current_.begin());
  update();
}

void MaskStack::pop_if() {
  const MaskWord* restored = saved(entries_.size() - 1);
  std::copy(restored, restored + words_, current_.begin());
  entries_.pop_back();
  update();
}

void MaskStack::push_loop() {
  push(true);
  std::copy(current_.begin(), current_.end(), iter(entries_.size() - 1));
}

void MaskStack::lanes_where(const MaskWord* condition) {
  MaskWord* in_loop = iter(entries_.size() - 1);
  for (size_t i = 0; i < words_; ++i) {
    in_loop[i] &= ~(current_[i] & ~condition[i]);
    current_[i] &= condition[i];
  }
  update();
}

// The current lanes go: out of everything up to the target loop, and out of that loop's rounds unless they
// continue.
void MaskStack::leave(uint32_t loops, bool keep_in_target) {
  for (size_t e = entries_.size(); e-- > 0;) {
    bool target = entries_[e].loop && --loops == 0;
    MaskWord *before = saved(e), *rounds = iter(e);
    for (size_t i = 0; i < words_; ++i) {
      if (!target) before[i] &= ~current_[i];
      if (!target || !keep_in_target) rounds[i] &= ~current_[i];
    }
    if (target) break;
  }
  std::fill(current_.begin(), current_.end(), MaskWord{0});
  update();
}

void MaskStack::lanes_break(uint32_t loops) {
  leave(loops, false);
}
void MaskStack::lanes_continue(uint32_t loops) {
  leave(loops, true);
}

void MaskStack::enter_round(const MaskWord* lanes) {
  const MaskWord* in_loop = iter(entries_.size() - 1);
  for (size_t i = 0; i < words_; ++i)
    current_[i] = in_loop[i] & lanes[i];
  update();
}

bool MaskStack::next_round() {
  const MaskWord* in_loop = iter(entries_.size() - 1);
  std::copy(in_loop, in_loop + words_, current_.begin());
  update();
  if (any_) return true;
  pop_loop();
  return false;
}

void MaskStack::pop_loop() {
  pop_if();
}

} // namespace slvm
