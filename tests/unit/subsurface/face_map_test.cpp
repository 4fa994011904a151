// Scatter maps by faces: the same sums as with an octree and as one by one, in less memory, and when most of
// the samples are on disk.
#include "stdlib/subsurface/scatter_cache.h"
#include "tests/unit/subsurface/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <thread>

namespace subsurface::test {
namespace {

/// A ball whose points are on the faces of a cube round it, n by n on each side.
PointCloud faced_ball(size_t points, int n) {
  PointCloud cloud = ball(points, 2);
  cloud.channels.push_back({ScatterMap::kFaceChannel, {}});
  for (Vec3 p : cloud.position) {
    const Vec3 a{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    auto cell = [&](int c) {
      const float t = (p[c % 3] / a[axis] + 1) / 2;
      return std::clamp(static_cast<int>(t * static_cast<float>(n)), 0, n - 1);
    };
    const int side = 2 * axis + (p[axis] > 0);
    cloud.channels[0].values.push_back(static_cast<float>((side * n + cell(axis + 1)) * n + cell(axis + 2)));
  }
  return cloud;
}

size_t bytes_of_samples(const PointCloud& cloud) {
  return cloud.size() * 7 * sizeof(float);
}

/// The sum of areas of the samples within D of x, and how many there are.
struct Near {
  double area = 0;
  size_t count = 0;
};
Near near(const ScatterMap& map, Vec3 x, float D) {
  Near out;
  ScatterReader reader(map);
  reader.for_each_within(x, D, [&](uint32_t i, float d2) {
    const ScatterSample s = reader.sample(i);
    EXPECT_EQ(d2, length2(x - s.position));
    out.area += static_cast<double>(s.area);
    ++out.count;
  });
  return out;
}

TEST(FaceMap, FindsTheSamplesThatAnOctreeFinds) {
  const PointCloud cloud = faced_ball(8000, 5);
  const auto tree = ScatterMap::build(cloud),
             faces = ScatterMap::build(cloud, std::make_shared<BlockPool>(size_t{1} << 30));
  ASSERT_TRUE(tree && faces);
  EXPECT_FALSE(tree->faces());
  ASSERT_TRUE(faces->faces());
  EXPECT_EQ(faces->faces()->faces(), 150u);
  EXPECT_EQ(faces->size(), tree->size());
  for (Vec3 x : {Vec3{0, 0, 2}, Vec3{1.2f, 1.2f, 1.1f}, Vec3{0, 0, 2.3f}, Vec3{0, 0, 0}, Vec3{5, 5, 5}})
    for (float D : {0.01f, 0.3f, 1.0f, 2.5f, 20.0f}) {
      const Near a = near(*tree, x, D), b = near(*faces, x, D);
      EXPECT_EQ(a.count, b.count) << D;
      EXPECT_NEAR(a.area, b.area, 1e-5 * (a.area + 1));
    }
}

TEST(FaceMap, ListsHaveTheFacesWhoseBoxesAreNear) {
  const PointCloud cloud = faced_ball(8000, 5);
  const auto map = ScatterMap::build(cloud, std::make_shared<BlockPool>(size_t{1} << 30));
  const FaceMap& faces = *map->faces();
  for (uint32_t f = 0; f < faces.faces(); f += 7) {
    const auto list = faces.near(f, 0.5f);
    EXPECT_THAT(list, ::testing::Contains(f));
    for (uint32_t g = 0; g < faces.faces(); ++g) {
      const float d = std::sqrt(faces.box(f).distance2(faces.box(g)));
      const bool listed = std::find(list.begin(), list.end(), g) != list.end();
      EXPECT_TRUE(listed || d > 0.5f) << f << " " << g;
      EXPECT_FALSE(listed && d > 0.75f) << f << " " << g;
    }
    const FaceBox box = faces.box(f);
    EXPECT_EQ(box.distance2(box.low * 0.5f + box.high * 0.5f), 0);
  }
}

// What there is beside the samples depends on the mesh alone; an octree grows with them.
TEST(FaceMap, TakesMemoryByTheMeshNotByTheSamples) {
  auto beside_samples = [](size_t points, bool by_faces) {
    const auto map = ScatterMap::build(faced_ball(points, 5),
                                       by_faces ? std::make_shared<BlockPool>(size_t{1} << 30) : nullptr);
    for (uint32_t f = 0; by_faces && f < map->faces()->faces(); ++f)
      static_cast<void>(map->faces()->near(f, 0.3f));
    return map->bytes();
  };
  const auto few = static_cast<double>(beside_samples(8000, true));
  EXPECT_NEAR(static_cast<double>(beside_samples(64000, true)), few, 0.1 * few); // boxes are a little wider
  EXPECT_GT(beside_samples(64000, false), 6 * beside_samples(8000, false));
  EXPECT_LT(beside_samples(64000, true), beside_samples(64000, false) / 20);
}

TEST(BlockPool, KeepsWhatWasUsedLastAndReadsTheRestBack) {
  BlockPool pool(3 * 100 * sizeof(float));
  std::vector<BlockPool::Block> blocks;
  for (int i = 0; i < 10; ++i)
    blocks.emplace_back(100, static_cast<float>(i));
  const auto expected = blocks;
  EXPECT_EQ(pool.add(std::move(blocks)), 0u);
  EXPECT_EQ(pool.written(), 7u);
  EXPECT_EQ(pool.bytes(), 3 * 100 * sizeof(float));
  for (uint32_t i : {9, 8, 7})
    EXPECT_EQ(*pool.get(i), expected[i]);
  EXPECT_EQ(pool.read_back(), 0u);
  EXPECT_EQ(*pool.get(0), expected[0]); // 9 goes
  EXPECT_EQ(*pool.get(8), expected[8]);
  EXPECT_EQ(pool.read_back(), 1u);
  EXPECT_EQ(*pool.get(9), expected[9]);
  EXPECT_EQ(pool.read_back(), 2u);
  EXPECT_EQ(pool.written(), 9u); // 9 and 7: those that were on disk are not written again
  for (uint32_t i = 0; i < 10; ++i)
    EXPECT_EQ(*pool.get(i), expected[i]);
  EXPECT_LE(pool.most_bytes_held(), 4 * 100 * sizeof(float));
  EXPECT_EQ(pool.problem(), "");
  pool.set_limit(0);
  EXPECT_EQ(pool.bytes(), 0u);
  pool.remove(0, 10);
}

// The whole protocol with a twentieth of the samples in memory, in four threads.
TEST(FaceMap, GridsShareMapsThatAreMostlyOnDisk) {
  const PointCloud cloud = faced_ball(20000, 8);
  PointCloud plain = cloud;
  plain.channels.clear();
  ScatterMaps maps(
      [&](const std::string& name) -> slvm::Result<PointCloud> { return name == "faces" ? cloud : plain; });
  const size_t limit = bytes_of_samples(cloud) / 20;
  maps.pool().set_limit(limit);
  constexpr float kD = 0.25f;
  auto shade = [&](const std::string& name, size_t part, std::vector<Color>& out) {
    ScatterGrid grid(maps);
    for (size_t first = part; first < 40; first += 4) {
      ASSERT_TRUE(grid.read_map(name));
      for (size_t i = 0; i < 50; ++i)
        grid.add_grid_point(cloud.position[400 * first + 8 * i], kD);
      Vec3 P, N;
      float area = 0;
      while (grid.get_sample(P, N, area))
        grid.save_irradiance({P.x + 3, N.z * N.z, area});
      for (uint32_t i = 0; i < 50; ++i) {
        const size_t at = 400 * first + 8 * i;
        out[50 * first + i] = grid.scatter(i, cloud.position[at], cloud.normal[at], kD, {1, 1, 1});
      }
    }
  };
  std::vector<Color> by_tree(2000), by_faces(2000);
  for (size_t part = 0; part < 4; ++part)
    shade("tree", part, by_tree);
  std::vector<std::thread> threads;
  for (size_t part = 0; part < 4; ++part)
    threads.emplace_back([&, part] { shade("faces", part, by_faces); });
  for (std::thread& t : threads)
    t.join();
  for (size_t i = 0; i < by_tree.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(by_faces[i][c], by_tree[i][c], 1e-5f * by_tree[i][c] + 1e-7f) << i;
  EXPECT_GT(maps.pool().read_back(), 100u);
  EXPECT_LE(maps.pool().most_bytes_held(), limit + bytes_of_samples(cloud) / 100);
  EXPECT_EQ(maps.pool().problem(), "");
}

TEST(ScatterMaps, AFrameSeesFilesThatHaveChanged) {
  int state = 1, loads = 0;
  ScatterMaps maps(
      [&](const std::string&) -> slvm::Result<PointCloud> {
        ++loads;
        if (state == 0) return slvm::Error{"gone"};
        return ball(static_cast<size_t>(10 * state), 1);
      },
      [&](const std::string&) {
        return std::vector<FileStamp>{{static_cast<uint64_t>(state), 0, 0}};
      });
  ASSERT_TRUE(maps.get("a"));
  (*maps.get("a"))->save(0, {1, 1, 1});
  maps.forget_light();
  EXPECT_EQ((*maps.get("a"))->lit(), 0u);
  EXPECT_EQ((*maps.get("a"))->map().size(), 10u);
  EXPECT_EQ(loads, 1);
  state = 2;
  EXPECT_EQ((*maps.get("a"))->map().size(), 10u); // until the next frame
  maps.forget_light();
  EXPECT_EQ((*maps.get("a"))->map().size(), 20u);
  EXPECT_EQ(loads, 2);
  state = 0;
  maps.forget_light();
  EXPECT_EQ(maps.get("a").error(), "gone");
  state = 3;
  maps.forget_light();
  EXPECT_EQ((*maps.get("a"))->map().size(), 30u);
}

} // namespace
} // namespace subsurface::test
