// slpoints: what it makes of meshes and of clouds.
#include "stdlib/subsurface/repulsion.h"
#include "tests/temp_folder.h"
#include "tests/unit/subsurface/surfaces.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <sys/wait.h>

namespace subsurface::test {
namespace {

class SlPoints : public ::testing::Test {
protected:
  int run(const std::string& arguments) {
    const int status = std::system(
        ("cd '" + folder_.string() + "' && '" SLPOINTS_PROGRAM "' " + arguments + " > out 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string path(const std::string& name) { return (folder_ / name).string(); }
  anemone::test::TempFolder folder_;
};

TEST_F(SlPoints, SpreadsPointsOverMeshes) {
  const TriangleMesh ball = sphere(24, 2);
  ASSERT_TRUE(write_mesh(path("mesh.ply"), ball));
  ASSERT_EQ(run("mesh.ply points.ply --count 300 --passes 20"), 0) << folder_.read("out");
  const auto points = read_point_cloud(path("points.ply"));
  ASSERT_TRUE(points);
  EXPECT_EQ(points->size(), 300u);
  EXPECT_NEAR(points->total_area(), ball.total_area(), 1e-3);
  for (size_t i = 0; i < points->size(); ++i)
    EXPECT_GT(dot(points->position[i], points->normal[i]), 1.9f);
  ASSERT_EQ(run("mesh.ply more.ply --freepath 0.3 --passes 1"), 0);
  EXPECT_EQ(read_point_cloud(path("more.ply"))->size(), sample_count(ball.total_area(), 0.3));
  ASSERT_EQ(run("mesh.ply again.ply --count 300 --passes 20 --seed 0"), 0);
  EXPECT_EQ(folder_.read("points.ply"), folder_.read("again.ply"));
}

TEST_F(SlPoints, ThinsClouds) {
  ASSERT_TRUE(write_point_cloud(path("cloud.ply"), ball(2000, 1)));
  ASSERT_EQ(run("cloud.ply thin.ply -n 100"), 0) << folder_.read("out");
  const auto points = read_point_cloud(path("thin.ply"));
  ASSERT_TRUE(points);
  EXPECT_EQ(points->size(), 100u);
  EXPECT_NEAR(points->total_area(), ball(2000, 1).total_area(), 1e-3);
}

TEST_F(SlPoints, Complains) {
  auto said = [&] { return folder_.read("out"); };
  EXPECT_EQ(run("none.ply out.ply --count 5"), 3);
  EXPECT_NE(said().find("slpoints: error: cannot open 'none.ply'"), std::string::npos) << said();
  folder_.write(
      "bare.ply",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n0 0 0\n");
  EXPECT_EQ(run("bare.ply out.ply --count 5"), 1);
  EXPECT_NE(said().find("bare.ply: there are neither faces nor areas of points"), std::string::npos)
      << said();
  EXPECT_EQ(run("bare.ply out.ply"), 2);
  EXPECT_NE(said().find("--count or --freepath is required"), std::string::npos) << said();
  EXPECT_EQ(run("bare.ply out.ply --count 5 --freepath 1"), 2);
  EXPECT_FALSE(folder_.has("out.ply"));
}

} // namespace
} // namespace subsurface::test
