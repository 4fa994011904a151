// Bound and split: sizes of grids, what is culled, surfaces that reach behind the eye.
#include "render/prims/split.h"

#include "render/prims/patches.h"
#include "render/prims/quadrics.h"
#include "render/state/transforms.h"

#include <gtest/gtest.h>

#include <random>

namespace render {
namespace {

struct SplitCase {
  Options options;
  SplitCase() {
    options.projection = ProjectionKind::kPerspective;
    options.fov = 60;
    options.xres = options.yres = 200;
  }
  std::vector<GridTask> split(std::shared_ptr<const Geometry> g, const Matrix4& m, float rate = 1) {
    Camera camera(options);
    auto attributes = std::make_shared<Attributes>();
    attributes->shading_rate = rate;
    auto state = std::make_shared<PrimitiveState>();
    state->attributes = attributes;
    state->object_to_camera = m;
    Primitive p{state, std::move(g), {}};
    std::vector<GridTask> out;
    split_primitive(p, 7, {&camera, {0, 0}, {200, 200}, options.grid_size, options.eye_splits}, out);
    return out;
  }
};

double area(const std::vector<GridTask>& tasks) {
  double sum = 0;
  for (const GridTask& t : tasks)
    sum += static_cast<double>(t.rect.u1 - t.rect.u0) * static_cast<double>(t.rect.v1 - t.rect.v0);
  return sum;
}

TEST(Split, the_box_of_a_moved_box_is_that_of_its_corners) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> number(-3, 3);
  for (int round = 0; round < 200; ++round) {
    Matrix4 m;
    for (int i = 0; i < 4; ++i)
      for (int c = 0; c < (round % 2 ? 3 : 4); ++c) // in perspective, too
        m(i, c) = number(random);
    Box box, expected;
    for (int i = 0; i < 2; ++i)
      box.add({number(random), number(random), number(random)});
    for (int i = 0; i < 8; ++i)
      expected.add(transform_point(m, box.corner(i)));
    const Box moved = transform_box(m, box);
    EXPECT_EQ(moved.min, expected.min);
    EXPECT_EQ(moved.max, expected.max);
  }
}

TEST(Split, grids_respect_their_limit_and_cover_the_surface) {
  SplitCase s;
  auto tasks = s.split(*make_sphere(1, -1, 1, 360), translation({0, 0, 5}));
  EXPECT_GT(tasks.size(), 4u);
  for (const GridTask& t : tasks) {
    EXPECT_LE((t.nu - 1) * (t.nv - 1), Options().grid_size);
    EXPECT_GE(t.nu, 2);
    EXPECT_GE(t.nv, 2);
    EXPECT_EQ(t.primitive, 7u);
  }
  EXPECT_DOUBLE_EQ(area(tasks), 1);
}

TEST(Split, points_follow_the_shading_rate) {
  SplitCase s;
  auto points = [&](float rate) {
    double n = 0;
    for (const GridTask& t :
         s.split(make_bilinear({Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(-1, 1, 0), Vec3(1, 1, 0)}),
                 translation({0, 0, 4}), rate))
      n += (t.nu - 1) * (t.nv - 1);
    return n;
  };
  // The square is 2 / (4 tan 30 deg * 2) of the frame's 200 pixels wide.
  double side = 200 * 2 / (2 * 4 * 0.57735);
  EXPECT_NEAR(points(1), side * side, 0.25 * side * side);
  EXPECT_NEAR(points(4), points(1) / 4, points(1) / 8);
}

TEST(Split, what_is_out_of_sight_is_dropped) {
  SplitCase s;
  auto sphere = *make_sphere(1, -1, 1, 360);
  EXPECT_TRUE(s.split(sphere, translation({0, 0, -5})).empty()); // behind the eye
  EXPECT_TRUE(s.split(sphere, translation({20, 0, 5})).empty()); // to the side
  s.options.far_plane = 3;
  EXPECT_TRUE(s.split(sphere, translation({0, 0, 5})).empty()); // behind the far plane
}

TEST(Split, a_floor_under_the_eye_is_finite_work) {
  SplitCase s;
  Vec3 p[4] = {{-100, -1, 100}, {100, -1, 100}, {-100, -1, -100}, {100, -1, -100}};
  auto tasks = s.split(make_bilinear({p[0], p[1], p[2], p[3]}), {});
  EXPECT_FALSE(tasks.empty());
  EXPECT_LT(tasks.size(), 5000u);
}

TEST(Split, surfaces_around_the_eye_are_finite_work) {
  SplitCase s;
  auto tasks = s.split(*make_sphere(1, -1, 1, 360), {});
  EXPECT_FALSE(tasks.empty());
  EXPECT_LT(tasks.size(), 5000u);
}

TEST(Split, coordinates_that_are_not_numbers_do_no_harm) {
  SplitCase s;
  float nan = std::numeric_limits<float>::quiet_NaN();
  s.split(make_bilinear({Vec3(nan), Vec3(1, 0, 5), Vec3(0, 1, 5), Vec3(kInfinity)}), {});
  s.split(make_bilinear({Vec3(-1e30f), Vec3(1e30f, 0, 5), Vec3(0, 1e30f, 5), Vec3(1, 1, 1e30f)}), {});
}

} // namespace
} // namespace render
