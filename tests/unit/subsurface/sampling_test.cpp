// Importance sampling: distributions by chi-square and quartiles, estimators against what they estimate.
#include "stdlib/subsurface/materials.h"
#include "stdlib/subsurface/random.h"
#include "stdlib/subsurface/sampling.h"
#include "tests/unit/subsurface/numeric.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace subsurface::test {
namespace {

TEST(Sampling, RadiusInvertsTheDistribution) {
  EXPECT_NEAR(diffusion_radius(0.25), 0.96128, 1e-5);
  EXPECT_NEAR(diffusion_radius(0.5), 1.67835, 1e-5);
  EXPECT_NEAR(diffusion_radius(0.75), 2.69263, 1e-5);
  EXPECT_NEAR(diffusion_radius(0.99), 6.63835, 1e-5);
  EXPECT_EQ(diffusion_radius(0), 0);
  for (double xi = 1e-12; xi < 1; xi = xi < 0.5 ? xi * 1.7 : 1 - (1 - xi) * 0.6) {
    EXPECT_NEAR(diffusion_cdf(diffusion_radius(xi)) / xi, 1, 1e-9) << xi;
    if (1 - xi < 1e-14) break;
  }
  EXPECT_TRUE(std::isfinite(diffusion_radius(1)));
}

TEST(Sampling, DensityIntegratesToOneOverThePlane) {
  auto ring = [](double r) { return 2 * std::numbers::pi * r * diffusion_pdf(r, 0.27); };
  EXPECT_NEAR(integral(ring, 0, 200), 1, 1e-7);
}

TEST(Sampling, PlacesAreDistributedByRadiusAndAngle) {
  Random random(11);
  std::vector<size_t> radii(64), angles(64);
  double mean = 0;
  constexpr int kCount = 64000;
  for (int i = 0; i < kCount; ++i) {
    const DiffusionSample s = sample_diffusion(random.unit(), random.unit(), 0.4);
    EXPECT_NEAR(std::hypot(s.x, s.y), s.radius, 1e-9);
    mean += 0.4 * s.radius / kCount;
    // Equal shares of the distribution, from its own closed form.
    ++radii[static_cast<size_t>(diffusion_cdf(0.4 * s.radius) * 63.999999)];
    ++angles[static_cast<size_t>((std::atan2(s.y, s.x) / std::numbers::pi + 1) * 31.999999)];
  }
  EXPECT_LT(chi_square_uniform(radii), chi_square_limit(radii.size()));
  EXPECT_LT(chi_square_uniform(angles), chi_square_limit(angles.size()));
  EXPECT_NEAR(mean, 2, 0.02);
}

TEST(Sampling, DiffusionEstimatorGivesTheTotal) {
  // For all three colours with one set of samples, those of the smallest sigma_tr.
  const MediumRgb skin = medium_of(*find_material("skin1"));
  const DipoleRgb dipoles = dipole_of(skin);
  const double transport = dipoles[0].effective_transport;
  constexpr int kCount = 20000;
  double sum[3] = {};
  for (int i = 0; i < kCount; ++i) {
    const DiffusionSample s = sample_diffusion((i + 0.5) / kCount, 0, transport);
    for (size_t c = 0; c < 3; ++c)
      sum[c] += diffusion_weight(dipoles[c], s.radius, transport) / kCount;
  }
  for (size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(sum[c], dipoles[c].total(), 2e-3) << c;
}

TEST(Sampling, SingleScatteringDistances) {
  EXPECT_EQ(single_scattering_distance(0, 3), 0);
  EXPECT_NEAR(single_scattering_distance(1 - std::exp(-1.5), 3), 0.5, 1e-12);
  const std::array<double, 3> sigma{0.7, 1.2, 5};
  auto cdf = [&](double s) {
    double sum = 0;
    for (double t : sigma)
      sum += (1 - std::exp(-t * s)) / 3;
    return sum;
  };
  EXPECT_NEAR(integral([&](double s) { return single_scattering_pdf(s, sigma); }, 0, 2), cdf(2), 1e-9);
  Random random(5);
  std::vector<size_t> counts(50);
  for (int i = 0; i < 50000; ++i)
    ++counts[static_cast<size_t>(cdf(single_scattering_distance(random.unit(), random.unit(), sigma)) *
                                 49.99999)];
  EXPECT_LT(chi_square_uniform(counts), chi_square_limit(counts.size()));
}

} // namespace
} // namespace subsurface::test
