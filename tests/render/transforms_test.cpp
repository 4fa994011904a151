// Transformation matrices against their definitions.
#include "render/state/transforms.h"

#include "render/state/camera.h"
#include "tests/render/surface_probe.h"

#include <gtest/gtest.h>

#include <cmath>

namespace render {
namespace {

using testing::expect_near;

TEST(Transforms, rotation_takes_x_to_y_about_z) {
  expect_near(transform_point(rotation(90, {0, 0, 1}), Vec3{1, 0, 0}), {0, 1, 0});
  expect_near(transform_point(rotation(90, {1, 0, 0}), Vec3{0, 1, 0}), {0, 0, 1});
  expect_near(transform_point(rotation(120, {1, 1, 1}), Vec3{1, 0, 0}), {0, 1, 0});
  EXPECT_EQ(rotation(90, {0, 0, 0}), Matrix4{});
}

TEST(Transforms, the_request_nearest_the_primitive_acts_first) {
  Matrix4 ctm;
  ctm = translation({5, 0, 0}) * ctm;
  ctm = scaling({2, 2, 2}) * ctm;
  expect_near(transform_point(ctm, Vec3{1, 1, 1}), {7, 2, 2});
}

TEST(Transforms, skew_turns_the_first_axis_towards_the_second) {
  auto m = skew(30, {0, 1, 0}, {1, 0, 0});
  ASSERT_TRUE(m);
  Vec3 y = transform_point(*m, Vec3{0, 1, 0});
  EXPECT_NEAR(std::atan2(y.x, y.y), kPi / 6, 1e-5f);
  expect_near(transform_point(*m, Vec3{1, 0, 0}), {1, 0, 0}); // points on the second axis stay
  EXPECT_FALSE(skew(90, {0, 1, 0}, {1, 0, 0}));
  EXPECT_FALSE(skew(30, {0, 1, 0}, {0, 2, 0}));
}

TEST(Transforms, perspective_camera) {
  Options o;
  o.xres = 400;
  o.yres = 200;
  o.projection = ProjectionKind::kPerspective;
  o.fov = 90;
  Camera camera(o);
  // fov spans the shorter side: y from -1 to 1 at z = 1.
  Vec2 centre = camera.project({0, 0, 7}), top = camera.project({0, 3, 3}), right = camera.project({2, 0, 1});
  EXPECT_FLOAT_EQ(centre.x, 200);
  EXPECT_FLOAT_EQ(centre.y, 100);
  EXPECT_NEAR(top.y, 0, 1e-4f);
  EXPECT_NEAR(right.x, 400, 1e-4f);
  EXPECT_NEAR(transform_point(camera.to_screen(), Vec3{0, 0, o.near_plane}).z, 0, 1e-6f);
}

TEST(Transforms, crop_window_rounds_as_the_specification_says) {
  Options o;
  o.xres = o.yres = 10;
  o.crop = {0.25f, 0.75f, 0, 0.5f};
  PixelRect r = Camera(o).crop();
  EXPECT_EQ(r.x0, 3); // ceil(2.5)
  EXPECT_EQ(r.x1, 8); // ceil(6.5) = 7 is the last
  EXPECT_EQ(r.y0, 0);
  EXPECT_EQ(r.y1, 5);
}

TEST(Transforms, neighbouring_crop_windows_tile_the_frame) {
  Options o;
  o.xres = o.yres = 97;
  int next = 0;
  for (int i = 0; i < 7; ++i) {
    o.crop = {static_cast<float>(i) / 7, static_cast<float>(i + 1) / 7, 0, 1};
    PixelRect r = Camera(o).crop();
    EXPECT_EQ(r.x0, next);
    next = r.x1;
  }
  EXPECT_EQ(next, 97);
}

} // namespace
} // namespace render
