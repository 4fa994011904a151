// Sparser clouds, and several densities together.
#include "stdlib/subsurface/diffusion_tree.h"
#include "tests/unit/subsurface/surfaces.h"

#include <gtest/gtest.h>

namespace subsurface::test {
namespace {

TEST(CloudLevels, SparserCloudsKeepAreaAndLight) {
  PointCloud cloud = ball(20000, 10);
  cloud.albedo.assign(cloud.size(), {0.8f, 0.4f, 0.2f});
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  size_t before = cloud.size() + 1;
  for (float size : {0.0f, 0.5f, 2.0f, 8.0f}) {
    const PointCloud sparse = tree->coarser(size);
    EXPECT_EQ(check(sparse), "");
    EXPECT_LT(sparse.size(), before);
    before = sparse.size();
    EXPECT_NEAR(sparse.total_area() / cloud.total_area(), 1, 1e-4);
    double flux = 0, wanted = 0;
    for (size_t i = 0; i < sparse.size(); ++i)
      flux += static_cast<double>(sparse.irradiance[i].y * sparse.area[i]);
    for (size_t i = 0; i < cloud.size(); ++i)
      wanted += static_cast<double>(cloud.irradiance[i].y * cloud.area[i]);
    EXPECT_NEAR(flux / wanted, 1, 1e-4);
    EXPECT_NEAR(sparse.albedo[0].y, 0.4f, 1e-4f);
    EXPECT_NEAR(length(sparse.normal[0]), 1, 1e-4f);
  }
  EXPECT_LT(before, 100u);
}

TEST(CloudLevels, FewerSamplesAtNearlyTheSameResult) {
  const PointCloud cloud = ball(40000, 20);
  const auto fine = DiffusionTree::build(cloud);
  ASSERT_TRUE(fine);
  const auto middle = DiffusionTree::build(fine->coarser(0.7f)),
             coarse = DiffusionTree::build(fine->coarser(2.5f));
  const DiffusionMaterial marble(dipole_of(medium_of(*find_material("marble"))));
  const CloudLevels levels({{&*fine, &marble, 3}, {&*middle, &marble, 10}, {&*coarse, &marble, 0}});
  std::vector<Vec3> x;
  for (size_t i = 0; i < 50; ++i)
    x.push_back(cloud.position[i * 400]);
  std::vector<Color> together(x.size()), exact(x.size());
  LookupCount few, all;
  levels.exitance(x, 0, 0.2f, together, &few);
  fine->exitance(marble, x, {0, {}}, exact, &all);
  double worst = 0;
  for (size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, static_cast<double>(std::abs(together[i][c] / exact[i][c] - 1)));
  EXPECT_LT(worst, 0.03);
  EXPECT_LT(few.samples, all.samples / 8);
}

} // namespace
} // namespace subsurface::test
