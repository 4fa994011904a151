// diffusion(): the same as the library's lookups, in every form.
#include "stdlib/subsurface/diffusion_tree.h"
#include "tests/dso/with_plugin.h"
#include "tests/unit/subsurface/surfaces.h"

namespace subsurface::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Diffusion : public WithPlugin {
protected:
  void SetUp() override {
    cloud_ = ball(2000, 1.5f);
    for (size_t i = 0; i < cloud_.size(); ++i)
      cloud_.albedo.push_back({0.9f, 0.3f + 0.2f * cloud_.position[i].x, 0.5f});
    save("lit.ply", cloud_);
  }
  /// On a row of 4 points from (0, 0, 1) to (1, 0, 1), with Fdt taken out.
  void expect(const std::string& call, const DiffusionMaterial& material, double eta, float epsilon,
              const DiffusionTree& tree) {
    const auto got = run("Ci = " + call + ";", 4);
    EXPECT_THAT(messages(), IsEmpty());
    for (size_t i = 0; i < got.size(); ++i) {
      const Vec3 x{static_cast<float>(i) / 3, 0, 1};
      const Color all = tree.exitance(material, x, {epsilon, {}});
      for (int c = 0; c < 3; ++c)
        EXPECT_FLOAT_EQ(got[i][c], all[c] / static_cast<float>(1 - diffuse_fresnel(eta))) << call << i;
      EXPECT_GT(got[i].x, 0);
    }
  }
  PointCloud cloud_;
};

TEST_F(Diffusion, OfAMaterialByName) {
  const DiffusionTree tree = *DiffusionTree::build(cloud_);
  const DiffusionMaterial skin(dipole_of(medium_of(*find_material("skin1"), 0, 0.25)));
  expect("diffusion(P, " + quoted("lit.ply") + ", \"skin1\", 0.25, 0.02)", skin, 1.3, 0.02f, tree);
}

TEST_F(Diffusion, OfAnAppearance) {
  const DiffusionTree tree = *DiffusionTree::build(cloud_);
  const DiffusionMaterial wax(dipole_of(medium_of(Color{0.8f, 0.5f, 0.2f}, Color{0.3f, 0.2f, 0.1f}, 0, 1.4)));
  expect("diffusion(P, " + quoted("lit.ply") + ", color(.8, .5, .2), color(.3, .2, .1), 1.4, 0)", wax, 1.4, 0,
         tree);
}

TEST_F(Diffusion, OfTheColoursOfThePoints) {
  const DiffusionTree tree = *DiffusionTree::build(cloud_);
  const DiffusionMaterial painted(tree, {0.3f, 0.2f, 0.1f}, 1.3);
  expect("diffusion(P, " + quoted("lit.ply") + ", color(.3, .2, .1), 1.3, 0.05)", painted, 1.3, 0.05f, tree);
}

TEST_F(Diffusion, OfLevels) {
  PointCloud coarse = DiffusionTree::build(cloud_)->coarser(0.3f);
  save("coarse.ply", coarse);
  const auto got =
      run("string c[2] = {" + quoted("lit.ply") + "," + quoted("coarse.ply") +
              "}; float r[1] = {.5}; Ci = diffusion(P, c, r, color(.8, .5, .2), color(.3), 1.3, 0);",
          4);
  EXPECT_THAT(messages(), IsEmpty());
  const DiffusionTree fine = *DiffusionTree::build(cloud_), far = *DiffusionTree::build(coarse);
  const DiffusionMaterial wax(dipole_of(medium_of(Color{0.8f, 0.5f, 0.2f}, Color{0.3f, 0.3f, 0.3f}, 0, 1.3)));
  const CloudLevels levels({{&fine, &wax, 0.5f}, {&far, &wax, 0}});
  for (size_t i = 0; i < got.size(); ++i) {
    const Vec3 x[] = {{static_cast<float>(i) / 3, 0, 1}};
    Color all[1];
    levels.exitance(x, 0, 0.2f, all);
    EXPECT_FLOAT_EQ(got[i].x, all[0].x / static_cast<float>(1 - diffuse_fresnel(1.3)));
  }
}

