// Fresnel terms against closed forms.
#include "stdlib/subsurface/fresnel.h"

#include <cmath>
#include <gtest/gtest.h>

namespace subsurface {
namespace {

/// The average over diffuse light from outside, in closed form (Walsh 1926, in Judd, "Fresnel reflection of
/// diffusely incident light", 1942).
double walsh(double n) {
  const double n2 = n * n, n4 = n2 * n2;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
         2 * n * n2 * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
         8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
}

TEST(Fresnel, DiffuseReflectanceAgreesWithTheClosedForm) {
  for (double eta : {1.05, 1.1, 1.3, 1.33, 1.5, 2.0, 2.4}) {
    EXPECT_NEAR(diffuse_reflectance_exact(1 / eta), walsh(eta), 1e-9) << eta;
    EXPECT_NEAR(diffuse_reflectance_exact(eta), 1 - (1 - walsh(eta)) / (eta * eta), 1e-9) << eta;
  }
  EXPECT_EQ(diffuse_reflectance_exact(1), 0);
  EXPECT_NEAR(diffuse_reflectance_exact(1.3), 0.44446, 1e-5);
  EXPECT_NEAR(diffuse_reflectance_exact(1.5), 0.59635, 1e-5);
}

TEST(Fresnel, TheFitIsThatOfThePapers) {
  EXPECT_NEAR(diffuse_reflectance_fit(1.3), 0.444763, 1e-6);
  EXPECT_NEAR(diffuse_reflectance_fit(1.33), 0.47236, 1e-5);
  EXPECT_NEAR(diffuse_reflectance_fit(1.5), 0.59673, 1e-5);
  EXPECT_NEAR(boundary_mismatch(diffuse_reflectance_fit(1.3)), 2.602064, 1e-6);
  EXPECT_NEAR(boundary_mismatch(diffuse_reflectance_fit(1.33)), 2.7904, 1e-4);
  EXPECT_NEAR(boundary_mismatch(diffuse_reflectance_fit(1.5)), 3.9595, 1e-4);
  for (double eta = 1.2; eta < 1.6; eta += 0.01)
    EXPECT_NEAR(diffuse_reflectance_fit(eta), diffuse_reflectance_exact(eta), 6e-4) << eta;
  for (double eta = 0.65; eta < 0.9; eta += 0.05)
    EXPECT_NEAR(diffuse_reflectance_fit(eta), diffuse_reflectance_exact(eta), 3e-3) << eta;
}

TEST(Fresnel, OneDirection) {
  EXPECT_NEAR(fresnel_reflectance(1, 1.5), 0.04, 1e-12);
  EXPECT_NEAR(fresnel_reflectance(-1, 1 / 1.5), 0.04, 1e-12);
  EXPECT_EQ(fresnel_reflectance(0, 1.5), 1);
  EXPECT_EQ(fresnel_reflectance(0.5, 1), 0);
  EXPECT_EQ(fresnel_reflectance(0.5, 1 / 1.5), 1); // beyond the critical angle, cosine 0.745
  // Brewster's angle, tan = eta: p vanishes, s is ((eta^2-1)/(eta^2+1))^2.
  const double eta = 1.5, brewster = 1 / std::sqrt(1 + eta * eta);
  EXPECT_NEAR(fresnel_reflectance(brewster, eta), 0.5 * std::pow(1.25 / 3.25, 2), 1e-12);
  // The same ray in both directions.
  EXPECT_NEAR(fresnel_reflectance(0.6, eta), fresnel_reflectance(refracted_cosine(0.6, eta), 1 / eta), 1e-12);
  EXPECT_NEAR(fresnel_transmittance(0.6, eta) + fresnel_reflectance(0.6, eta), 1, 1e-15);
}

TEST(Fresnel, RefractFollowsSnell) {
  const Vec3 n{0, 0, 1}, in = normalize(Vec3{1, 0, -1});
  const Vec3 t = refract(in, n, 1.5);
  EXPECT_NEAR(length(t), 1, 1e-6);
  EXPECT_NEAR(t.x, std::sqrt(0.5) / 1.5, 1e-6);
  EXPECT_LT(t.z, 0);
  EXPECT_NEAR(-t.z, refracted_cosine(std::sqrt(0.5), 1.5), 1e-6);
  EXPECT_EQ(refract(in, n, 0.5), Vec3{}); // all is reflected
}

} // namespace
} // namespace subsurface
