// Clouds that shaders light.
#include "stdlib/subsurface/parallel.h"
#include "stdlib/subsurface/point_cache.h"
#include "tests/temp_folder.h"
#include "tests/unit/subsurface/surfaces.h"

#include <gtest/gtest.h>
#include <limits>

namespace subsurface::test {
namespace {

/// The shader of the course, in the calling thread: two lights for each point.
void bake(PointCache& cache) {
  for (int64_t i = cache.next_index(); i >= 0; i = cache.next_index()) {
    const auto index = static_cast<size_t>(i);
    const Vec3 N = cache.normal(index), P = cache.position(index);
    for (Vec3 L : {Vec3{0, 0, 1}, Vec3{1, 0, 0}})
      if (const float cosine = dot(L, N); cosine > 0) cache.accumulate(index, Color{1, 0.5f, P.y} * cosine);
  }
}

TEST(PointCache, LitByManyThreadsAndWritten) {
  const anemone::test::TempFolder folder;
  const PointCloud cloud = ball(5000, 3);
  const std::string unlit = (folder / "skin.ply").string(), lit = (folder / "lit.ply").string();
  ASSERT_TRUE(write_point_cloud(unlit, cloud));
  PointCaches caches;
  parallel_ranges(6, 6, [&](size_t, size_t) {
    auto cache = caches.open(unlit);
    ASSERT_TRUE(cache);
    bake(**cache);
  });
  const auto cache = *caches.open(unlit);
  EXPECT_EQ(cache->next_index(), -1);
  ASSERT_TRUE(cache->write(lit));
  const auto again = read_point_cloud(lit);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->area, cloud.area);
  for (size_t i = 0; i < cloud.size(); ++i) {
    const float cosines = std::max(cloud.normal[i].z, 0.0f) + std::max(cloud.normal[i].x, 0.0f);
    EXPECT_NEAR(again->irradiance[i].x, cosines, 1e-6f);
    EXPECT_NEAR(again->irradiance[i].z, cosines * cloud.position[i].y, 1e-5f);
  }
  cache->restart();
  EXPECT_EQ(cache->next_index(), 0);
  EXPECT_EQ(cache->lit().irradiance[17], Color{});
}

TEST(PointCache, WhatIsNoPointOrNoLightIsLeftOut) {
  PointCache cache(plate(2, 1, {9, 9, 9}));
  cache.accumulate(4, {1, 1, 1});
  cache.accumulate(1, {std::numeric_limits<float>::infinity(), 0, 0});
  cache.accumulate(1, {1, 2, 3});
  EXPECT_EQ(cache.lit().irradiance, (std::vector<Color>{{}, {1, 2, 3}, {}, {}}));
  PointCaches caches;
  EXPECT_EQ(caches.open("nowhere.ply").error(), "cannot open 'nowhere.ply': No such file or directory");
}

} // namespace
} // namespace subsurface::test
