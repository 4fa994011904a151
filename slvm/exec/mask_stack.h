// Which lanes run: the current mask, and a stack of what nested ifs and loops will restore.
//
//   if (a) {            push_if(a)     current = on & a          saved = on    other = on & !a
//     while (b) {       push_loop      iter = current                          (one entry a loop)
//       lanes_where(b)                 current, iter lose lanes where b fails
//       if (c) break;   push_if(c), lanes_break(1), pop_if
//                                      the broken lanes leave iter, and every saved mask above it
//       continue        lanes_continue(1): current = none, iter keeps them
//     }                 next_round     current = iter; when none: pop_loop, current = saved
//   } else {            flip_else      current = other
//   }                   pop_if         current = saved, less lanes that broke out of loops around
//
// A lane that leaves by break, continue or return is taken out of everything that would bring it back too
// early, at once; nothing has to be remembered about it. Strips and whole grids use the same class.
#pragma once

#include "slvm/wide/mask.h"

#include <algorithm>
#include <vector>

namespace slvm {

class MaskStack {
public:
  /// An empty stack for this many lanes. Lanes from `active` on (padding) are off for good.
  void reset(size_t lanes, size_t active) {
    words_ = mask_words(lanes);
    full_.resize(words_);
    current_.resize(words_);
    for (size_t i = 0; i < words_; ++i)
      full_[i] = full_mask_word(i, active);
    current_ = full_;
    entries_.clear();
    storage_.clear();
    update();
  }
  /// Starts from a part of another mask: lanes [first, first + lanes) of it.
  void reset_from(const MaskStack& grid, size_t first, size_t lanes, size_t active);

  const MaskWord* current() const { return current_.data(); }
  size_t words() const { return words_; }
  bool any() const { return any_; }
  /// All lanes but padding are on.
  bool all() const { return all_; }
  size_t depth() const { return entries_.size(); }
  /// A loop is open.
  bool within_loop() const {
    return std::any_of(entries_.begin(), entries_.end(), [](const Entry& e) { return e.loop; });
  }
  /// The mask of region `level`: 0 all lanes, depth() the current one, between them what will be restored.
  const MaskWord* at_level(size_t level) const;

  void push_if(const MaskWord* condition);
  void flip_else();
  void pop_if();
  void push_loop();
  /// Lanes where the condition fails leave the innermost loop.
  void lanes_where(const MaskWord* condition);
  void lanes_break(uint32_t loops);
  void lanes_continue(uint32_t loops);
  /// For light loops: the lanes of this round, out of those still in the loop.
  void enter_round(const MaskWord* lanes);
  /// True while lanes are left in the loop: they are current again. False: the loop is popped.
  bool next_round();
  void pop_loop();
  const MaskWord* in_loop() const { return iter(entries_.size() - 1); }

private:
  struct Entry {
    bool loop;
  };
  // Two masks an entry: `saved`, and `other` (ifs) or `iter` (loops).
  MaskWord* saved(size_t entry) { return storage_.data() + 2 * entry * words_; }
  const MaskWord* saved(size_t entry) const { return storage_.data() + 2 * entry * words_; }
  MaskWord* iter(size_t entry) { return storage_.data() + (2 * entry + 1) * words_; }
  const MaskWord* iter(size_t entry) const { return storage_.data() + (2 * entry + 1) * words_; }
  void push(bool loop);
  void leave(uint32_t loops, bool keep_in_target);
  void update();

  size_t words_ = 0;
  bool any_ = false, all_ = false;
  std::vector<MaskWord> full_, current_, storage_;
  std::vector<Entry> entries_;
};

} // namespace slvm
