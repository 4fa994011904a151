// Henyey and Greenstein's phase function: normalisation, mean cosine, and the distribution of samples.
#include "stdlib/subsurface/phase.h"
#include "stdlib/subsurface/random.h"
#include "tests/unit/subsurface/numeric.h"

#include <gtest/gtest.h>
#include <numbers>

namespace subsurface::test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Phase, IsNormalisedWithMeanCosineG) {
  for (double g : {-0.3, 0.0, 0.5, 0.85}) {
    auto p = [&](double mu) { return 2 * kPi * henyey_greenstein(mu, g); };
    EXPECT_NEAR(integral(p, -1, 1, 20000), 1, 1e-6) << g;
    EXPECT_NEAR(integral([&](double mu) { return mu * p(mu); }, -1, 1, 20000), g, 1e-6) << g;
  }
}

TEST(Phase, SamplesHaveTheDistribution) {
  for (double g : {-0.6, 0.0, 5e-5, 0.3, 0.85}) {
    // The cumulative distribution of the cosine, 2 pi int_-1^mu p.
    auto cdf = [&](double mu) {
      if (std::abs(g) < 1e-4) return 0.5 * (1 + mu);
      return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * mu) - 1 / (1 + g));
    };
    for (double xi : {0.0, 0.1, 0.5, 0.9, 0.999})
      EXPECT_NEAR(cdf(sample_henyey_greenstein(xi, g)), xi, 1e-4) << g << " " << xi;
  }
}

TEST(Phase, DirectionsTurnByThatCosineAllRound) {
  Random random(3);
  const Vec3 w = normalize(Vec3{0.3f, -0.5f, 0.8f});
  std::vector<size_t> around(16);
  double mean = 0;
  constexpr int kCount = 20000;
  const Frame frame(w);
  for (int i = 0; i < kCount; ++i) {
    const Vec3 d = scatter_direction(w, random.unit(), random.unit(), 0.7);
    ASSERT_NEAR(length(d), 1, 1e-5);
    mean += static_cast<double>(dot(d, w)) / kCount;
    const double angle =
        std::atan2(static_cast<double>(dot(d, frame.v)), static_cast<double>(dot(d, frame.u)));
    ++around[static_cast<size_t>((angle / kPi + 1) * 7.99999)];
  }
  EXPECT_NEAR(mean, 0.7, 0.01);
  EXPECT_LT(chi_square_uniform(around), chi_square_limit(around.size()));
}

} // namespace
} // namespace subsurface::test
