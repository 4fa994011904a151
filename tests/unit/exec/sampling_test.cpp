// Where rays go: distributions against their densities, evenness within a point, and independence between
// points, calls and grids.
#include "tests/unit/exec/ray_scene.h"

#include "slvm/kernels/draw_numbers.h"
#include "slvm/support/sample_sequence.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <random>

namespace slvm {
namespace {

using namespace test;

/// The rays that a surface's statements shoot from a square of nu x nv points.
std::vector<AskedRay> rays_of(const std::string& statements, int nu, int nv, uint64_t id = 11,
                              std::string_view type = "camera") {
  const Machine machine;
  RayServicesScene services;
  auto surface = instantiate(machine, "surface s() { " + statements + " }");
  Grid grid = square(nu, nv);
  grid.id = id;
  grid.ray.type = type;
  ShadingContext context(machine, services);
  context.shade({.surface = surface.get()}, grid);
  return services.scene.rays;
}

std::vector<AskedRay> gather_rays(const std::string& angle, int samples, const std::string& tokens, int nu,
                                  int nv, uint64_t id = 11) {
  return rays_of(fmt::format("gather(\"\", P, vector (0, 0, 1), {}, {}{}) Ci += 1; else Ci += 1;", angle,
                             samples, tokens),
                 nu, nv, id);
}

/// Pearson's statistic of counts that should all be the same.
double chi_square(const std::vector<double>& counts) {
  double total = 0, sum = 0;
  for (double c : counts)
    total += c;
  const double expected = total / static_cast<double>(counts.size());
  for (double c : counts)
    sum += (c - expected) * (c - expected) / expected;
  return sum;
}

// Cells of equal probability: turn about the axis, and `height`, which grows from 0 to 1 evenly.
template <class Height> double chi_square_of_cone(const std::vector<AskedRay>& rays, Height&& height) {
  constexpr size_t kTurns = 8, kHeights = 8;
  std::vector<double> counts(kTurns * kHeights);
  for (const AskedRay& ray : rays) {
    const double turn = std::atan2(ray.direction[1], ray.direction[0]) / (2 * std::numbers::pi) + 0.5;
    const auto i = std::min(static_cast<size_t>(turn * kTurns), kTurns - 1);
    const auto j = std::min(static_cast<size_t>(std::max(height(ray), 0.0) * kHeights), kHeights - 1);
    ++counts[i * kHeights + j];
  }
  return chi_square(counts);
}

// 63 degrees of freedom: a right distribution exceeds this once in 1000.
constexpr double kMostOf63 = 103.4;

TEST(Sampling, UniformConesAreUniform) {
  for (auto [text, angle] :
       {std::pair("0.3", 0.3), {"PI / 2", std::numbers::pi / 2}, {"PI", std::numbers::pi}}) {
    const auto rays = gather_rays(text, 1, "", 100, 100);
    ASSERT_EQ(rays.size(), 10000u);
    const double least = std::cos(angle);
    for (const AskedRay& ray : rays)
      ASSERT_GE(ray.direction[2], least - 1e-6);
    EXPECT_LT(chi_square_of_cone(rays, [&](const AskedRay& r) { return (1 - r.direction[2]) / (1 - least); }),
              kMostOf63)
        << text;
  }
}

TEST(Sampling, CosineConesAreDenseAsTheCosine) {
  for (auto [text, angle] : {std::pair("0.7", 0.7), {"PI / 2", std::numbers::pi / 2}}) {
    const auto rays = gather_rays(text, 1, ", \"distribution\", \"cosine\"", 100, 100);
    const double squared = std::pow(std::sin(angle), 2);
    for (const AskedRay& ray : rays)
      ASSERT_GE(ray.direction[2], std::cos(angle) - 1e-6);
    EXPECT_LT(chi_square_of_cone(
                  rays, [&](const AskedRay& r) { return (1 - r.direction[2] * r.direction[2]) / squared; }),
              kMostOf63)
        << text;
    // And not as the other kind is.
    EXPECT_GT(chi_square_of_cone(
                  rays, [&](const AskedRay& r) { return (1 - r.direction[2]) / (1 - std::cos(angle)); }),
              kMostOf63);
  }
}

TEST(Sampling, DirectionsHaveLengthOneAboutAnyAxis) {
  for (const char* axis : {"1, 0, 0", "0, 0, -1", "0, -1, 0", "-0.3, 0.5, -0.7"}) {
    const auto rays =
        rays_of(fmt::format("gather(\"\", P, 5 * vector ({}), 0.4, 64) Ci += 1; else Ci += 1;", axis), 4, 4);
    Vec mean{};
    for (const AskedRay& ray : rays) {
      double length = 0;
      for (size_t c = 0; c < 3; ++c) {
        length += ray.direction[c] * ray.direction[c];
        mean[c] += ray.direction[c] / static_cast<double>(rays.size());
      }
      EXPECT_NEAR(length, 1, 1e-6);
    }
    // The mean of a uniform cone: (1 + cos a) / 2 along its axis.
    EXPECT_NEAR(std::sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]), (1 + std::cos(0.4)) / 2,
                2e-3);
  }
}

