// What noise promises: range, mean, value at lattice points, smoothness, no preferred direction, independent
// components and dimensions, no hidden period; pnoise its period; cellnoise its cells.
#include "tests/unit/kernels/harness.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace slvm::test {
namespace {

using Point = std::array<float, 8>; // coordinates, then periods: as many as the dimension has

constexpr std::string_view kDomain[] = {"float x", "float x, float y", "point p", "point p, float t"};
constexpr std::string_view kPeriodicDomain[] = {
    "float x, uniform float period", "float x, float y, uniform float xperiod, uniform float yperiod",
    "point p, uniform point period", "point p, float t, uniform point pperiod, uniform float tperiod"};

/// noise, cellnoise or pnoise of some dimension and result type, at any number of points. Periods are those
/// of the first point.
std::vector<float> evaluate(std::string_view name, std::string_view type, int dimension,
                            const std::vector<Point>& points, size_t component = 0) {
  bool periodic = name == "pnoise";
  std::string_view domain = (periodic ? kPeriodicDomain : kDomain)[dimension - 1];
  ShadeopId row = row_of(name, std::string(type) + "(" + std::string(domain) + ")");
  StringPool strings;
  std::mt19937 random(1);
  size_t lanes = (points.size() + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  Arguments arguments = make_arguments(row, lanes, Values::kModerate, random, strings);
  size_t coordinate = 0;
  for (Value& v : arguments.values) {
    for (size_t p = 0; p < v.planes(); ++p, ++coordinate) {
      bool is_period = coordinate >= size_t(dimension);
      for (size_t lane = 0; lane < lanes; ++lane)
        v.set(lane, p, points[is_period ? 0 : std::min(lane, points.size() - 1)][coordinate]);
    }
  }
  Value v = call(kernel_table(), row, arguments, strings)[0];
  std::vector<float> results;
  for (size_t lane = 0; lane < points.size(); ++lane)
    results.push_back(v.at(lane, component));
  return results;
}
std::vector<float> noise(int dimension, const std::vector<Point>& points) {
  return evaluate("noise", "float", dimension, points);
}

std::vector<Point> random_points(size_t count, float low, float high, uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> draw(low, high);
  std::vector<Point> points(count);
  for (Point& p : points)
    for (float& x : p)
      x = draw(random);
  return points;
}
std::vector<Point> mapped(std::vector<Point> points, const std::function<void(Point&)>& change) {
  for (Point& p : points)
    change(p);
  return points;
}

double mean(const std::vector<float>& v) {
  double sum = 0;
  for (float x : v)
    sum += x;
  return sum / double(v.size());
}
double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double ma = mean(a), mb = mean(b), aa = 0, bb = 0, ab = 0;
  for (size_t i = 0; i < a.size(); ++i)
    aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb), ab += (a[i] - ma) * (b[i] - mb);
  return ab / std::sqrt(aa * bb);
}
double deviation(const std::vector<float>& v) {
  double m = mean(v), sum = 0;
  for (float x : v)
    sum += (x - m) * (x - m);
  return std::sqrt(sum / double(v.size()));
}

constexpr size_t kMany = 1 << 16;

class Noise : public testing::TestWithParam<int> {
protected:
  const int dimension = GetParam();
};
INSTANTIATE_TEST_SUITE_P(Dimension, Noise, testing::Values(1, 2, 3, 4));

TEST_P(Noise, HasRangeZeroToOneAndMeanOneHalf) {
  std::vector<float> v = noise(dimension, random_points(8 * kMany, -1000, 1000));
  auto [least, most] = std::minmax_element(v.begin(), v.end());
  EXPECT_GE(*least, 0);
  EXPECT_LE(*most, 1);
  EXPECT_LT(*least, 0.2f) << "the range is used";
  EXPECT_GT(*most, 0.8f) << "the range is used";
  EXPECT_NEAR(mean(v), 0.5, 0.003);
  RecordProperty("deviation", std::to_string(deviation(v)));
  EXPECT_GT(deviation(v), 0.10);
  EXPECT_LT(deviation(v), 0.18);
}

TEST_P(Noise, IsOneHalfAtLatticePoints) {
  auto at_integers = mapped(random_points(4096, -100, 100), [](Point& p) {
    for (float& x : p)
      x = std::round(x);
  });
  for (std::string_view type : {"float", "color", "point", "vector", "normal"})
    for (float x : evaluate("noise", type, dimension, at_integers))
      ASSERT_EQ(x, 0.5f);
}

