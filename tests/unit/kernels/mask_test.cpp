// Lane masks: word operations, and the operations on planes of every target against plain loops.
#include "slvm/kernels/table.h"
#include "slvm/wide/mask.h"

#include <bit>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace slvm {
namespace {

constexpr size_t kMost = 320;
struct alignas(kPlaneAlign) Plane {
  float lane[kMost];
};

std::vector<MaskWord> random_mask(size_t lanes, std::mt19937_64& random) {
  std::vector<MaskWord> mask(mask_words(lanes));
  for (size_t i = 0; i < mask.size(); ++i)
    mask[i] = random() & full_mask_word(i, lanes);
  return mask;
}

TEST(Mask, FullWordsStopAtTheLastLane) {
  EXPECT_EQ(mask_words(64), 1u);
  EXPECT_EQ(mask_words(65), 2u);
  EXPECT_EQ(full_mask_word(0, 16), 0xffffu);
  EXPECT_EQ(full_mask_word(0, 64), ~MaskWord{0});
  EXPECT_EQ(full_mask_word(1, 80), 0xffffu);
  EXPECT_EQ(full_mask_word(2, 80), 0u);
}

TEST(Mask, AllAnyNoneAndCountAgree) {
  for (size_t lanes : {16, 48, 64, 80, 128, 304}) {
    std::vector<MaskWord> mask(mask_words(lanes));
    mask_set_all(mask.data(), lanes);
    EXPECT_TRUE(mask_all(mask.data(), lanes));
    EXPECT_EQ(mask_count(mask.data(), lanes), lanes);
    mask.back() ^= MaskWord{1} << ((lanes - 1) % kMaskWordLanes);
    EXPECT_FALSE(mask_all(mask.data(), lanes));
    EXPECT_TRUE(mask_any(mask.data(), lanes));
    EXPECT_FALSE(mask_test(mask.data(), lanes - 1));
    EXPECT_TRUE(mask_test(mask.data(), lanes - 2));
    mask_clear(mask.data(), lanes);
    EXPECT_TRUE(mask_none(mask.data(), lanes));
    EXPECT_EQ(mask_count(mask.data(), lanes), 0u);
  }
}

TEST(Mask, WordOperationsActLaneByLane) {
  std::mt19937_64 random(3);
  constexpr size_t kLanes = 208;
  auto a = random_mask(kLanes, random), b = random_mask(kLanes, random);
  std::vector<MaskWord> both(a.size()), only_a(a.size()), either(a.size());
  mask_and(both.data(), a.data(), b.data(), kLanes);
  mask_andnot(only_a.data(), a.data(), b.data(), kLanes);
  mask_or(either.data(), a.data(), b.data(), kLanes);
  std::vector<size_t> visited, expected;
  mask_for_each(both.data(), kLanes, [&](size_t lane) { visited.push_back(lane); });
  for (size_t lane = 0; lane < kLanes; ++lane) {
    bool in_a = mask_test(a.data(), lane), in_b = mask_test(b.data(), lane);
    EXPECT_EQ(mask_test(both.data(), lane), in_a && in_b);
    EXPECT_EQ(mask_test(only_a.data(), lane), in_a && !in_b);
    EXPECT_EQ(mask_test(either.data(), lane), in_a || in_b);
    if (in_a && in_b) expected.push_back(lane);
  }
  EXPECT_EQ(visited, expected);
}

class PlanesOn : public testing::TestWithParam<const char*> {
protected:
  const KernelTable& table = *find_kernel_table(GetParam());
  std::mt19937_64 random{5};
};

TEST_P(PlanesOn, BoolsAndMasksConvertBothWays) {
  for (size_t lanes : {16, 48, 64, 128, 304}) {
    auto mask = random_mask(lanes, random);
    Plane bools;
    table.bools_of_mask(bools.lane, mask.data(), lanes);
    for (size_t lane = 0; lane < lanes; ++lane)
      EXPECT_EQ(std::bit_cast<uint32_t>(bools.lane[lane]), mask_test(mask.data(), lane) ? ~0u : 0u);
    std::vector<MaskWord> back(mask.size(), ~MaskWord{0});
    table.mask_of_bools(back.data(), bools.lane, lanes);
    EXPECT_EQ(back, mask);
  }
}

TEST_P(PlanesOn, BlendStoresWhereTheMaskIsOn) {
  for (uint32_t step : {0u, 1u})
    for (size_t lanes : {16, 48, 128, 304}) {
      auto mask = random_mask(lanes, random);
      Plane target, source;
      for (size_t lane = 0; lane < kMost; ++lane) {
        target.lane[lane] = -static_cast<float>(lane);
        source.lane[lane] = step ? static_cast<float>(1000 + lane) : 7.0f;
      }
      table.blend(target.lane, source.lane, step, mask.data(), lanes);
      for (size_t lane = 0; lane < kMost; ++lane) {
        bool on = lane < lanes && mask_test(mask.data(), lane);
        EXPECT_EQ(target.lane[lane], on ? source.lane[lane] : -static_cast<float>(lane));
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Mask, PlanesOn, testing::ValuesIn(kernel_targets().begin(), kernel_targets().end()),
                         [](const auto& target) { return std::string(target.param); });

} // namespace
} // namespace slvm