TEST(Sampling, SamplesOfAPointAreSpreadEvenly) {
  // Any 16 of a (0, 2)-sequence that begin at a multiple of 16 are one in each cell of 16 x 1, 8 x 2, 4
  // x 4...
  for (uint32_t point : {0u, 1u, 77u}) {
    const uint32_t seed = point_seed(5, 2, point);
    for (uint32_t from : {0u, 16u, 96u})
      for (uint32_t columns : {1u, 2u, 4u, 8u, 16u}) {
        std::vector<int> cells(16);
        for (uint32_t k = from; k < from + 16; ++k) {
          const SobolSample sample(k);
          const float x = scrambled(sample.bits[0], scramble_seed(seed, SampleUse::kTurn));
          const float y = scrambled(sample.bits[1], scramble_seed(seed, SampleUse::kRadius));
          const auto rows = static_cast<float>(16 / columns);
          ++cells[static_cast<size_t>(x * static_cast<float>(columns)) * (16 / columns) +
                  static_cast<size_t>(y * rows)];
        }
        EXPECT_EQ(cells, std::vector<int>(16, 1))
            << point << " from " << from << " in " << columns << " columns";
      }
  }
}

TEST(Sampling, FirstNumbersOfTheSequence) {
  // Joe and Kuo's tables: dimensions 1 to 4 of points 0 to 4.
  const double expected[5][4] = {{0, 0, 0, 0},
                                 {0.5, 0.5, 0.5, 0.5},
                                 {0.25, 0.75, 0.75, 0.75},
                                 {0.75, 0.25, 0.25, 0.25},
                                 {0.125, 0.625, 0.375, 0.125}};
  for (uint32_t k = 0; k < 5; ++k)
    for (int use = 0; use < kSampleUses; ++use)
      EXPECT_EQ(reversed_bits(SobolSample(k).bits[use]) * 0x1p-32, expected[k][use]) << k << " " << use;
}

TEST(Sampling, PointsCallsAndGridsDiffer) {
  const auto rays = gather_rays("0.5", 1, "", 8, 8), other_grid = gather_rays("0.5", 1, "", 8, 8, 12);
  for (size_t r = 1; r < rays.size(); ++r)
    EXPECT_NE(rays[r].direction, rays[r - 1].direction);
  for (size_t r = 0; r < rays.size(); ++r)
    EXPECT_NE(rays[r].direction, other_grid[r].direction);
  const auto two = rays_of(
      "float i; for (i = 0; i < 2; i += 1) gather(\"\", P, vector (0, 0, 1), 0.5, 1) Ci += 1; else Ci += 1;",
      8, 8);
  ASSERT_EQ(two.size(), 128u);
  for (size_t r = 0; r < 64; ++r)
    EXPECT_NE(two[r].direction, two[r + 64].direction);
}

