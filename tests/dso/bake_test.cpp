// bakepoints: a point a micropolygon, written when the frame ends, in an order that no thread decides.
#include "stdlib/subsurface/mesh.h"
#include "tests/dso/with_plugin.h"

namespace subsurface::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using BakePoints = WithPlugin;

TEST_F(BakePoints, OneForEachMicropolygon) {
  run("bakepoints(" + quoted("a.ply") + ", P, N, color(xcomp(P), 0, 1), color(0, ycomp(P), 2));", 5, 3);
  EXPECT_FALSE(folder_.has("a.ply")); // other grids may follow
  machine.end_plugins();
  EXPECT_THAT(messages(), IsEmpty());
  const PointCloud points = cloud("a.ply");
  ASSERT_EQ(points.size(), 8u);
  EXPECT_NEAR(points.total_area(), 1, 1e-6);
  for (size_t i = 0; i < 8; ++i) {
    const Vec3 p = points.position[i];
    EXPECT_EQ(
        p, (Vec3{0.125f + 0.25f * static_cast<float>(i / 2), 0.25f + 0.5f * static_cast<float>(i % 2), 1}));
    EXPECT_EQ(points.normal[i], (Vec3{0, 0, -1}));
    EXPECT_EQ(points.albedo[i], (Color{p.x, 0, 1}));
    EXPECT_EQ(points.irradiance[i], (Color{0, p.y, 2}));
  }
}

TEST_F(BakePoints, UniformValuesAndNoLight) {
  run("bakepoints(" + quoted("a.ply") + ", P, normal(0, 0, 1), color(.5));", 2, 2);
  machine.end_plugins();
  const PointCloud points = cloud("a.ply");
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points.normal[0], (Vec3{0, 0, 1}));
  EXPECT_EQ(points.albedo[0], (Color{0.5f, 0.5f, 0.5f}));
  EXPECT_TRUE(points.irradiance.empty());
}

TEST_F(BakePoints, OnlyWhereAllCornersRunTheCall) {
  run("if (xcomp(P) > 0.3) bakepoints(" + quoted("a.ply") + ", P, N, 1);", 5, 2);
  machine.end_plugins();
  EXPECT_THAT(messages(), IsEmpty());
  EXPECT_EQ(cloud("a.ply").size(), 2u); // x from 1/2
}

TEST_F(BakePoints, HitsOfRaysHaveNoMicropolygons) {
  auto surface = bind("surface s() { bakepoints(" + quoted("a.ply") + ", P, N, 1); }");
  slvm::Grid grid = slvm::test::square(4, 3);
  grid.lattice = slvm::Lattice::kHits;
  slvm::ShadingContext(machine, services).shade({.surface = surface.get()}, grid);
  machine.end_plugins();
  EXPECT_THAT(messages(), IsEmpty());
  EXPECT_FALSE(folder_.has("a.ply"));
}

TEST_F(BakePoints, PiecesOfOneGridHaveNoMicropolygonsBetweenThem) {
  auto surface = bind("surface s() { bakepoints(" + quoted("a.ply") + ", P, N, 1); bakemesh(" +
                      quoted("m.ply") + ", P, N); }");
  slvm::Grid grid = slvm::test::square(4, 6);
  grid.lattice = slvm::Lattice::kPieces;
  grid.piece_rows = 2;
  slvm::ShadingContext(machine, services).shade({.surface = surface.get()}, grid);
  machine.end_plugins();
  EXPECT_THAT(messages(), IsEmpty());
  EXPECT_EQ(cloud("a.ply").size(), 9u); // of 15
  EXPECT_EQ(read_mesh(path("m.ply"))->triangles.size(), 18u);
}

TEST_F(BakePoints, TheOrderDoesNotDependOnThreads) {
  auto bake = [&](const std::string& name, bool reversed) {
    std::vector<std::unique_ptr<slvm::Instance>> surfaces;
    for (int i = 0; i < 4; ++i)
      surfaces.push_back(bind("surface s() { bakepoints(" + quoted(name) + ", P + vector(0, 0, " +
                              std::to_string(reversed ? 3 - i : i) + "), N, 1); }"));
    for (auto& s : surfaces) {
      slvm::Grid grid = slvm::test::square(4, 4);
      slvm::ShadingContext(machine, services).shade({.surface = s.get()}, grid);
    }
    machine.end_plugins();
    return folder_.read(name);
  };
  const std::string one = bake("a.ply", false), other = bake("b.ply", true);
  EXPECT_EQ(cloud("a.ply").size(), 36u);
  EXPECT_EQ(one, other);
}

TEST_F(BakePoints, MeshesAreWeldedAndFaceAlongN) {
  for (std::string n : {"normal(0, 0, 1)", "normal(0, 0, -1)"}) {
    run("bakemesh(" + quoted("m.ply") + ", P, " + n + "); bakemesh(" + quoted("m.ply") +
            ", P + vector(1, 0, 0), " + n + ");",
        5, 3);
    machine.end_plugins();
    EXPECT_THAT(messages(), IsEmpty());
    const auto mesh = read_mesh(path("m.ply"));
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->vertices.size(), 27u); // 9 by 3
    EXPECT_EQ(mesh->triangles.size(), 32u);
    EXPECT_NEAR(mesh->total_area(), 2, 1e-6);
    for (size_t t = 0; t < mesh->triangles.size(); ++t)
      EXPECT_EQ(mesh->wide_normal(t).z > 0, n == "normal(0, 0, 1)");
  }
  run("bakemesh(\"\", P, N);", 2, 2);
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("bakemesh() needs the name of a file")));
}

TEST_F(BakePoints, LightAtAllPointsOrAtNone) {
  run("bakepoints(" + quoted("a.ply") + ", P, N, 1, 1);", 2, 2);
  run("bakepoints(" + quoted("a.ply") + ", P, N, 1);", 2, 2);
  EXPECT_THAT(
      messages(),
      ElementsAre(HasSubstr(
          "is called with irradiance here, without elsewhere: a cloud has it at all points or at none")));
}

TEST_F(BakePoints, WhatCannotBeBaked) {
  run("bakepoints(\"\", P, N, 1);", 2, 2);
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("bakepoints() needs the name of a file")));
  run("float zero = xcomp(P) * 0; bakepoints(" + quoted("a.ply") + ", P, N, 1 / zero);", 2, 2);
  EXPECT_THAT(new_messages(), ElementsAre(AllOf(HasSubstr("bakepoints() to "), HasSubstr("albedo"))));
  run("bakepoints(" + quoted("no/folder.ply") + ", P, N, 1);", 2, 2);
  machine.end_plugins();
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("no/folder.ply")));
}

} // namespace
} // namespace subsurface::test
