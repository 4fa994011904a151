// The octree over points against brute force.
#include "stdlib/subsurface/octree.h"
#include "stdlib/subsurface/random.h"

#include <gtest/gtest.h>
#include <set>

namespace subsurface {
namespace {

std::vector<Vec3> random_points(size_t n, uint64_t seed) {
  Random random(seed);
  auto unit = [&] { return static_cast<float>(random.unit()); };
  std::vector<Vec3> points;
  for (size_t i = 0; i < n; ++i)
    points.push_back({unit(), 2 * unit(), unit() * unit()});
  return points;
}

TEST(PointOctree, FindsWhatIsWithinARadius) {
  const auto points = random_points(5000, 1);
  const PointOctree tree(points);
  for (Vec3 x : random_points(50, 2))
    for (float radius : {0.0f, 0.05f, 0.3f, 5.0f}) {
      std::set<uint32_t> found, wanted;
      tree.for_each_within(x, radius, [&](uint32_t i, float d2) {
        EXPECT_FLOAT_EQ(d2, length2(points[tree.order()[i]] - x));
        EXPECT_TRUE(found.insert(tree.order()[i]).second);
      });
      for (uint32_t i = 0; i < points.size(); ++i)
        if (length2(x - points[i]) <= radius * radius) wanted.insert(i);
      EXPECT_EQ(found, wanted);
    }
}

TEST(PointOctree, NodesHoldTheirPoints) {
  const auto points = random_points(3000, 3);
  const PointOctree tree(points, 8);
  size_t in_leaves = 0;
  for (const PointOctree::Node& node : tree.nodes()) {
    for (uint32_t i = node.begin; i < node.end; ++i) {
      PointOctree::Node roomy = node;
      roomy.half *= 1.0001f;
      EXPECT_TRUE(roomy.contains(tree.positions()[i]));
    }
    if (node.children == 0) {
      EXPECT_LE(node.end - node.begin, 8u);
      in_leaves += node.end - node.begin;
      continue;
    }
    uint32_t at = node.begin;
    for (uint32_t c = node.first_child; c < node.first_child + node.children; ++c) {
      EXPECT_EQ(tree.nodes()[c].begin, at);
      at = tree.nodes()[c].end;
    }
    EXPECT_EQ(at, node.end);
  }
  EXPECT_EQ(in_leaves, points.size());
  EXPECT_LE(tree.nodes().size(), 2 * points.size());
}

TEST(PointOctree, ExtremePlaces) {
  EXPECT_TRUE(PointOctree(std::vector<Vec3>{}).nodes().empty());
  // All at one place; far apart pairs; the ends of the range of floats.
  const PointOctree same(std::vector<Vec3>(1000, Vec3{1, 2, 3}));
  EXPECT_EQ(same.nodes().size(), 1u);
  std::vector<Vec3> clusters;
  for (int i = 0; i < 100; ++i)
    clusters.push_back(i < 50 ? Vec3{0, 0, 1e-20f * static_cast<float>(i)} : Vec3{1e20f, 1e20f, 0});
  clusters.push_back({3e38f, -3e38f, 3e38f});
  const PointOctree wide(clusters);
  EXPECT_LE(wide.nodes().size(), 2 * clusters.size());
  size_t count = 0;
  wide.for_each_within({0, 0, 0}, 1e-10f, [&](uint32_t, float) { ++count; });
  EXPECT_EQ(count, 50u);
}

TEST(PointOctree, Nearest) {
  std::vector<Vec3> points = random_points(2000, 7);
  const Vec3 place = points[17];
  points.insert(points.end(), 5, place); // equal ones
  const PointOctree tree(points);
  std::vector<PointOctree::Near> near;
  auto probes = random_points(50, 8);
  probes.push_back(place);
  probes.push_back({5, -3, 2});
  for (Vec3 x : probes) {
    std::vector<float> all;
    for (Vec3 p : points)
      all.push_back(length2(x - p));
    std::sort(all.begin(), all.end());
    tree.nearest(x, 9, near);
    ASSERT_EQ(near.size(), 9u);
    for (size_t i = 0; i < near.size(); ++i) {
      EXPECT_EQ(near[i].distance2, all[i]);
      EXPECT_EQ(near[i].distance2, length2(x - tree.positions()[near[i].place]));
      EXPECT_TRUE(i == 0 || near[i - 1].distance2 < near[i].distance2 || near[i - 1].place < near[i].place);
    }
  }
  tree.nearest({}, 10000, near);
  EXPECT_EQ(near.size(), points.size());
  PointOctree().nearest({}, 3, near);
  EXPECT_TRUE(near.empty());
}

TEST(PointOctree, NearAndFarDistances) {
  PointOctree::Node node;
  node.centre = {1, 1, 1};
  node.half = 0.5f;
  EXPECT_EQ(node.near_distance2({1, 1, 1.25f}), 0);
  EXPECT_EQ(node.near_distance2({3, 1, 1}), 2.25f);
  EXPECT_EQ(node.near_distance2({3, 3, 1}), 4.5f);
  EXPECT_EQ(node.far_distance2({1, 1, 1}), 0.75f);
  EXPECT_TRUE(node.contains({1.5f, 1, 1}));
  EXPECT_FALSE(node.contains({1.51f, 1, 1}));
}

} // namespace
} // namespace subsurface
