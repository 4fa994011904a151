// Single scattering: the sampled ray against the closed form for a flat surface.
#include "stdlib/subsurface/phase.h"
#include "stdlib/subsurface/single_scattering.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace subsurface::test {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3 direction(double degrees, double around = 0) {
  const double t = degrees * kPi / 180, f = around * kPi / 180;
  return {static_cast<float>(std::sin(t) * std::cos(f)), static_cast<float>(std::sin(t) * std::sin(f)),
          static_cast<float>(std::cos(t))};
}

/// The half-space below z = 0.
bool flat(Vec3 from, Vec3 to, SurfaceHit& hit) {
  if (to.z <= 0) return false;
  hit.distance = static_cast<double>(-from.z / to.z);
  hit.normal = {0, 0, 1};
  return true;
}

TEST(SingleScattering, RefractedDistanceIsThatOfASlab) {
  for (double eta : {1.3, 1.5})
    for (double degrees : {20.0, 60.0}) {
      const double angle = degrees * kPi / 180, depth = 1;
      const double wanted = depth / std::cos(std::asin(std::sin(angle) / eta));
      EXPECT_NEAR(refracted_distance(depth / std::cos(angle), std::cos(angle), eta), wanted, 1e-12);
      EXPECT_NEAR(refracted_distance(depth / std::cos(angle), -std::cos(angle), eta), wanted, 1e-12);
    }
}

TEST(SingleScattering, RayOnAFlatSurfaceGivesTheBrdf) {
  for (double g : {-0.3, 0.0, 0.6}) {
    const MediumRgb medium = medium_of(*find_material("skin1"), g);
    for (auto [in, out, around] : {std::array{0.0, 0.0, 0.0}, {30.0, 50.0, 180.0}, {70.0, 20.0, 60.0}}) {
      SingleScatteringSetup setup;
      setup.normal = {0, 0, 1};
      setup.w_in = direction(in);
      setup.w_out = direction(out, around);
      setup.samples = 30000;
      const Color sampled = single_scattering(medium, setup, flat);
      for (int c = 0; c < 3; ++c) {
        const Medium& m = medium[static_cast<size_t>(c)];
        const double leaving = fresnel_transmittance(static_cast<double>(setup.w_out.z), m.eta);
        const double wanted = single_scattering_brdf(m, setup.normal, setup.w_in, setup.w_out) *
                              static_cast<double>(setup.w_in.z) / leaving;
        EXPECT_NEAR(static_cast<double>(sampled[c]) / wanted, 1, 0.01) << g << " " << in << " " << c;
      }
    }
  }
}

TEST(SingleScattering, OneWavelengthNeedsFewSamples) {
  // Where light goes back the way it came, what is left to sample is exp(-s_i' sigma_t) over stratified
  // places.
  Medium m = medium_of_reduced(0.1, 0.9, 0, 1.3);
  SingleScatteringSetup setup;
  setup.normal = setup.w_in = setup.w_out = {0, 0, 1};
  setup.samples = 64;
  const Color c = single_scattering({m, m, m}, setup, flat);
  const double wanted =
      single_scattering_brdf(m, setup.normal, setup.w_in, setup.w_out) / fresnel_transmittance(1, 1.3);
  EXPECT_NEAR(static_cast<double>(c.x) / wanted, 1, 0.01);
  EXPECT_EQ(c.x, c.y);
}

TEST(SingleScattering, ABoundOnDepthLosesOnlyWhatLiesDeeper) {
  const Medium m = medium_of_reduced(0.1, 0.9, 0, 1.3);
  SingleScatteringSetup setup;
  setup.normal = setup.w_in = setup.w_out = {0, 0, 1};
  setup.samples = 20000;
  const double whole = static_cast<double>(single_scattering({m, m, m}, setup, flat).x);
  setup.depth = 0.7;
  const double part = static_cast<double>(single_scattering({m, m, m}, setup, flat).x);
  EXPECT_NEAR(part / whole, 1 - std::exp(-2 * m.sigma_t() * 0.7), 0.01);
}

TEST(SingleScattering, MediumWhereLightEnters) {
  const Medium out = medium_of_reduced(0.1, 0.9, 0, 1.3), in = medium_of_reduced(1, 3, 0, 1.3);
  const SingleScatteringPath path{0.5, 0.25, 0.8, 0.3};
  const double way = refracted_distance(0.25, 0.8, 1.3), inside = refracted_cosine(0.8, 1.3);
  const double wanted = out.sigma_s * fresnel_transmittance(0.8, 1.3) / (4 * kPi) * 0.8 / (1.69 * inside) *
                        std::exp(-way * in.sigma_t() - 0.5 * out.sigma_t());
  EXPECT_NEAR(single_scattering_density(out, in, path) / wanted, 1, 1e-12);
}

TEST(SingleScattering, NoLightFromBehindAndNothingInEmptySpace) {
  const Medium m = medium_of_reduced(0.1, 0.9, 0, 1.3), empty;
  SingleScatteringSetup setup;
  setup.normal = setup.w_out = {0, 0, 1};
  setup.w_in = {0, 0, -1};
  EXPECT_EQ(single_scattering({m, m, m}, setup, flat), Color{});
  setup.w_in = {0, 0, 1};
  EXPECT_EQ(single_scattering({empty, empty, empty}, setup, flat), Color{});
  EXPECT_EQ(subsurface_brdf(m, {0, 0, 1}, {0, 0, -1}, {0, 0, 1}), 0);
}

TEST(SingleScattering, TheSameSeedGivesTheSameValue) {
  const MediumRgb medium = medium_of(*find_material("marble"));
  SingleScatteringSetup setup;
  setup.normal = {0, 0, 1};
  setup.w_in = direction(40);
  setup.w_out = direction(10, 90);
  const Color once = single_scattering(medium, setup, flat);
  EXPECT_EQ(once, single_scattering(medium, setup, flat));
  setup.seed = 1;
  EXPECT_NE(once, single_scattering(medium, setup, flat));
}

TEST(SingleScattering, BrdfIsReciprocalAndAddsUp) {
  const Medium m = medium_of_reduced(0.1, 0.9, 0.4, 1.3);
  const Vec3 n{0, 0, 1}, a = direction(25), b = direction(65, 140);
  EXPECT_NEAR(subsurface_brdf(m, n, a, b), subsurface_brdf(m, n, b, a), 1e-7);
  const double diffuse = fresnel_transmittance(static_cast<double>(a.z), 1.3) *
                         fresnel_transmittance(static_cast<double>(b.z), 1.3) * Dipole(m).total() / kPi;
  EXPECT_NEAR(subsurface_brdf(m, n, a, b), single_scattering_brdf(m, n, a, b) + diffuse, 1e-12);
}

} // namespace
} // namespace subsurface::test
