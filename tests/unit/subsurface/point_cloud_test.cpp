// Point clouds in PLY files.
#include "stdlib/subsurface/point_cloud.h"
#include "tests/temp_folder.h"
#include "tests/unit/subsurface/surfaces.h"

#include <gtest/gtest.h>

namespace subsurface::test {
namespace {

PointCloud full_cloud() {
  PointCloud cloud = ball(100, 3);
  for (size_t i = 0; i < cloud.size(); ++i)
    cloud.albedo.push_back({0.1f, static_cast<float>(i) / 100, 1.5f});
  cloud.channels.push_back({"thickness", std::vector<float>(100, 0.1f)});
  cloud.channels.push_back({"id", std::vector<float>(100, 16777216.0f)});
  return cloud;
}

void expect_equal(const PointCloud& a, const PointCloud& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.area, b.area);
  EXPECT_EQ(a.irradiance, b.irradiance);
  EXPECT_EQ(a.albedo, b.albedo);
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (size_t i = 0; i < a.channels.size(); ++i) {
    EXPECT_EQ(a.channels[i].name, b.channels[i].name);
    EXPECT_EQ(a.channels[i].values, b.channels[i].values);
  }
}

slvm::Result<PointCloud> parse(const std::string& text) {
  return parse_point_cloud(std::as_bytes(std::span(text)), "a.ply");
}

TEST(PointCloud, BothEncodingsReadBackToTheLastBit) {
  const PointCloud cloud = full_cloud();
  const anemone::test::TempFolder folder;
  for (PlyEncoding encoding : {PlyEncoding::kBinary, PlyEncoding::kAscii}) {
    const std::string path = (folder / "cloud.ply").string();
    auto done = write_point_cloud(path, cloud, encoding);
    ASSERT_TRUE(done) << done.error();
    auto again = read_point_cloud(path);
    ASSERT_TRUE(again) << again.error();
    expect_equal(cloud, *again);
  }
  EXPECT_NE(cloud.find("thickness"), nullptr);
  EXPECT_EQ(cloud.find("colour"), nullptr);
  // No temporary file is left.
  size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.string()))
    ++files;
  EXPECT_EQ(files, 1u);
}

TEST(PointCloud, HeaderAsOtherProgramsExpectIt) {
  PointCloud cloud;
  cloud.position = {{1, 2, 3}};
  cloud.normal = {{0, 0, 1}};
  cloud.area = {0.5f};
  cloud.albedo = {{0.5f, 2, -1}};
  auto bytes = format_point_cloud(cloud, PlyEncoding::kAscii);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()),
            "ply\nformat ascii 1.0\ncomment point cloud of Anemone\nelement vertex 1\nproperty float x\n"
            "property float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
            "property float area\nproperty float albedo_r\nproperty float albedo_g\nproperty float albedo_b\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
            "1 2 3 0 0 1 0.5 0.5 2 -1 128 255 0\n");
}

TEST(PointCloud, EmptyCloudsAreFiles) {
  auto bytes = format_point_cloud({});
  ASSERT_TRUE(bytes);
  auto again = parse_point_cloud(*bytes, "a.ply");
  ASSERT_TRUE(again) << again.error();
  EXPECT_EQ(again->size(), 0u);
}

TEST(PointCloud, PaintedColoursAreTheAlbedo) {
  auto cloud = parse(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nend_header\n"
      "1 2 3 255 51 0 7\n");
  ASSERT_TRUE(cloud) << cloud.error();
  EXPECT_FLOAT_EQ(cloud->albedo[0].y, 0.2f);
  ASSERT_EQ(cloud->channels.size(), 1u);
  EXPECT_EQ(cloud->channels[0].name, "alpha");
}

TEST(PointCloud, RefusesWhatIsNoCloud) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n";
  EXPECT_EQ(parse(head + "end_header\n1 2 3 4\n").error(), "a.ply: 'vertex' needs the properties x, y and z");
  EXPECT_EQ(parse("ply\nformat ascii 1.0\nelement face 0\nend_header\n").error(),
            "a.ply: there is no element 'vertex'");
  EXPECT_EQ(parse(head + "property float z\nend_header\n1 2 3 4 5 nan\n").error(),
            "a.ply: the position of point 1 is not a usable number");
  EXPECT_EQ(parse(head + "property float z\nproperty float area\nend_header\n1 2 3 -4 5 6 7 8\n").error(),
            "a.ply: the area of point 0 is not a usable number");
  EXPECT_FALSE(read_point_cloud("/nowhere/cloud.ply"));
}

TEST(PointCloud, RefusesToWriteWhatCannotBeRead) {
  PointCloud cloud;
  cloud.position = {{1, 2, 3}};
  cloud.area = {1, 2};
  EXPECT_EQ(format_point_cloud(cloud).error(), "there are 1 positions, but 2 times 'area'");
  cloud.area = {1};
  cloud.channels = {{"two words", {1}}};
  EXPECT_EQ(format_point_cloud(cloud).error(),
            "'two words' cannot be the name of a channel: it must be one word of ASCII");
  cloud.channels = {{"nx", {1}}};
  EXPECT_EQ(format_point_cloud(cloud).error(),
            "'nx' cannot be the name of a channel: there is one, or the cloud's own data have it");
  cloud.channels = {{"depth", {}}};
  EXPECT_EQ(format_point_cloud(cloud).error(), "the channel 'depth' is empty");
  cloud.channels = {};
  EXPECT_NE(write_point_cloud("/nowhere/cloud.ply", cloud).error().find("cannot write '/nowhere/cloud.ply'"),
            std::string::npos);
}

} // namespace
} // namespace subsurface::test
