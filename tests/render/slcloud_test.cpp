// slcloud: what it tells of clouds, and what it shows of them.
#include "render/caches/point_table.h"
#include "stdlib/subsurface/point_cloud.h"
#include "tests/temp_folder.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sys/wait.h>

namespace render {
namespace {

using ::testing::HasSubstr;

constexpr int kSize = 64;

class SlCloud : public ::testing::Test {
protected:
  int run(const std::string& arguments) {
    const int status = std::system(
        ("cd '" + folder_.string() + "' && '" SLCLOUD_PROGRAM "' " + arguments + " > out 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string said() const { return folder_.read("out"); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Two points, red on the left and green on the right, with normals towards the eye.
  void write_two() {
    PointTable t;
    t.kind = "irradiance cache";
    t.points = 2;
    t.add("P", 3) = {-1, 0, 0, 1, 0, 0};
    t.add("N", 3) = {0, 0, -1, 0, 0, -1};
    t.add("radius", 1) = {1, 2};
    t.add("irradiance", 3) = {0.5f, 0, 0, 0, 0.25f, 0};
    t.add("occlusion", 1) = {0.1f, 0.8f};
    ASSERT_TRUE(write_point_table(path("two.icf"), t));
  }
  /// kSize x kSize pixels of 4 floats.
  std::vector<float> picture(const std::string& options) {
    std::vector<float> pixels(kSize * kSize * 4);
    EXPECT_EQ(run("two.icf -o out.exr --size 64 64 " + options), 0) << said();
    if (auto in = OIIO::ImageInput::open(path("out.exr")))
      in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, pixels.data());
    return pixels;
  }
  /// Pixels that the points cover, and the mean of their x, weighted by a channel.
  struct Seen {
    double covered = 0, x = 0, greatest = 0;
  };
  static Seen seen(const std::vector<float>& pixels, int channel) {
    Seen s;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double value = static_cast<double>(pixels[static_cast<size_t>((y * kSize + x) * 4 + channel)]);
        if (value < 0.1) continue; // the ground
        s.covered += 1;
        s.x += x;
        s.greatest = std::max(s.greatest, value);
      }
    if (s.covered > 0) s.x /= s.covered;
    return s;
  }
  anemone::test::TempFolder folder_;
};

TEST_F(SlCloud, tells_what_is_in_a_file) {
  write_two();
  ASSERT_EQ(run("two.icf"), 0);
  EXPECT_EQ(said(), "two.icf: irradiance cache, 2 points\n"
                    "  P                      -1 0 0 .. 1 0 0, mean 0 0 0\n"
                    "  N                      0 0 -1 .. 0 0 -1, mean 0 0 -1\n"
                    "  radius                 1 .. 2, mean 1.5\n"
                    "  irradiance             0 0 0 .. 0.5 0.25 0, mean 0.25 0.125 0\n"
                    "  occlusion              0.1 .. 0.8, mean 0.45\n");
}

TEST_F(SlCloud, shows_points_and_discs) {
  write_two();
  const auto points = picture("");
  EXPECT_LT(seen(points, 0).x, kSize / 3);
  EXPECT_GT(seen(points, 1).x, 2 * kSize / 3);
  EXPECT_NEAR(seen(points, 0).greatest, 0.5, 0.03);
  EXPECT_NEAR(seen(points, 1).greatest, 0.25, 0.02);
  // Discs are as large as their radii say, and half as far for half the scale.
  const auto discs = picture("--discs");
  EXPECT_NEAR(seen(discs, 1).covered / seen(discs, 0).covered, 4, 0.8);
  EXPECT_NEAR(seen(discs, 1).covered / seen(picture("--discs --scale 0.5"), 1).covered, 4, 0.8);
  EXPECT_NEAR(seen(picture("--gain 2"), 0).greatest, 1, 0.05);
}

TEST_F(SlCloud, turns_tilts_and_zooms) {
  write_two();
  EXPECT_GT(seen(picture("--turn 180"), 0).x, 2 * kSize / 3);
  // Seen from the side, discs have no width.
  EXPECT_LT(seen(picture("--discs --tilt 90"), 1).covered, 0.2 * seen(picture("--discs"), 1).covered);
  const auto near = picture("--discs --zoom 0.8"), far = picture("--discs --zoom 0.4");
  EXPECT_NEAR(seen(near, 0).covered / seen(far, 0).covered, 4, 1);
}

TEST_F(SlCloud, shows_what_is_asked_for) {
  write_two();
  const auto occlusion = picture("--show occlusion");
  EXPECT_NEAR(seen(occlusion, 2).greatest, 0.8, 0.04);
  EXPECT_EQ(run("two.icf -o out.exr --show power"), 1);
  EXPECT_EQ(said(),
            "slcloud: error: there is no 'power' to be shown; there is P N radius irradiance occlusion\n");
}

TEST_F(SlCloud, writes_scenes_and_clouds) {
  write_two();
  ASSERT_EQ(run("two.icf -o two.rib --discs"), 0) << said();
  EXPECT_THAT(folder_.read("two.rib"), HasSubstr("Display \"two.png\" \"file\" \"rgba\""));
  EXPECT_THAT(folder_.read("two.rib"), HasSubstr("PointsPolygons"));
  ASSERT_EQ(run("two.icf -o two.ply"), 0) << said();
  const auto cloud = subsurface::read_point_cloud(path("two.ply"));
  ASSERT_TRUE(cloud) << cloud.error();
  EXPECT_EQ(cloud->position[1], (subsurface::Vec3{1, 0, 0}));
  EXPECT_EQ(cloud->irradiance[1], (subsurface::Vec3{0, 0.25f, 0}));
  EXPECT_NEAR(cloud->area[1], 4 * 3.14159f, 1e-4);
  ASSERT_TRUE(cloud->find("occlusion"));
  EXPECT_EQ(cloud->find("occlusion")->values[1], 0.8f);
  // And back.
  ASSERT_EQ(run("two.ply"), 0) << said();
  EXPECT_THAT(said(), HasSubstr("two.ply: point cloud, 2 points\n"));
  EXPECT_THAT(said(), HasSubstr("  radius                 1 .. 2, mean 1.5\n"));
  ASSERT_EQ(run("two.ply -o ply.png --discs"), 0) << said();
  EXPECT_TRUE(std::filesystem::exists(path("ply.png")));
}

TEST_F(SlCloud, nothing_in_a_file_is_no_mistake) {
  PointTable t;
  t.kind = "irradiance cache";
  t.add("P", 3);
  ASSERT_TRUE(write_point_table(path("empty.ocf"), t));
  ASSERT_EQ(run("empty.ocf"), 0);
  EXPECT_EQ(said(), "empty.ocf: irradiance cache, 0 points\n");
  EXPECT_EQ(run("empty.ocf -o empty.png"), 0) << said();
}

TEST_F(SlCloud, complains) {
  EXPECT_EQ(run("none.icf"), 3);
  EXPECT_EQ(said(), "slcloud: error: none.icf: there is no such file\n");
  EXPECT_EQ(run(""), 2);
  folder_.write("text.icf", "hello");
  EXPECT_EQ(run("text.icf"), 1);
  EXPECT_EQ(said(),
            "slcloud: error: text.icf: this is neither an irradiance cache nor a photon map of Anemone\n");
  write_two();
  EXPECT_EQ(run("two.icf --zoom 0"), 2);
  EXPECT_EQ(run("two.icf -o /nonexistent/folder/two.ply"), 1);
  PointTable t;
  t.kind = "photon map";
  t.points = 1;
  t.add("P", 3);
  ASSERT_TRUE(write_point_table(path("bare.gpm"), t));
  EXPECT_EQ(run("bare.gpm -o bare.png --discs"), 1);
  EXPECT_EQ(said(), "slcloud: error: the points have no normals, which discs need\n");
}

} // namespace
} // namespace render
