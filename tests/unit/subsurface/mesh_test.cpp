// Meshes, their neighbours, and ways over them.
#include "stdlib/subsurface/random.h"
#include "stdlib/subsurface/unfold.h"
#include "tests/unit/subsurface/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace subsurface::test {
namespace {

TEST(Mesh, AreasNormalsAndNeighbours) {
  const TriangleMesh box = cube();
  EXPECT_NEAR(box.total_area(), 24, 1e-6);
  const MeshTopology topology(box);
  for (uint32_t t = 0; t < 12; ++t) {
    const Vec3 middle = (box.corner(t, 0) + box.corner(t, 1) + box.corner(t, 2)) * (1.0f / 3);
    EXPECT_GT(dot(middle, box.wide_normal(t)), 0); // outward
    for (int k = 0; k < 3; ++k) {
      const MeshTopology::Side& side = topology.across(t, k);
      ASSERT_NE(side.triangle, MeshTopology::kNone);
      EXPECT_TRUE(side.reversed);
      EXPECT_EQ(topology.across(side.triangle, side.edge).triangle, t);
    }
  }
  EXPECT_EQ(MeshTopology(rectangle(1, 1)).across(0, 0).triangle, MeshTopology::kNone);
}

TEST(Mesh, GridsAreWeldedAtSeamsAndPoles) {
  const TriangleMesh ball = sphere(16, 2);
  EXPECT_EQ(ball.triangles.size(), 2u * 32 * 15); // two rows lose half of their triangles at the poles
  const MeshTopology topology(ball);
  for (uint32_t t = 0; t < ball.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_NE(topology.across(t, k).triangle, MeshTopology::kNone);
  EXPECT_NEAR(ball.total_area() / (16 * std::numbers::pi), 1, 0.02);
}

TEST(Mesh, StraightWaysOnAPlaneAreStraight) {
  const TriangleMesh mesh = rectangle(3, 2);
  const MeshPlane plane(mesh);
  const SurfacePoint start{0, {0.5f, 0.1f}};
  const SurfacePoint end = plane.walk(start, {0.3f, 1.4f});
  EXPECT_EQ(end.triangle, 1u);
  const Vec3 p = plane.position(end);
  EXPECT_NEAR(p.x, 0.8, 1e-5);
  EXPECT_NEAR(p.y, 1.5, 1e-5);
  const Vec3 along = plane.position(plane.walk(start, {1, 10})); // along the border y = 2
  EXPECT_NEAR(along.y, 2, 1e-5);
  EXPECT_NEAR(along.x, 1.5, 1e-5);
  const Vec3 corner = plane.position(plane.walk(start, {10, 10}));
  EXPECT_NEAR(corner.y, 2, 1e-5);
  EXPECT_NEAR(corner.x, 3, 1e-5);
}

TEST(Mesh, WaysGoOverEdges) {
  // From the middle of a face of the cube straight over an edge: 2 away is the middle of the next face.
  const TriangleMesh box = cube();
  const MeshPlane plane(box);
  for (uint32_t t = 0; t < 12; ++t) {
    // The diagonal is edge 2 of even triangles and edge 0 of odd ones; its middle is that of the face.
    const FlatTriangle own = plane.own(t);
    const int diagonal = t % 2 == 0 ? 2 : 0;
    const Vec2 a = own.corner[static_cast<size_t>(diagonal)],
               b = own.corner[static_cast<size_t>((diagonal + 1) % 3)];
    const Vec2 corner = own.corner[static_cast<size_t>((diagonal + 2) % 3)];
    const Vec2 middle = (a + b) * 0.5f, outwards = (a + corner) * 0.5f - middle;
    const SurfacePoint end = plane.walk({t, middle}, outwards * 2);
    const Vec3 p = plane.position(end), from = plane.position({t, middle});
    EXPECT_NEAR(length(p), 1, 1e-5) << t;
    EXPECT_NEAR(dot(p, from), 0, 1e-5) << t;
  }
}

TEST(Mesh, LongWaysKeepTheirLengthOnASphere) {
  const TriangleMesh ball = sphere(40, 1);
  const MeshPlane plane(ball);
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const auto t = static_cast<uint32_t>(random.bits() % ball.triangles.size());
    const FlatTriangle own = plane.own(t);
    const Vec2 start = (own.corner[0] + own.corner[1] + own.corner[2]) * (1.0f / 3);
    const double angle = 2 * std::numbers::pi * random.unit(), far = 2.5 * random.unit();
    const SurfacePoint end = plane.walk(
        {t, start}, Vec2{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))} *
                        static_cast<float>(far));
    const Vec3 a = normalize(plane.position({t, start})), b = normalize(plane.position(end));
    EXPECT_NEAR(std::acos(std::clamp(static_cast<double>(dot(a, b)), -1.0, 1.0)), far, 0.03);
    const auto w = plane.weights(end);
    EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-5);
    EXPECT_GE(std::min({w[0], w[1], w[2]}), 0);
  }
}

TEST(Mesh, FlatTrianglesCarryPlacesBothWays) {
  const TriangleMesh box = cube();
  const MeshPlane plane(box);
  FlatTriangle beyond;
  ASSERT_TRUE(plane.across(plane.own(0), 1, beyond));
  const Vec2 p{0.3f, 0.4f}, back = plane.from_own(beyond, plane.to_own(beyond, p));
  EXPECT_NEAR(back.x, p.x, 1e-5);
  EXPECT_NEAR(back.y, p.y, 1e-5);
}

slvm::Result<TriangleMesh> parse(const std::string& text) {
  return parse_mesh(std::as_bytes(std::span(text)), "m.ply");
}

TEST(Mesh, FromPly) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                           "property float z\nelement face 1\nproperty list uchar int ";
  const std::string points = "\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  auto square = parse(head + "vertex_index" + points + "4 0 1 2 3\n");
  ASSERT_TRUE(square) << square.error();
  EXPECT_EQ(square->triangles, (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(parse(head + "vertex_indices" + points + "3 0 1 4\n").error(), "m.ply: there is no vertex 4");
  EXPECT_EQ(parse(head + "vertex_indices" + points + "3 0 1 -1\n").error(), "m.ply: there is no vertex -1");
  EXPECT_EQ(parse(head + "corners" + points + "3 0 1 2\n").error(),
            "m.ply: 'face' needs the list 'vertex_indices'");
}

TEST(Mesh, NeighboursWhereThreeTrianglesMeet) {
  const TriangleMesh book{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                          {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
  const MeshTopology topology(book);
  EXPECT_EQ(topology.across(0, 0).triangle, 1u);
  EXPECT_FALSE(topology.across(0, 0).reversed);
  EXPECT_EQ(topology.across(2, 0).triangle, MeshTopology::kNone);
  const MeshPlane plane(book);
  plane.walk({0, {0.5f, 0.2f}}, {0, -0.5f}); // over an edge that runs the same way on both sides
}

} // namespace
} // namespace subsurface::test
