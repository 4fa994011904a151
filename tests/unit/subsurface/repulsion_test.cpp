// Points spread by repulsion: how even they are.
#include "stdlib/subsurface/octree.h"
#include "stdlib/subsurface/repulsion.h"
#include "tests/unit/subsurface/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace subsurface::test {
namespace {

/// Distances to nearest neighbours, as shares of those of a hexagonal lattice of the same density.
struct Spacing {
  double mean = 0, least = 1e30, deviation = 0;
};

Spacing spacing(const PointCloud& cloud, double area) {
  const double lattice = std::sqrt(2 / std::sqrt(3.0) * area / static_cast<double>(cloud.size()));
  const PointOctree tree(cloud.position);
  Spacing s;
  double squares = 0;
  for (size_t i = 0; i < cloud.size(); ++i) {
    float nearest = HUGE_VALF;
    tree.for_each_within(cloud.position[i], static_cast<float>(4 * lattice), [&](uint32_t j, float d2) {
      if (tree.order()[j] != i) nearest = std::min(nearest, d2);
    });
    const double d = std::sqrt(static_cast<double>(nearest)) / lattice;
    s.mean += d / static_cast<double>(cloud.size());
    squares += d * d / static_cast<double>(cloud.size());
    s.least = std::min(s.least, d);
  }
  s.deviation = std::sqrt(squares - s.mean * s.mean) / s.mean;
  return s;
}

Spacing spread(const TriangleMesh& mesh, size_t points, int passes) {
  const MeshPlane plane(mesh);
  RepulsionOptions options;
  options.points = points;
  options.passes = passes;
  const auto places = repel(plane, options);
  EXPECT_EQ(places.size(), points);
  return spacing(cloud_of(plane, places), mesh.total_area());
}

TEST(Repulsion, SpreadsEvenlyOverSpheres) {
  const TriangleMesh fine = sphere(40, 1), coarse = sphere(4, 1);
  for (const TriangleMesh* mesh : {&fine, &coarse}) {
    const Spacing before = spread(*mesh, 1000, 0), after = spread(*mesh, 1000, 40);
    EXPECT_LT(before.mean, 0.6); // at random 0.465, with one in each share of the area up to 0.57
    EXPECT_GT(before.deviation, 0.3);
    EXPECT_GT(after.mean, 0.82);
    EXPECT_GT(after.least, 0.6);
    EXPECT_LT(after.deviation, 0.07);
  }
}

TEST(Repulsion, SpreadsEvenlyOverEdgesAndBorders) {
  const Spacing box = spread(cube(), 2000, 40), sheet = spread(rectangle(4, 1), 2000, 40);
  EXPECT_GT(box.mean, 0.81); // straight through space, which is nearer than over the edges of the cube
  EXPECT_GT(box.least, 0.3);
  EXPECT_LT(box.deviation, 0.1);
  EXPECT_GT(sheet.mean, 0.82);
  EXPECT_GT(sheet.least, 0.4);
  EXPECT_LT(sheet.deviation, 0.08);
}

TEST(Repulsion, SidesOfAThinSheetDoNotSeeEachOther) {
  // Two layers, much nearer to each other than points are: both get half, each evenly.
  TriangleMesh sheets = rectangle(1, 1);
  for (int i = 0; i < 4; ++i)
    sheets.vertices.push_back(sheets.vertices[static_cast<size_t>(i)] + Vec3{0, 0, 0.001f});
  sheets.triangles.push_back({4, 5, 6});
  sheets.triangles.push_back({4, 6, 7});
  const MeshPlane plane(sheets);
  RepulsionOptions options;
  options.points = 800;
  const PointCloud cloud = cloud_of(plane, repel(plane, options));
  PointCloud lower;
  for (Vec3 p : cloud.position)
    if (p.z < 0.0005f) lower.position.push_back(p);
  EXPECT_EQ(lower.size(), 400u); // by area, and no way leads across
  EXPECT_GT(spacing(lower, 1).mean, 0.82);
}

TEST(Repulsion, FollowsAreaNotTriangles) {
  // A sphere with poles of tiny triangles: as many points in each slice of the same height (Archimedes).
  const TriangleMesh mesh = sphere(30, 1);
  const MeshPlane plane(mesh);
  RepulsionOptions options;
  options.points = 2000;
  const PointCloud cloud = cloud_of(plane, repel(plane, options));
  size_t slices[10] = {};
  for (size_t i = 0; i < cloud.size(); ++i) {
    ++slices[static_cast<size_t>((cloud.position[i].z + 1) * 4.9999f)];
    EXPECT_NEAR(length(cloud.normal[i] - normalize(cloud.position[i])), 0, 0.1);
  }
  for (size_t count : slices)
    EXPECT_NEAR(static_cast<double>(count), 200, 12);
  EXPECT_NEAR(cloud.total_area(), mesh.total_area(), 1e-3);
}

TEST(Repulsion, IsTheSameInAnyNumberOfThreads) {
  const TriangleMesh mesh = sphere(12, 1);
  const MeshPlane plane(mesh);
  RepulsionOptions options;
  options.points = 500;
  options.passes = 5;
  options.threads = 1;
  const PointCloud one = cloud_of(plane, repel(plane, options));
  options.threads = 7;
  EXPECT_EQ(one.position, cloud_of(plane, repel(plane, options)).position);
  options.seed = 1;
  EXPECT_NE(one.position, cloud_of(plane, repel(plane, options)).position);
}

TEST(Repulsion, MeshesWithoutAreaHaveNoPoints) {
  const TriangleMesh nothing, line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}};
  for (const TriangleMesh* mesh : {&nothing, &line})
    EXPECT_TRUE(repel(MeshPlane(*mesh), {}).empty());
}

TEST(Repulsion, NumberOfSamples) {
  EXPECT_EQ(sample_count(100 * std::numbers::pi, 1), 100u); // a disc of ten mean free paths
  EXPECT_EQ(sample_count(0, 1), 1u);
  EXPECT_EQ(sample_count(1, 0), 2'000'000'000u);
}

} // namespace
} // namespace subsurface::test