TEST_P(Noise, IsSmoothAcrossCellBorders) {
  constexpr float kStep = 1.0f / 256; // exact in the coordinates used
  for (int axis = 0; axis < dimension; ++axis) {
    auto on_border = mapped(random_points(4096, -20, 20), [&](Point& p) { p[axis] = std::round(p[axis]); });
    auto moved = [&](float by) {
      return noise(dimension, mapped(on_border, [&](Point& p) { p[axis] += by; }));
    };
    std::vector<float> a = moved(-2 * kStep), b = moved(-kStep), c = moved(0), d = moved(kStep),
                       e = moved(2 * kStep);
    for (size_t i = 0; i < c.size(); ++i) {
      ASSERT_NEAR(b[i], c[i], 4 * kStep) << "value";
      ASSERT_NEAR(d[i], c[i], 4 * kStep) << "value";
      // Second-order one-sided differences from both sides agree where the first derivative is continuous.
      double left = (3 * c[i] - 4 * b[i] + a[i]) / (2 * kStep),
             right = (-3 * c[i] + 4 * d[i] - e[i]) / (2 * kStep);
      ASSERT_NEAR(left, right, 0.02) << "slope";
    }
  }
}

TEST_P(Noise, PrefersNoDirection) {
  if (dimension == 1) GTEST_SKIP();
  // Mean square slope along an axis and along a diagonal of each pair of axes.
  constexpr float kStep = 1.0f / 64;
  auto points = random_points(kMany, -200, 200);
  auto slope = [&](const Point& direction) {
    std::vector<float> a = noise(dimension, points);
    std::vector<float> b = noise(dimension, mapped(points, [&](Point& p) {
                                   for (int i = 0; i < dimension; ++i)
                                     p[i] += kStep * direction[i];
                                 }));
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
      sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
  };
  double along_x = slope({1});
  for (int i = 1; i < dimension; ++i) {
    Point axis{}, diagonal{}, other{};
    axis[i] = 1;
    diagonal[0] = diagonal[i] = other[0] = std::sqrt(0.5f);
    other[i] = -other[0];
    EXPECT_NEAR(slope(axis) / along_x, 1, 0.03);
    EXPECT_NEAR(slope(diagonal) / along_x, 1, 0.03);
    EXPECT_NEAR(slope(other) / along_x, 1, 0.03);
  }
}

TEST_P(Noise, OfNeighbouringCellsIsUncorrelated) {
  auto points = random_points(kMany, -200, 200);
  std::vector<float> base = noise(dimension, points);
  for (float distance : {2.0f, 3.0f, 16.0f, 256.0f, 4096.0f})
    for (int axis = 0; axis < dimension; ++axis) {
      auto far = noise(dimension, mapped(points, [&](Point& p) { p[axis] += distance; }));
      EXPECT_LT(std::abs(correlation(base, far)), dimension == 1 ? 0.15 : 0.03)
          << "distance " << distance << " along axis " << axis;
    }
}

TEST_P(Noise, ComponentsOfTriplesAreUncorrelated) {
  auto points = random_points(kMany, -3000, 3000);
  std::vector<float> c[3];
  for (size_t i = 0; i < 3; ++i)
    c[i] = evaluate("noise", "color", dimension, points, i);
  EXPECT_LT(std::abs(correlation(c[0], c[1])), 0.03);
  EXPECT_LT(std::abs(correlation(c[0], c[2])), 0.03);
  EXPECT_LT(std::abs(correlation(c[1], c[2])), 0.03);
  EXPECT_EQ(c[0], noise(dimension, points)) << "the first one is the float's";
  for (std::string_view type : {"point", "vector", "normal"})
    EXPECT_EQ(c[2], evaluate("noise", type, dimension, points, 2)) << type;
  for (size_t i = 1; i < 3; ++i)
    EXPECT_NEAR(deviation(c[i]), deviation(c[0]), 0.01);
}

TEST_P(Noise, DimensionsAreUncorrelated) {
  if (dimension == 4) GTEST_SKIP();
  auto flat = mapped(random_points(kMany, -3000, 3000), [&](Point& p) { p[dimension] = 0.5f; });
  EXPECT_LT(std::abs(correlation(noise(dimension, flat), noise(dimension + 1, flat))), 0.03);
}

