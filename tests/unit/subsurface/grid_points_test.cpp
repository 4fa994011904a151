// Points from diced grids.
#include "stdlib/subsurface/grid_points.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace subsurface {
namespace {

/// A grid over the unit square whose columns get closer and closer: x = u^2.
PointCloud uneven(size_t n) {
  std::vector<Vec3> p;
  std::vector<Color> e;
  for (size_t v = 0; v <= n; ++v)
    for (size_t u = 0; u <= n; ++u) {
      const float x = static_cast<float>(u) / static_cast<float>(n),
                  y = static_cast<float>(v) / static_cast<float>(n);
      p.push_back({x * x, y, 0});
      e.push_back({x * x, y, 1});
    }
  PointCloud cloud;
  append_grid(cloud, {n + 1, n + 1, p, {}, e, {}});
  return cloud;
}

TEST(GridPoints, OneForEachMicropolygon) {
  const PointCloud cloud = uneven(20);
  EXPECT_EQ(cloud.size(), 400u);
  EXPECT_NEAR(cloud.total_area(), 1, 1e-5);
  EXPECT_EQ(check(cloud), "");
  for (size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(cloud.normal[i].z, 1, 1e-6);
    EXPECT_NEAR(cloud.irradiance[i].x, cloud.position[i].x, 1e-6);
  }
}

TEST(GridPoints, CollapsedMicropolygonsAndGivenNormals) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 1, 0}};
  const std::vector<Vec3> n(6, Vec3{0, 0, -2});
  PointCloud cloud;
  append_grid(cloud, {3, 2, p, n, {}, {}});
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_EQ(cloud.normal[0], (Vec3{0, 0, -1}));
  EXPECT_EQ(cloud.position[0], (Vec3{0.5f, 0.5f, 0}));
  append_grid(cloud, {0, 0, {}, {}, {}, {}});
  EXPECT_EQ(cloud.size(), 1u);
}

// Middles of flat micropolygons lie below a ball; normals tell by how much.
TEST(GridPoints, PointsOfACurvedSurfaceAreOnIt) {
  constexpr size_t kN = 12;
  std::vector<Vec3> p, n;
  for (size_t v = 0; v < kN; ++v)
    for (size_t u = 0; u < kN; ++u) {
      const float a = 0.1f * static_cast<float>(u), b = 1 + 0.1f * static_cast<float>(v);
      n.push_back({std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b)});
      p.push_back(n.back() * 5);
    }
  PointCloud flat, bulging, wild;
  append_grid(flat, {kN, kN, p, {}, {}, {}});
  append_grid(bulging, {kN, kN, p, n, {}, {}});
  for (size_t i = 0; i < flat.size(); ++i) {
    EXPECT_LT(length(flat.position[i]), 4.994f);
    EXPECT_NEAR(length(bulging.position[i]), 5, 1e-4f);
  }
  // Shading normals may be anything.
  for (size_t i = 0; i < n.size(); ++i)
    n[i] = i % 2 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  append_grid(wild, {kN, kN, p, n, {}, {}});
  for (size_t i = 0; i < flat.size(); ++i)
    EXPECT_LT(length(wild.position[i] - flat.position[i]), 0.1f); // of cells 0.7 across
}

TEST(GridPoints, ThinnedPointsStandForEqualAreas) {
  PointCloud cloud = uneven(200);
  cloud.channels.push_back({"x", {}});
  cloud.channels[0].name = "height";
  for (Vec3 p : cloud.position)
    cloud.channels[0].values.push_back(p.y);
  const PointCloud thinned = thin(cloud, 400);
  EXPECT_EQ(thinned.size(), 400u);
  EXPECT_NEAR(thinned.total_area(), 1, 1e-5);
  size_t columns[4] = {};
  double flux = 0;
  for (size_t i = 0; i < thinned.size(); ++i) {
    EXPECT_NEAR(thinned.area[i], 1.0 / 400, 1.0 / 2000);
    ++columns[static_cast<size_t>(thinned.position[i].x * 3.9999f)];
    flux += static_cast<double>(thinned.irradiance[i].x * thinned.area[i]);
    EXPECT_NEAR(thinned.channels[0].values[i], thinned.position[i].y, 0.02);
  }
  for (size_t count : columns) // evenly by area, though the grid has half of its points in the first quarter
    EXPECT_NEAR(static_cast<double>(count), 100, 4);
  EXPECT_NEAR(flux, 0.5, 2e-3); // as it was
}

TEST(GridPoints, ThinningKeepsLargePoints) {
  PointCloud cloud;
  for (int i = 0; i < 5; ++i) {
    cloud.position.push_back({static_cast<float>(i), 0, 0});
    cloud.area.push_back(i == 0 ? 10.0f : 1.0f);
  }
  const PointCloud thinned = thin(cloud, 3);
  EXPECT_NEAR(thinned.total_area(), 14, 1e-5);
  EXPECT_EQ(thinned.size(), 3u);
  EXPECT_EQ(*std::max_element(thinned.area.begin(), thinned.area.end()), 10.0f); // more than two shares
  EXPECT_EQ(thin(cloud, 1000).size(), cloud.size());
  EXPECT_EQ(thin(cloud, 0).size(), 0u);
  EXPECT_EQ(thin({}, 10).size(), 0u);
}

} // namespace
} // namespace subsurface
