// The heap of slrender: what it has made room for it keeps.
#include "render/tools/heap.h"

#include <gtest/gtest.h>

#ifdef __GLIBC__
#include <cstdlib>
#include <malloc.h>

namespace {

TEST(Heap, has_room_for_small_pictures_and_keeps_what_is_free) {
  render::tools::make_roomy_heap();
  const size_t room = mallinfo2().arena, mapped = mallinfo2().hblks;
  if (room == 0) GTEST_SKIP() << "this heap is not glibc's";
  EXPECT_GE(room, size_t{6} << 20);
  for (int round = 0; round < 3; ++round) {
    void* block = std::malloc(size_t{3} << 20);
    ASSERT_TRUE(block);
    EXPECT_EQ(mallinfo2().hblks, mapped); // of the heap, not a mapping of its own
    std::free(block);
    EXPECT_EQ(mallinfo2().arena, room);
  }
}

} // namespace
#endif
