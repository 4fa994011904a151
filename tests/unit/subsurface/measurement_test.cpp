// Coefficients from profiles: known ones come back, from the dipole, with noise, and from photons.
#include "stdlib/subsurface/materials.h"
#include "stdlib/subsurface/measurement.h"
#include "stdlib/subsurface/random.h"
#include "tests/unit/subsurface/photon_walk.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace subsurface::test {
namespace {

/// Samples of a medium's dipole from 1 to 20 mean free paths.
std::vector<ProfileSample> profile_of(const Medium& medium) {
  const Dipole dipole(medium);
  std::vector<ProfileSample> out;
  for (int i = 0; i < 60; ++i) {
    const double r = medium.mean_free_path() * std::pow(20, i / 59.0);
    out.push_back({r, dipole.profile(r)});
  }
  return out;
}

TEST(Measurement, EveryMeasuredMaterialComesBack) {
  for (const MeasuredMaterial& m : measured_materials())
    for (const Medium& medium : medium_of(m)) {
      const auto fit = fit_medium(profile_of(medium), Dipole(medium).total(), medium.eta);
      ASSERT_TRUE(fit) << fit.error();
      EXPECT_NEAR(fit->medium.sigma_a, medium.sigma_a, 1e-5 * medium.sigma_a + 1e-8) << m.name;
      EXPECT_NEAR(fit->medium.reduced_scattering() / medium.reduced_scattering(), 1, 1e-5) << m.name;
      EXPECT_LT(fit->off, 1e-6);
    }
}

// Figure 6 of the paper: marble, green.
TEST(Measurement, NoiseAveragesOut) {
  const Medium marble = medium_of(*find_material("marble"))[1];
  auto profile = profile_of(marble);
  Random random(3);
  for (ProfileSample& s : profile)
    s.exitance *= 0.9 + 0.2 * random.unit();
  const auto fit = fit_medium(profile, Dipole(marble).total(), marble.eta);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->medium.sigma_a / marble.sigma_a, 1, 0.03);
  EXPECT_NEAR(fit->medium.reduced_scattering() / marble.reduced_scattering(), 1, 0.03);
  EXPECT_NEAR(fit->off, 0.2 / std::sqrt(12), 0.01);
}

TEST(Measurement, OfSimulatedPhotons) {
  const Medium medium = medium_of_reduced(0.05, 1, 0, 1.3);
  WalkOptions options;
  options.photons = 300000;
  for (int i = 0; i <= 24; ++i)
    options.radii.push_back(0.5 * i);
  const WalkResult walk = walk_photons(medium, options);
  std::vector<ProfileSample> profile;
  for (size_t i = 3; i + 1 < options.radii.size(); ++i) {
    const double inner = options.radii[i], outer = options.radii[i + 1];
    profile.push_back(
        {(inner + outer) / 2, walk.rings[i] / (std::numbers::pi * (outer * outer - inner * inner))});
  }
  const auto fit = fit_medium(profile, walk.reflected, medium.eta);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->medium.reduced_scattering(), 1, 0.15);
  EXPECT_NEAR(fit->medium.sigma_a, 0.05, 0.0075);
}

TEST(Measurement, NumbersThatCannotBe) {
  const ProfileSample good[] = {{1, 0.1}}, bad[] = {{1, 0}};
  EXPECT_EQ(fit_medium({}, 0.5, 1.3).error(), "the profile has no samples");
  EXPECT_EQ(fit_medium(good, 1.5, 1.3).error(),
            "the total reflectance is 1.5, it must be above 0 and not above 1");
  EXPECT_EQ(fit_medium(good, 0.5, 0).error(), "the index of refraction is 0, it must be above 0");
  EXPECT_EQ(fit_medium(bad, 0.5, 1.3).error(),
            "a sample of the profile is 0 at a distance of 1: both must be above 0");
}

} // namespace
} // namespace subsurface::test
