// random(): uniform in [0, 1), a function of seed, grid point and counter alone.
#include "tests/unit/kernels/harness.h"

#include <cmath>

#include <gtest/gtest.h>

namespace slvm::test {
namespace {

/// Draws for `lanes` points with counters 0, 1, ...: component `plane`.
std::vector<double> draws(std::string_view name, std::string_view signature, size_t lanes, int counters,
                          size_t plane, uint64_t seed = 1, uint32_t first_point = 0) {
  StringPool strings;
  std::mt19937 random(1);
  std::vector<double> results;
  ShadeopId row = row_of(name, signature);
  for (int counter = 0; counter < counters; ++counter) {
    Arguments arguments = make_arguments(row, lanes, Values::kModerate, random, strings);
    for (Value& v : arguments.values)
      for (size_t lane = 0; lane < lanes; ++lane)
        v.set(lane, 0, static_cast<float>(counter));
    Value v = call(kernel_table(), row, arguments, strings, {.seed = seed, .first_point = first_point})[0];
    for (size_t lane = 0; lane < lanes; ++lane)
      results.push_back(v.at(lane, plane));
  }
  return results;
}

/// Pearson's coefficient of two samples.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  auto n = static_cast<double>(a.size());
  for (size_t i = 0; i < a.size(); ++i)
    ma += a[i] / n, mb += b[i] / n;
  for (size_t i = 0; i < a.size(); ++i)
    aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb), ab += (a[i] - ma) * (b[i] - mb);
  return ab / std::sqrt(aa * bb);
}

TEST(Random, IsUniformOverPointsAndCounters) {
  std::vector<double> all = draws("randomvarying", "float(float counter)", 4096, 64, 0);
  std::vector<int> count(64);
  for (double x : all) {
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    ++count[static_cast<size_t>(x * 64)];
  }
  double expected = double(all.size()) / 64, chi_square = 0;
  for (int n : count)
    chi_square += (n - expected) * (n - expected) / expected;
  EXPECT_LT(chi_square, 63 + 5 * std::sqrt(2.0 * 63));
}

TEST(Random, ComponentsPointsCountersAndSeedsAreUncorrelated) {
  auto triple = [](size_t plane, uint64_t seed = 1, uint32_t first = 0) {
    return draws("randomvarying", "color(float counter)", 4096, 16, plane, seed, first);
  };
  std::vector<double> base = triple(0);
  double bound = 5 / std::sqrt(double(base.size()));
  EXPECT_LT(std::abs(correlation(base, triple(1))), bound);
  EXPECT_LT(std::abs(correlation(base, triple(2))), bound);
  EXPECT_LT(std::abs(correlation(triple(1), triple(2))), bound);
  EXPECT_LT(std::abs(correlation(base, triple(0, 2))), bound) << "next seed";
  EXPECT_LT(std::abs(correlation(base, triple(0, uint64_t{1} << 32 | 1))), bound) << "upper half of the seed";
  EXPECT_LT(std::abs(correlation(base, triple(0, 1, 1))), bound) << "next point";
  std::vector<double> later(base.begin() + 4096, base.end()), earlier(base.begin(), base.end() - 4096);
  EXPECT_LT(std::abs(correlation(earlier, later)), bound) << "next counter";
}

TEST(Random, DependsOnTheGridPointNotOnTheStrip) {
  std::vector<double> whole = draws("randomvarying", "float(float counter)", 304, 1, 0);
  std::vector<double> part = draws("randomvarying", "float(float counter)", 64, 1, 0, 1, 240);
  EXPECT_EQ(std::vector<double>(whole.begin() + 240, whole.end()), part);
  EXPECT_EQ(draws("random", "float()", 304, 1, 0).size(), 304u);
}

TEST(Random, UniformDrawsAreOneValuePerCall) {
  std::vector<double> values = draws("randomuniform", "float(float counter)", kMaxLanes, 2, 0);
  for (size_t lane = 0; lane < kMaxLanes; ++lane)
    EXPECT_EQ(values[lane], values[0]);
  EXPECT_NE(values[0], values[kMaxLanes]);
}

} // namespace
} // namespace slvm::test