TEST_P(Noise, TakesAnyNumber) {
  for (float x : {1e9f, 1e10f, -1e20f, 3.4e38f, INFINITY, -INFINITY, NAN, 8388607.5f, 16777217.0f}) {
    Point p;
    p.fill(x);
    float value = noise(dimension, {p})[0];
    EXPECT_GE(value, 0) << x;
    EXPECT_LE(value, 1) << x;
    for (std::string_view name : {"cellnoise", "pnoise"}) {
      EXPECT_GE(evaluate(name, "float", dimension, {p})[0], 0) << x;
      EXPECT_LE(evaluate(name, "float", dimension, {p})[0], 1) << x;
    }
  }
}

Point with_periods(Point p, int dimension, float period) {
  for (int i = 0; i < dimension; ++i)
    p[dimension + i] = period + static_cast<float>(i);
  return p;
}

TEST_P(Noise, PeriodicNoiseRepeatsAfterEachPeriod) {
  for (float period : {1.0f, 2.0f, 7.0f, 256.0f, 1000.0f}) {
    auto points = mapped(random_points(2048, -32, 32), [&](Point& p) {
      for (float& x : p)
        x = std::floor(x * 64) / 64; // so that adding periods is exact
      p = with_periods(p, dimension, period);
    });
    std::vector<float> base = evaluate("pnoise", "color", dimension, points, 1);
    for (int axis = 0; axis < dimension; ++axis)
      for (float times : {1.0f, -3.0f}) {
        auto shifted = mapped(points, [&](Point& p) { p[axis] += times * p[dimension + axis]; });
        ASSERT_EQ(base, evaluate("pnoise", "color", dimension, shifted, 1)) << period << " axis " << axis;
      }
  }
}

TEST_P(Noise, PeriodicNoiseIsNoiseInsideThePeriod) {
  auto points = mapped(random_points(2048, 0, 999), [&](Point& p) { p = with_periods(p, dimension, 1000); });
  EXPECT_EQ(evaluate("pnoise", "float", dimension, points), noise(dimension, points));
}

TEST_P(Noise, BadPeriodsCountAsOne) {
  for (float period : {0.0f, -4.0f, 0.3f, NAN, INFINITY}) {
    Point p{0.25f, 0.5f, 0.75f, 0.125f}, one = with_periods(p, dimension, 1), bad = p;
    for (int i = 0; i < dimension; ++i)
      one[dimension + i] = 1, bad[dimension + i] = period;
    EXPECT_EQ(evaluate("pnoise", "float", dimension, {bad}), evaluate("pnoise", "float", dimension, {one}))
        << period;
  }
}

TEST_P(Noise, CellNoiseIsConstantInCellsAndUniformOverThem) {
  auto points = random_points(kMany, -1000, 1000);
  auto corners = mapped(points, [](Point& p) {
    for (float& x : p)
      x = std::floor(x);
  });
  std::vector<float> v[3];
  for (size_t i = 0; i < 3; ++i)
    v[i] = evaluate("cellnoise", "color", dimension, corners, i);
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(v[i], evaluate("cellnoise", "color", dimension, points, i));
  EXPECT_EQ(v[0], evaluate("cellnoise", "float", dimension, points));
  double bound = dimension == 1 ? 0.12 : 0.025; // 2000 cells in one dimension
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(mean(v[i]), 0.5, bound / 3);
    EXPECT_NEAR(deviation(v[i]), std::sqrt(1 / 12.0), bound / 3);
    EXPECT_LT(*std::max_element(v[i].begin(), v[i].end()), 1);
    EXPECT_GE(*std::min_element(v[i].begin(), v[i].end()), 0);
    EXPECT_LT(std::abs(correlation(v[i], v[(i + 1) % 3])), bound);
  }
  for (int axis = 0; axis < dimension; ++axis)
    for (float distance : {1.0f, 2.0f, 256.0f}) {
      auto next = mapped(corners, [&](Point& p) { p[axis] += distance; });
      EXPECT_LT(std::abs(correlation(v[0], evaluate("cellnoise", "float", dimension, next))), bound);
    }
}

} // namespace
} // namespace slvm::test
