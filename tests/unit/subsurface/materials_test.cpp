// The measured materials: the table's own consistency, names, units.
#include "stdlib/subsurface/materials.h"

#include <gtest/gtest.h>

namespace subsurface {
namespace {

TEST(Materials, DiffuseReflectanceFollowsFromTheCoefficients) {
  int within = 0, equal = 0;
  for (const MeasuredMaterial& m : measured_materials()) {
    const MediumRgb medium = medium_of(m, 0.5);
    for (size_t c = 0; c < 3; ++c) {
      const double off = std::abs(appearance_of(medium[c]).albedo - m.reflectance[c]);
      within += off <= 0.01;
      equal += off <= 0.005;
      if (off > 0.01) {
        EXPECT_EQ(m.name, "Chicken1");
        EXPECT_EQ(c, 2u);
        EXPECT_NEAR(off, 0.0264, 1e-4);
      }
    }
  }
  EXPECT_EQ(measured_materials().size(), 12u);
  EXPECT_EQ(within, 35);
  EXPECT_EQ(equal, 26);
}

TEST(Materials, ByName) {
  auto marble = find_material("marble");
  ASSERT_TRUE(marble);
  EXPECT_EQ(marble->name, "Marble");
  EXPECT_EQ(marble->eta, 1.5);
  EXPECT_EQ(marble->absorption[1], 0.0041);
  auto skin = find_material("skln1");
  ASSERT_FALSE(skin);
  EXPECT_EQ(skin.error(), "unknown material 'skln1'; did you mean 'skin1'?");
  auto gold = find_material("gold plate");
  ASSERT_FALSE(gold);
  EXPECT_EQ(gold.error(),
            "unknown material 'gold plate'; there are: apple, chicken1, chicken2, cream, ketchup, marble, "
            "potato, skimmilk, skin1, skin2, spectralon, wholemilk");
}

TEST(Materials, UnitsAndAnisotropy) {
  const MeasuredMaterial marble = *find_material("Marble");
  const MediumRgb mm = medium_of(marble, 0.3), cm = medium_of(marble, 0.3, 0.1);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(mm[c].reduced_scattering(), marble.reduced_scattering[c], 1e-12);
    EXPECT_NEAR(cm[c].sigma_a, 10 * mm[c].sigma_a, 1e-12);
    EXPECT_NEAR(cm[c].diffuse_mean_free_path(), mm[c].diffuse_mean_free_path() / 10, 1e-9);
    EXPECT_NEAR(dipole_of(mm)[c].total(), dipole_of(cm)[c].total(), 1e-12);
  }
}

TEST(Materials, FromColours) {
  const MediumRgb m = medium_of({0.8f, 0.4f, 0.2f}, {3, 1.5f, 0.7f}, 0, 1.3);
  EXPECT_NEAR(appearance_of(m[0]).albedo, 0.8, 1e-6);
  EXPECT_NEAR(appearance_of(m[2]).albedo, 0.2, 1e-6);
  EXPECT_NEAR(m[1].diffuse_mean_free_path(), 1.5, 1e-6);
}

} // namespace
} // namespace subsurface
