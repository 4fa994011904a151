// spline(): every basis against closed forms, knots as arguments and as arrays, the inverse.
#include "tests/unit/kernels/harness.h"

#include <cmath>

#include <gtest/gtest.h>

namespace slvm::test {
namespace {

/// spline(basis, x, knots) for kMaxLanes values of x. Knots are in the array form or are arguments.
std::vector<float> spline(std::string_view basis, const std::vector<float>& x,
                          const std::vector<float>& knots, bool as_array) {
  StringPool strings;
  std::mt19937 random(1);
  ShadeopId row = row_of("spline", as_array ? "float(uniform string basis, float x, float[] knots)"
                                            : "float(uniform string basis, float x, float knots...)");
  Arguments arguments = make_arguments(row, kMaxLanes, Values::kModerate, random, strings);
  size_t first = 2;
  arguments.values.resize(first + (as_array ? 1 : knots.size()), arguments.values[first]);
  arguments.must_be_uniform.resize(arguments.values.size(), false);
  for (size_t lane = 0; lane < kMaxLanes; ++lane) {
    arguments.values[0].bits[lane][0] = strings.intern(basis);
    arguments.values[1].set(lane, 0, x[lane % x.size()]);
    for (size_t k = 0; k < knots.size(); ++k) {
      Value& v = arguments.values[as_array ? first : first + k];
      if (as_array) {
        v.elements = static_cast<uint32_t>(knots.size());
        v.bits[lane].resize(knots.size());
      }
      v.set(lane, as_array ? k : 0, knots[k]);
    }
  }
  Value v = call(kernel_table(), row, arguments, strings)[0];
  std::vector<float> results;
  for (size_t i = 0; i < x.size(); ++i)
    results.push_back(v.at(i));
  return results;
}

/// Both forms, which must agree.
std::vector<float> both(std::string_view basis, const std::vector<float>& x,
                        const std::vector<float>& knots) {
  std::vector<float> result = spline(basis, x, knots, false);
  EXPECT_EQ(result, spline(basis, x, knots, true));
  return result;
}
void expect_near(const std::vector<float>& got, const std::vector<float>& expected, float tolerance = 1e-5f) {
  ASSERT_EQ(got.size(), expected.size());
  for (size_t i = 0; i < got.size(); ++i)
    EXPECT_NEAR(got[i], expected[i], tolerance) << i;
}

const std::vector<float> kKnots{5, 1, 2, 4, 3, 7, 9};

TEST(Spline, CatmullRomPassesThroughAllButTheEndKnots) {
  expect_near(both("catmull-rom", {0, 0.25f, 0.5f, 0.75f, 1}, kKnots), {1, 2, 4, 3, 7});
  // Middle of a segment: (-p0 + 9 p1 + 9 p2 - p3)/16.
  expect_near(both("catmull-rom", {0.125f}, kKnots), {(-5 + 9 * 1 + 9 * 2 - 4) / 16.0f});
  expect_near(both("", {0.125f}, kKnots), {(-5 + 9 * 1 + 9 * 2 - 4) / 16.0f});
}
TEST(Spline, LinearIgnoresTheEndKnots) {
  expect_near(both("linear", {0, 0.125f, 0.25f, 1}, kKnots), {1, 1.5f, 2, 7});
}
TEST(Spline, BezierSegmentsShareTheirEnds) {
  expect_near(both("bezier", {0, 0.5f, 1}, kKnots), {5, 4, 9});
  expect_near(both("bezier", {0.25f}, kKnots), {(5 + 3 * 1 + 3 * 2 + 4) / 8.0f});
}
TEST(Spline, BsplineAveragesItsKnots) {
  expect_near(both("bspline", {0, 1}, kKnots), {(5 + 4 * 1 + 2) / 6.0f, (3 + 4 * 7 + 9) / 6.0f});
  EXPECT_EQ(both("b-spline", {0.3f}, kKnots), both("bspline", {0.3f}, kKnots));
}
TEST(Spline, HermiteTakesPointsAndTangents) {
  std::vector<float> knots{1, 2, 3, -1, 0, 4}; // points 1, 3, 0 with tangents 2, -1, 4
  expect_near(both("hermite", {0, 0.5f, 1}, knots), {1, 3, 0});
  expect_near(both("hermite", {0.25f}, knots), {0.5f * (1 + 3) + 0.125f * (2 - -1)});
}
TEST(Spline, SurplusKnotsAreIgnored) {
  std::vector<float> more = kKnots;
  more.push_back(100);
  EXPECT_EQ(both("bezier", {0.8f, 1}, more), both("bezier", {0.8f, 1}, kKnots));
}
TEST(Spline, TheParameterIsClampedAndNaNCountsAsZero) {
  expect_near(both("catmull-rom", {-3, 2, NAN, INFINITY}, kKnots), {1, 7, 1, 7});
}
TEST(Spline, FewerThanFourKnotsGiveZero) {
  expect_near(both("catmull-rom", {0.5f}, {1, 2, 3}), {0});
}

TEST(Spline, SolveInvertsMonotonicSplines) {
  std::vector<float> rising{-0.4f, 0, 0.1f, 0.5f, 0.9f, 1.2f, 1.5f};
  std::vector<float> falling(rising.rbegin(), rising.rend());
  for (std::string_view basis : {"catmull-rom", "linear", "bezier", "bspline"})
    for (const auto& knots : {rising, falling}) {
      std::vector<float> x{0.01f, 0.2f, 0.5f, 0.77f, 0.99f};
      expect_near(spline("solve" + std::string(basis), spline(basis, x, knots, false), knots, false), x,
                  1e-5f);
    }
  expect_near(both("solvelinear", {-100, 100}, rising), {0, 1}, 1e-6f);
}

TEST(Spline, ColorsAreThreeSplines) {
  StringPool strings;
  std::mt19937 random(1);
  ShadeopId row = row_of("spline", "color(float x, color knots...)");
  Arguments arguments = make_arguments(row, kMaxLanes, Values::kModerate, random, strings);
  Value color = call(kernel_table(), row, arguments, strings)[0];
  for (size_t lane = 0; lane < kMaxLanes; ++lane)
    for (size_t component = 0; component < 3; ++component) {
      std::vector<float> knots;
      for (uint32_t k = 0; k < kManyKnots; ++k)
        knots.push_back(arguments.values[1 + k].at(lane, component));
      EXPECT_EQ(color.at(lane, component),
                spline("catmull-rom", {arguments.values[0].at(lane)}, knots, false)[0]);
    }
}

} // namespace
} // namespace slvm::test