TEST(Sampling, TheSameEveryTime) {
  const auto once = gather_rays("PI / 2", 16, "", 9, 7), again = gather_rays("PI / 2", 16, "", 9, 7);
  ASSERT_EQ(once.size(), again.size());
  for (size_t r = 0; r < once.size(); ++r) {
    EXPECT_EQ(once[r].direction, again[r].direction);
    EXPECT_EQ(once[r].origin, again[r].origin);
  }
}

TEST(Sampling, OriginsAreSpreadOverTheElement) {
  // Elements of a square of 5 x 5 points are 1/4 wide.
  auto spread = [](int samples, const std::string& tokens) {
    double most = 0;
    for (const AskedRay& ray : gather_rays("0", samples, tokens, 5, 5)) {
      most = std::max(most, std::fabs(ray.origin[0] - ray.point % 5 * 0.25));
      most = std::max(most, std::fabs(ray.origin[1] - ray.point / 5 * 0.25));
      EXPECT_EQ(ray.origin[2], 1);
    }
    return most;
  };
  EXPECT_EQ(spread(1, ""), 0); // one ray is at P
  EXPECT_NEAR(spread(64, ""), 0.125, 0.005);
  EXPECT_NEAR(spread(64, ", \"samplebase\", 0.5"), 0.0625, 0.0025);
  EXPECT_EQ(spread(64, ", \"samplebase\", 0"), 0);
  EXPECT_GT(spread(1, ", \"samplebase\", 1"), 0.1);
}

TEST(Sampling, OriginsStayOnWhatDiffuseRaysHit) {
  const std::string call = "gather(\"\", P, vector (0, 0, 1), 0, 16{}) Ci += 1; else Ci += 1;";
  auto spread = [&](std::string_view tokens, std::string_view type) {
    double most = 0;
    for (const AskedRay& ray : rays_of(fmt::format(fmt::runtime(call), tokens), 5, 5, 11, type))
      most = std::max(most, std::fabs(ray.origin[0] - ray.point % 5 * 0.25));
    return most;
  };
  EXPECT_EQ(spread("", "diffuse"), 0);
  EXPECT_GT(spread("", "specular"), 0.1);
  EXPECT_GT(spread(", \"samplebase\", 1", "diffuse"), 0.1);
}

TEST(Sampling, MeansFallFasterThanChance) {
  // The part of a disk's light through half of it: with n even samples the error falls faster than 1 /
  // sqrt(n).
  auto error = [](int samples) {
    std::vector<double> inside(100);
    for (const AskedRay& ray : gather_rays("0.5", samples, ", \"distribution\", \"cosine\"", 10, 10))
      inside[ray.point] += ray.direction[0] + 0.5 * ray.direction[1] > 0.05;
    double mean = 0, variance = 0;
    for (double& x : inside)
      mean += (x /= samples) / 100;
    for (double x : inside)
      variance += (x - mean) * (x - mean) / 100;
    return std::sqrt(variance);
  };
  EXPECT_LT(error(256), 0.45 * error(16) / 4 * 1.6); // chance: error(16) / 4
  EXPECT_GT(error(1), 0.3);
}

TEST(Sampling, NumbersOfManyPointsAreThoseOfEach) {
  std::mt19937 random(5);
  for (const size_t count : {0, 1, 7, 8, 255, 256, 1000}) {
    std::vector<uint32_t> seeds(count);
    for (uint32_t& seed : seeds)
      seed = static_cast<uint32_t>(random());
    const auto bits = static_cast<uint32_t>(random());
    std::vector<float> numbers(count + 1, -1.0f);
    draw_numbers(bits, seeds.data(), count, numbers.data());
    for (size_t i = 0; i < count; ++i)
      EXPECT_EQ(numbers[i], scrambled(bits, seeds[i])) << i;
    EXPECT_EQ(numbers[count], -1) << "no further";
  }
}

} // namespace
} // namespace slvm
