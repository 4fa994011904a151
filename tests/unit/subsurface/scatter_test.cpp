// The scattering of "Finding Nemo": kernel, maps, and the protocol of grids.
#include "stdlib/subsurface/parallel.h"
#include "stdlib/subsurface/scatter_cache.h"
#include "tests/unit/subsurface/numeric.h"
#include "tests/unit/subsurface/surfaces.h"

#include <gtest/gtest.h>
#include <numbers>

namespace subsurface::test {
namespace {

Color light_at(Vec3 P, Vec3 N) {
  return {0.5f + 0.1f * P.x, std::max(N.z, 0.0f), 0.25f};
}

/// Shades one grid the way a renderer runs the course's shader: line by line over all points. Returns the
/// results and adds the number of points on which lights ran.
std::vector<Color> shade(ScatterGrid& grid, std::span<const Vec3> points, float D, size_t& light_runs) {
  EXPECT_TRUE(grid.read_map("skin"));
  std::vector<uint32_t> index;
  for (Vec3 p : points)
    index.push_back(grid.add_grid_point(p, D));
  std::vector<char> running(points.size(), 1);
  for (bool any = true; any;) {
    std::vector<Vec3> P(points.size()), N(points.size());
    any = false;
    for (size_t i = 0; i < points.size(); ++i) {
      float area = 0;
      running[i] = running[i] && grid.get_sample(P[i], N[i], area);
      any = any || running[i];
    }
    if (any) light_runs += points.size(); // for the whole grid, however few need it
    for (size_t i = 0; i < points.size(); ++i)
      if (running[i]) grid.save_irradiance(light_at(P[i], N[i]));
  }
  std::vector<Color> out;
  for (size_t i = 0; i < points.size(); ++i)
    out.push_back(grid.scatter(index[i], points[i], normalize(points[i]), D, {1, 1, 1}));
  return out;
}

/// All samples lit first, then summed one by one.
Color two_passes(const PointCloud& cloud, Vec3 P, Vec3 N, float D) {
  double sum[3] = {};
  for (size_t i = 0; i < cloud.size(); ++i) {
    const float r = length(P - cloud.position[i]);
    if (r > D) continue;
    const double y = static_cast<double>(r / D);
    const double T =
        (1 - (3 * y * y - 2 * y * y * y)) / (3 * static_cast<double>(D * D) * std::numbers::pi / 10);
    const Vec3 L = (P - cloud.position[i]) * (1 / D);
    const double B = std::max(0.0, 1 - (1 - static_cast<double>(dot(N, cloud.normal[i]))) *
                                           (1 - static_cast<double>(dot(N, L))) / 2);
    const Color E = light_at(cloud.position[i], cloud.normal[i]);
    for (int c = 0; c < 3; ++c)
      sum[c] += static_cast<double>(E[c] * cloud.area[i]) * T * B;
  }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

void expect_near(Color a, Color b) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(a[c], b[c], 1e-4f * std::abs(b[c]) + 1e-6f);
}

TEST(Scatter, KernelIntegratesToOneOverThePlane) {
  for (float D : {0.1f, 2.5f, 40.0f}) {
    auto ring = [&](double r) {
      return 2 * std::numbers::pi * r * static_cast<double>(scatter_transmission(static_cast<float>(r), D));
    };
    EXPECT_NEAR(integral(ring, 0, static_cast<double>(D)), 1, 1e-5);
    EXPECT_EQ(scatter_transmission(D, D), 0);
  }
  // 1 - smoothstep(0, D, r) has the integral 3 D^2 pi/10.
  EXPECT_NEAR(static_cast<double>(1 / scatter_transmission(0, 2.5f)), 5.890486, 1e-5);
  EXPECT_EQ(scatter_transmission(1, 0), 0);
}

TEST(Scatter, BounceAttenuation) {
  const Vec3 up{0, 0, 1}, side{1, 0, 0}, down{0, 0, -1}, o;
  EXPECT_EQ(bounce_attenuation({3, 4, 0}, o, up, up, 10), 1);   // equal normals
  EXPECT_EQ(bounce_attenuation(o, o, up, side, 1), 0.5f);       // N.Ni = 0, L = 0
  EXPECT_EQ(bounce_attenuation({0, 0, -1}, o, up, side, 1), 0); // N.L = -1
  EXPECT_EQ(bounce_attenuation({0, 0, -1}, o, up, down, 1), 0); // -1 as printed
  EXPECT_EQ(bounce_attenuation({0, 0, 1}, o, up, down, 1), 1);  // through a thin sheet
  EXPECT_FLOAT_EQ(bounce_attenuation({0, 0, -0.5f}, o, up, side, 1), 0.25f);
}

TEST(Scatter, BrightnessDoesNotDependOnTheDistance) {
  const PointCloud cloud = plate(200, 40, {});
  ScatterMaps maps([&](const std::string&) { return cloud; });
  ScatterGrid grid(maps);
  const std::vector<Vec3> points{{0.01f, 0.02f, 0}};
  for (float D : {2.0f, 7.0f}) {
    ASSERT_TRUE(grid.read_map("skin"));
    const uint32_t index = grid.add_grid_point(points[0], D);
    Vec3 P, N;
    float area;
    while (grid.get_sample(P, N, area))
      grid.save_irradiance({1, 1, 1});
    EXPECT_NEAR(grid.scatter(index, points[0], {0, 0, 1}, D, {1, 1, 1}).x, 1, 0.002) << D;
  }
}

TEST(Scatter, GridCountingGivesTheSameAsTwoPasses) {
  const PointCloud cloud = ball(3000, 2);
  ScatterMaps maps([&](const std::string&) { return cloud; });
  ScatterGrid grid(maps);
  size_t light_runs = 0;
  std::vector<Vec3> points;
  for (size_t i = 0; i < cloud.size(); i += 7) // no points of the map
    points.push_back(normalize(cloud.position[i] + Vec3{0.05f, 0.02f, 0}) * 2);
  for (size_t at = 0; at < points.size(); at += 60) {
    const auto part = std::span(points).subspan(at, std::min<size_t>(60, points.size() - at));
    const auto results = shade(grid, part, 0.4f, light_runs);
    for (size_t i = 0; i < part.size(); ++i)
      expect_near(results[i], two_passes(cloud, part[i], normalize(part[i]), 0.4f));
  }
  const auto map = *maps.get("skin");
  EXPECT_EQ(map->lit(), cloud.size());
  EXPECT_EQ(map->duplicates(), 0u);
  EXPECT_LE(light_runs, cloud.size() + 60); // each sample once, all passes full but the last
}

TEST(Scatter, PassesAreFilledUp) {
  // 220 points that need 3 samples: 220 are lit in one pass.
  PointCloud cloud = ball(1000, 2);
  ScatterMaps maps([&](const std::string&) { return cloud; });
  ScatterGrid grid(maps);
  ASSERT_TRUE(grid.read_map("skin"));
  for (int i = 0; i < 220; ++i)
    grid.add_grid_point(cloud.position[500] * 1.001f, 0.13f);
  Vec3 P, N;
  float area;
  size_t count = 0;
  while (grid.get_sample(P, N, area))
    grid.save_irradiance({1, 1, 1}), ++count;
  EXPECT_EQ(count, 220u);
  EXPECT_EQ((*maps.get("skin"))->lit(), 220u);
  // What is needed is there now: no pass at all.
  ASSERT_TRUE(grid.read_map("skin"));
  grid.add_grid_point(cloud.position[500], 0.1f);
  EXPECT_FALSE(grid.get_sample(P, N, area));
}

TEST(Scatter, LightComesBackInTheOrderOfTheSamples) {
  const PointCloud cloud = plate(4, 4, {});
  ScatterMaps maps([&](const std::string&) { return cloud; });
  ScatterGrid grid(maps);
  ASSERT_TRUE(grid.read_map("skin"));
  const uint32_t index = grid.add_grid_point({}, 100);
  std::vector<Vec3> handed(16);
  Vec3 N;
  float area;
  for (Vec3& P : handed)
    ASSERT_TRUE(grid.get_sample(P, N, area));
  for (Vec3 P : handed)
    grid.save_irradiance({P.x, 0, 0});
  grid.save_irradiance({1e9f, 0, 0}); // one too many: nobody's
  const auto map = *maps.get("skin");
  for (size_t i = 0; i < 16; ++i)
    EXPECT_EQ(map->irradiance(i).x, map->map().position(i).x);
  EXPECT_NEAR(grid.scatter(index, {}, {0, 0, 1}, 100, {1, 1, 1}).x, 0, 1e-6);
}

TEST(Scatter, ManyThreadsGetTheSame) {
  const PointCloud cloud = ball(4000, 2);
  ScatterMaps maps([&](const std::string&) { return cloud; });
  std::vector<Color> results(cloud.size());
  parallel_ranges(40, 8, [&](size_t begin, size_t end) {
    ScatterGrid grid(maps);
    size_t runs = 0;
    for (size_t g = begin; g < end; ++g) {
      const auto part = shade(grid, std::span(cloud.position).subspan(g * 100, 100), 0.3f, runs);
      std::copy(part.begin(), part.end(), results.begin() + static_cast<std::ptrdiff_t>(g * 100));
    }
  });
  for (size_t i = 0; i < cloud.size(); i += 13)
    expect_near(results[i], two_passes(cloud, cloud.position[i], normalize(cloud.position[i]), 0.3f));
  EXPECT_EQ((*maps.get("skin"))->lit(), cloud.size());
}

TEST(Scatter, GridsThatBreakOffLeaveNothingBehind) {
  const PointCloud cloud = ball(100, 2);
  ScatterMaps maps([&](const std::string&) { return cloud; });
  Vec3 P, N;
  float area;
  {
    ScatterGrid broken(maps);
    ASSERT_TRUE(broken.read_map("skin"));
    broken.add_grid_point({}, 10);
    ASSERT_TRUE(broken.get_sample(P, N, area));
  }
  ScatterGrid grid(maps);
  ASSERT_TRUE(grid.read_map("skin"));
  grid.add_grid_point({}, 10);
  size_t count = 0;
  while (grid.get_sample(P, N, area))
    grid.save_irradiance({1, 1, 1}), ++count;
  EXPECT_EQ(count, 100u);
  EXPECT_EQ((*maps.get("skin"))->duplicates(), 0u);
  // Another grid's claim is not waited for.
  maps.forget_light();
  ScatterGrid first(maps), second(maps);
  ASSERT_TRUE(first.read_map("skin") && second.read_map("skin"));
  first.add_grid_point({}, 10);
  second.add_grid_point({}, 10);
  for (count = 0; second.get_sample(P, N, area); ++count)
    second.save_irradiance({1, 1, 1});
  EXPECT_EQ(count, 100u);
}

TEST(Scatter, PointsWithVeryManySamplesAreNotListed) {
  // 200 points that each see 100 000 samples: the first 168 fill the list, the others search again.
  const PointCloud cloud = ball(100000, 1);
  ScatterMaps maps([&](const std::string&) { return cloud; });
  ScatterGrid grid(maps);
  ASSERT_TRUE(grid.read_map("skin"));
  for (int i = 0; i < 200; ++i)
    grid.add_grid_point({0, 0, 1}, 5);
  Vec3 P, N;
  float area;
  while (grid.get_sample(P, N, area))
    grid.save_irradiance({1, 1, 1});
  const Color first = grid.scatter(0, {0, 0, 1}, {0, 0, 1}, 5, {1, 1, 1});
  EXPECT_GT(first.x, 0);
  EXPECT_EQ(grid.scatter(199, {0, 0, 1}, {0, 0, 1}, 5, {1, 1, 1}), first);
}

TEST(Scatter, SeveralMapsAndThoseThatAreMissing) {
  int reads = 0;
  ScatterMaps maps([&](const std::string& name) -> slvm::Result<PointCloud> {
    ++reads;
    if (name == "none") return slvm::Error{"cannot open 'none'"};
    return name == "bare" ? plate(2, 1, {}) : ball(50, 2);
  });
  ScatterGrid grid(maps);
  EXPECT_EQ(grid.read_map("none").error(), "cannot open 'none'");
  EXPECT_EQ(grid.read_map("none").error(), "cannot open 'none'");
  EXPECT_EQ(grid.add_grid_point({}, 1), 0u);
  Vec3 P, N;
  float area;
  EXPECT_FALSE(grid.get_sample(P, N, area));
  EXPECT_EQ(grid.scatter(0, {}, {}, 1, {1, 1, 1}), Color{});
  ASSERT_TRUE(grid.read_map("bare") && grid.read_map("skin") && grid.read_map("bare"));
  EXPECT_EQ(grid.grid_points(), 0u);
  EXPECT_EQ(reads, 3);
}

TEST(Scatter, MapsFromPictures) {
  const std::vector<float> P{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, N{0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0, 1};
  const std::vector<float> A{0.5f, 0.25f, 0, std::nanf("")}; // the last two show nothing
  const auto cloud = cloud_of_scatter_images(2, 2, P, N, A);
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->size(), 2u);
  std::vector<float> mixed = N; // with the emptiness beside, by a filter
  mixed[2] = 0.6f;
  EXPECT_EQ(cloud_of_scatter_images(2, 2, P, mixed, A)->size(), 1u);
  const auto map = ScatterMap::build(*cloud);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->area(1), 0.25f);
  EXPECT_EQ(map->normal(1), (Vec3{0, 0, 1}));
  EXPECT_EQ(cloud_of_scatter_images(2, 3, P, N, A).error(),
            "the pictures of a scatter map must have the same size, 2 x 3: positions and normals with three "
            "channels, "
            "areas and faces with one");
  PointCloud bare;
  bare.position = {{0, 0, 0}};
  EXPECT_EQ(ScatterMap::build(bare).error(), "a scatter map needs normals");
  bare.normal = {{0, 0, 1}};
  EXPECT_EQ(ScatterMap::build(bare).error(), "a scatter map needs areas");
}

} // namespace
} // namespace subsurface::test
