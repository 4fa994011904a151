// The mask stack on its own: the drawn example of its header, and lanes that leave several loops at once.
#include "slvm/exec/mask_stack.h"

#include <gtest/gtest.h>

namespace slvm {
namespace {

MaskStack lanes8() {
  MaskStack m;
  m.reset(16, 8);
  return m;
}
uint64_t on(const MaskStack& m) {
  return m.current()[0];
}

TEST(MaskStack, PaddingIsOff) {
  MaskStack m = lanes8();
  EXPECT_EQ(on(m), 0xffu);
  EXPECT_TRUE(m.all());
}

TEST(MaskStack, IfElse) {
  MaskStack m = lanes8();
  MaskWord c = 0x0f;
  m.push_if(&c);
  EXPECT_EQ(on(m), 0x0fu);
  EXPECT_FALSE(m.all());
  m.flip_else();
  EXPECT_EQ(on(m), 0xf0u);
  m.pop_if();
  EXPECT_TRUE(m.all());
}

TEST(MaskStack, BreakInsideIfLeavesLoopButNotWhatFollowsIt) {
  MaskStack m = lanes8();
  m.push_loop();
  MaskWord c = 0x03;
  m.push_if(&c);
  m.lanes_break(1);
  EXPECT_FALSE(m.any());
  m.pop_if();
  EXPECT_EQ(on(m), 0xfcu); // the rest of this round
  ASSERT_TRUE(m.next_round());
  EXPECT_EQ(on(m), 0xfcu);
  m.lanes_break(1);
  EXPECT_FALSE(m.next_round());
  EXPECT_EQ(on(m), 0xffu); // all lanes go on after the loop
}

TEST(MaskStack, ContinueComesBackNextRound) {
  MaskStack m = lanes8();
  m.push_loop();
  MaskWord c = 0x81;
  m.push_if(&c);
  m.lanes_continue(1);
  m.pop_if();
  EXPECT_EQ(on(m), 0x7eu);
  ASSERT_TRUE(m.next_round());
  EXPECT_EQ(on(m), 0xffu);
}

TEST(MaskStack, BreakTwoLoops) {
  MaskStack m = lanes8();
  m.push_loop();
  m.push_loop();
  MaskWord c = 0x0f;
  m.push_if(&c);
  m.lanes_break(2);
  m.pop_if();
  EXPECT_EQ(on(m), 0xf0u);
  m.lanes_break(1);
  EXPECT_FALSE(m.next_round());
  EXPECT_EQ(on(m), 0xf0u); // only these are still in the outer loop
  ASSERT_TRUE(m.next_round());
  EXPECT_EQ(on(m), 0xf0u);
  m.lanes_break(1);
  EXPECT_FALSE(m.next_round());
  EXPECT_EQ(on(m), 0xffu);
}

TEST(MaskStack, ContinueOuterLoopSkipsTheRestOfTheInner) {
  MaskStack m = lanes8();
  m.push_loop();
  m.push_loop();
  MaskWord c = 0x0f;
  m.push_if(&c);
  m.lanes_continue(2);
  m.pop_if();
  ASSERT_TRUE(m.next_round()); // inner
  EXPECT_EQ(on(m), 0xf0u);
  m.lanes_break(1);
  EXPECT_FALSE(m.next_round());
  EXPECT_EQ(on(m), 0xf0u);     // after the inner loop, this round
  ASSERT_TRUE(m.next_round()); // outer: they are back
  EXPECT_EQ(on(m), 0xffu);
}

TEST(MaskStack, WhileDropsLanesFromTheLoopOnly) {
  MaskStack m = lanes8();
  m.push_loop();
  MaskWord c = 0x3c;
  m.lanes_where(&c);
  EXPECT_EQ(on(m), 0x3cu);
  ASSERT_TRUE(m.next_round());
  EXPECT_EQ(on(m), 0x3cu);
  c = 0;
  m.lanes_where(&c);
  EXPECT_FALSE(m.next_round());
  EXPECT_EQ(on(m), 0xffu);
}

TEST(MaskStack, LevelsTellWhoHoldsAValue) {
  MaskStack m = lanes8();
  MaskWord a = 0x3f, b = 0x0f;
  m.push_if(&a);
  m.push_if(&b);
  EXPECT_EQ(m.at_level(0)[0], 0xffu);
  EXPECT_EQ(m.at_level(1)[0], 0x3fu);
  EXPECT_EQ(m.at_level(2)[0], 0x0fu);
}

TEST(MaskStack, StripsTakeTheirPartOfAGridAtAnyOffset) {
  MaskStack grid;
  grid.reset(208, 200);
  std::vector<MaskWord> c(mask_words(208));
  for (size_t i = 0; i < 200; i += 3)
    c[i / 64] |= MaskWord{1} << (i % 64);
  grid.push_if(c.data());
  for (size_t strip : {16u, 48u, 64u, 128u})
    for (size_t first = 0; first < 200; first += strip) {
      MaskStack part;
      size_t lanes = std::min<size_t>(strip, 208 - first), active = std::min<size_t>(lanes, 200 - first);
      part.reset_from(grid, first, lanes, active);
      for (size_t i = 0; i < active; ++i)
        EXPECT_EQ(mask_test(part.current(), i), (first + i) % 3 == 0) << strip << " " << first << " " << i;
    }
}

} // namespace
} // namespace slvm
