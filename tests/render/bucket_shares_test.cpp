// Every bucket goes to one thread, once.
#include "render/hider/bucket_shares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

namespace render {
namespace {

TEST(BucketShares, each_thread_begins_with_rows_of_its_own) {
  BucketShares shares(10, 5, 2);
  EXPECT_EQ(shares.next(0), 0u);
  EXPECT_EQ(shares.next(1), 20u); // two rows of five, and three
  EXPECT_EQ(shares.next(0), 1u);
  EXPECT_EQ(shares.next(1), 21u);
}

TEST(BucketShares, who_has_finished_takes_half_of_what_the_slowest_has_left) {
  BucketShares shares(4, 4, 2);
  for (size_t b = 0; b < 8; ++b)
    EXPECT_EQ(shares.next(0), b);
  EXPECT_EQ(shares.next(1), 8u);  // 7 are left
  EXPECT_EQ(shares.next(0), 12u); // the last four of them
  EXPECT_EQ(shares.next(1), 9u);
  EXPECT_EQ(shares.next(0), 13u);
}

TEST(BucketShares, alone_in_scan_order_and_more_threads_than_buckets) {
  BucketShares alone(3, 2, 1);
  for (size_t b = 0; b < 6; ++b)
    EXPECT_EQ(alone.next(0), b);
  EXPECT_FALSE(alone.next(0));
  EXPECT_FALSE(alone.next(0));
  BucketShares many(2, 1, 5);
  std::vector<size_t> given;
  for (size_t t = 0; t < 5; ++t)
    if (auto b = many.next(t)) given.push_back(*b);
  std::sort(given.begin(), given.end());
  EXPECT_EQ(given, (std::vector<size_t>{0, 1}));
  EXPECT_FALSE(BucketShares(0, 0, 3).next(2));
}

TEST(BucketShares, nothing_is_lost_and_nothing_twice_between_threads) {
  constexpr size_t kThreads = 4, kColumns = 31, kRows = 29;
  BucketShares shares(kColumns, kRows, kThreads);
  std::vector<std::vector<size_t>> taken(kThreads);
  std::vector<std::thread> threads;
  for (size_t t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      while (auto b = shares.next(t)) {
        taken[t].push_back(*b);
        // The first is slow.
        if (t == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
    });
  for (std::thread& t : threads)
    t.join();
  std::vector<int> times(kColumns * kRows);
  for (const auto& buckets : taken)
    for (size_t b : buckets)
      ++times[b];
  EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
}

} // namespace
} // namespace render