TEST_F(Diffusion, OfLevelsByTheColoursOfTheirPoints) {
  PointCloud coarse = DiffusionTree::build(cloud_)->coarser(0.3f);
  save("coarse.ply", coarse);
  const auto got = run("string c[2] = {" + quoted("lit.ply") + "," + quoted("coarse.ply") +
                           "}; float r[1] = {.5}; Ci = diffusion(P, c, r, color(.3, .2, .1), 1.3, 0);",
                       4);
  EXPECT_THAT(messages(), IsEmpty());
  const DiffusionTree fine = *DiffusionTree::build(cloud_), far = *DiffusionTree::build(coarse);
  const DiffusionMaterial painted(fine, {0.3f, 0.2f, 0.1f}, 1.3), paler(far, {0.3f, 0.2f, 0.1f}, 1.3);
  const CloudLevels levels({{&fine, &painted, 0.5f}, {&far, &paler, 0}});
  for (size_t i = 0; i < got.size(); ++i) {
    const Vec3 x[] = {{static_cast<float>(i) / 3, 0, 1}};
    Color all[1];
    levels.exitance(x, 0, 0.2f, all);
    for (int c = 0; c < 3; ++c)
      EXPECT_FLOAT_EQ(got[i][c], all[0][c] / static_cast<float>(1 - diffuse_fresnel(1.3)));
  }
}

// V6 of the course's figures: in even light what comes back is the albedo.
TEST_F(Diffusion, AFlatPlateInEvenLightReturnsItsAlbedo) {
  save("plate.ply", plate(300, 30, {1, 1, 2}));
  const auto got = run("Ci = diffusion(P - point(0, 0, 1), " + quoted("plate.ply") +
                           ", color(.8, .5, .2), color(2, 1, 1), 1.3, .02);",
                       3);
  for (const Color& c : got) {
    EXPECT_NEAR(c.x, 0.8f, 0.008f);
    EXPECT_NEAR(c.y, 0.5f, 0.005f);
    EXPECT_NEAR(c.z, 0.4f, 0.004f);
  }
}

TEST_F(Diffusion, WhatCannotBeLookedUpIsBlackAndSaysWhy) {
  PointCloud dark = cloud_;
  dark.irradiance.clear();
  save("dark.ply", dark);
  auto complaint = [&](const std::string& arguments) {
    EXPECT_THAT(run("Ci = 7; Ci = diffusion(P, " + arguments + ");", 2), Each(Color{}));
    const auto told = new_messages();
    EXPECT_EQ(told.size(), 1u);
    return told.empty() ? "" : told[0];
  };
  const std::string lit = quoted("lit.ply");
  EXPECT_THAT(complaint(quoted("none.ply") + ", \"skin1\", 1, 0"), HasSubstr("none.ply"));
  EXPECT_THAT(complaint(quoted("dark.ply") + ", \"skin1\", 1, 0"),
              HasSubstr("dark.ply: the cloud has no irradiance: light it first"));
  EXPECT_THAT(complaint(lit + ", \"skin3\", 1, 0"), HasSubstr("skin3"));
  EXPECT_THAT(complaint(lit + ", \"skin1\", 0, 0"), HasSubstr("diffusion(): mm is 0, it must be above 0"));
  EXPECT_THAT(complaint(lit + ", color(1), color(1, 0, 1), 1.3, 0"),
              HasSubstr("diffusion(): freepath is 0, it must be above 0"));
  EXPECT_THAT(complaint(lit + ", color(1), -1, 0"), HasSubstr("diffusion(): eta is -1, it must be above 0"));
  run("string c[2] = {" + lit + "," + lit +
          "}; float r[1] = {0}; Ci = diffusion(P, c, r, color(1), color(1), 1.3, 0);",
      1);
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("2 clouds need 1 radii that rise, from fine to coarse")));
}

} // namespace
} // namespace subsurface::test
