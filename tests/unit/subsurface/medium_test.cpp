// Coefficients, what is seen of them, and back.
#include "stdlib/subsurface/dipole.h"
#include "stdlib/subsurface/medium.h"

#include <cmath>
#include <gtest/gtest.h>

namespace subsurface {
namespace {

const double kSkin = boundary_mismatch(diffuse_reflectance_fit(1.3));

TEST(Medium, DerivedQuantities) {
  const Medium m = medium_of_reduced(0.032, 0.74, 0.85, 1.3); // Skin1, red
  EXPECT_NEAR(m.sigma_s, 0.74 / 0.15, 1e-12);
  EXPECT_NEAR(m.reduced_scattering(), 0.74, 1e-12);
  EXPECT_NEAR(m.reduced_extinction(), 0.772, 1e-12);
  EXPECT_NEAR(m.reduced_albedo(), 0.95855, 1e-5);
  EXPECT_NEAR(m.effective_transport(), 0.2722, 1e-4);
  EXPECT_NEAR(m.diffuse_mean_free_path(), 3.673, 1e-3);
  EXPECT_NEAR(m.mean_free_path(), 1 / 0.772, 1e-12);
  EXPECT_NEAR(scattering_distance_ratio(m.albedo(), m.g), m.sigma_t() / m.effective_transport(), 1e-9);
  // Skim milk, red, g 0.9: albedo 0.9998, ratio 129 (2002, 2.1).
  const Medium milk = medium_of_reduced(0.0014, 0.70, 0.9, 1.3);
  EXPECT_NEAR(milk.albedo(), 0.9998, 1e-5);
  EXPECT_NEAR(scattering_distance_ratio(milk.albedo(), milk.g), 129, 0.5);
  EXPECT_TRUE(std::isinf(medium_of_reduced(0, 1, 0, 1.3).diffuse_mean_free_path()));
  EXPECT_EQ(Medium{}.reduced_albedo(), 0);
}

TEST(Medium, DiffuseAlbedoRisesFromZeroToOne) {
  EXPECT_EQ(diffuse_albedo(0, kSkin), 0);
  EXPECT_EQ(diffuse_albedo(1, kSkin), 1);
  double before = 0;
  for (double a = 0.001; a < 1; a += 0.001) {
    EXPECT_GT(diffuse_albedo(a, kSkin), before);
    before = diffuse_albedo(a, kSkin);
  }
}

TEST(Medium, InversionHasNoTableError) {
  for (double eta : {1.0, 1.3, 1.5, 2.0})
    for (int i = 0; i <= 20000; ++i) {
      const double rd = i / 20000.0, mismatch = boundary_mismatch(diffuse_reflectance_fit(eta));
      ASSERT_NEAR(diffuse_albedo(reduced_albedo_of(rd, mismatch), mismatch), rd, 1e-7) << eta << " " << rd;
    }
  // Where the course's table is worst (4.2: 0.913 gives an error of 0.115), and near the ends.
  for (double rd : {0.0, 1e-9, 1e-5, 0.13, 0.44, 0.85, 0.913, 0.98, 0.9999, 1.0})
    EXPECT_NEAR(diffuse_albedo(reduced_albedo_of(rd, kSkin), kSkin), rd, 1e-7) << rd;
  EXPECT_NEAR(reduced_albedo_of(0.436, kSkin), 0.95855, 1e-4);
  EXPECT_EQ(reduced_albedo_of(-1, kSkin), 0);
  EXPECT_EQ(reduced_albedo_of(2, kSkin), 1);
  EXPECT_EQ(reduced_albedo_of(std::nan(""), kSkin), 0);
}

TEST(Medium, AppearanceRoundTrip) {
  const Medium skin = medium_of_reduced(0.032, 0.74, 0.85, 1.3);
  const Appearance seen = appearance_of(skin);
  EXPECT_NEAR(seen.albedo, 0.435956, 1e-6);
  EXPECT_NEAR(seen.mean_free_path, 3.673, 1e-3);
  const Medium back = medium_of(seen, 0.85, 1.3);
  EXPECT_NEAR(back.sigma_a, 0.032, 1e-9);
  EXPECT_NEAR(back.reduced_scattering(), 0.74, 1e-8);
  EXPECT_NEAR(back.sigma_s, skin.sigma_s, 1e-7);
  for (double albedo : {0.01, 0.3, 0.7, 0.95, 0.999})
    for (double path : {0.1, 1.0, 30.0}) {
      const Appearance again = appearance_of(
          medium_of(Appearance{albedo, path}, 0, 1.4, DiffuseFresnel::kExact), DiffuseFresnel::kExact);
      EXPECT_NEAR(again.albedo, albedo, 1e-5);
      EXPECT_NEAR(again.mean_free_path / path, 1, 1e-9);
    }
}

TEST(Medium, AlbedoOneAndZeroStayFinite) {
  const Medium white = medium_of(Appearance{1, 2}, 0, 1.3);
  EXPECT_TRUE(std::isfinite(white.sigma_s));
  EXPECT_NEAR(white.diffuse_mean_free_path(), 2, 1e-9);
  EXPECT_NEAR(appearance_of(white).albedo, 1, 1e-3);
  const Medium black = medium_of(Appearance{0, 2}, 0, 1.3);
  EXPECT_NEAR(black.sigma_s, 0, 1e-12);
  EXPECT_NEAR(black.diffuse_mean_free_path(), 2, 1e-9);
}

TEST(Medium, FixedScatteringWithATexture) {
  const double rd = diffuse_albedo(0.74 / 0.772, kSkin);
  const Medium m = medium_of_albedo(rd, 0.74, 0.85, 1.3);
  EXPECT_NEAR(m.sigma_a, 0.032, 1e-9);
  EXPECT_NEAR(m.reduced_scattering(), 0.74, 1e-12);
  EXPECT_TRUE(std::isfinite(medium_of_albedo(0, 0.74, 0, 1.3).sigma_a));
}

} // namespace
} // namespace subsurface
