// Bilinear and bicubic patches, bases, polygons cut into patches.
#include "render/prims/patches.h"

#include "render/prims/polygons.h"
#include "tests/render/surface_probe.h"

#include <gtest/gtest.h>

#include <cmath>

namespace render {
namespace {

using testing::expect_near;

SurfaceLattice lattice(const Geometry& g, std::vector<float> u, std::vector<float> v) {
  SurfaceLattice l;
  g.evaluate({u, v}, l);
  return l;
}

TEST(Patches, bilinear_corners_come_u_first) {
  auto g = make_bilinear({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 2)});
  SurfaceLattice l = lattice(*g, {0, 1}, {0, 1});
  expect_near(l.P[1], {1, 0, 0});
  expect_near(l.P[2], {0, 1, 0});
  expect_near(lattice(*g, {0.5f}, {0.5f}).P[0], {0.5f, 0.5f, 0.5f});
  expect_near(l.N[0], {0, 0, 1});
}

TEST(Patches, a_collapsed_edge_has_a_normal) {
  auto g = make_bilinear({Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)});
  expect_near(glm::normalize(lattice(*g, {0}, {0}).N[0]), {0, 0, 1});
}

/// 16 points (i, j, height(i, j)).
std::array<Vec3, 16> net(float (*height)(float, float)) {
  std::array<Vec3, 16> p;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      p[static_cast<size_t>(4 * j + i)] = {i, j, height(static_cast<float>(i), static_cast<float>(j))};
  return p;
}

TEST(Patches, bicubic_bezier_interpolates_its_corners_and_is_bounded_by_its_net) {
  auto p = net([](float i, float j) { return std::sin(i * 2 + j); });
  auto g = make_bicubic(p);
  SurfaceLattice l = lattice(*g, {0, 1}, {0, 1});
  expect_near(l.P[0], p[0]);
  expect_near(l.P[1], p[3]);
  expect_near(l.P[2], p[12]);
  expect_near(l.P[3], p[15]);
  UvRect r{0.2f, 0.45f, 0.6f, 0.9f};
  Box b = g->bound(r);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      float u = r.u0 + (r.u1 - r.u0) * static_cast<float>(i) / 10,
            v = r.v0 + (r.v1 - r.v0) * static_cast<float>(j) / 10;
      Vec3 q = lattice(*g, {u}, {v}).P[0];
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(q[k], b.min[k] - 1e-5f);
        EXPECT_LE(q[k], b.max[k] + 1e-5f);
      }
    }
}

TEST(Patches, bicubic_tangents_are_derivatives) {
  auto g = make_bicubic(net([](float i, float j) { return i * i * 0.3f - j * i * 0.2f; }));
  constexpr float h = 1e-3f;
  SurfaceLattice l = lattice(*g, {0.3f - h, 0.3f, 0.3f + h}, {0.6f - h, 0.6f, 0.6f + h});
  expect_near(l.dPdu[4], (l.P[5] - l.P[3]) / (2 * h), 5e-3f);
  expect_near(l.dPdv[4], (l.P[7] - l.P[1]) / (2 * h), 5e-3f);
}

TEST(Patches, points_alone_are_those_of_the_whole_evaluation) {
  std::array<Vec3, 16> net;
  for (size_t k = 0; k < net.size(); ++k)
    net[k] = {static_cast<float>(k % 4), static_cast<float>(k / 4), static_cast<float>(k * k % 7)};
  std::vector<float> u, v;
  for (int k = 0; k < 70; ++k) { // more than are worked out together
    u.push_back(static_cast<float>(k) / 69);
    v.push_back(static_cast<float>(k * k % 70) / 69);
  }
  for (const auto& g : {make_bicubic(net), make_bilinear({net[0], net[3], net[12], net[15]})})
    for (const UvPoints& at : {UvPoints{u, std::span(v).first(3)}, UvPoints{u, v, true}}) {
      SurfaceLattice all, points;
      g->evaluate(at, all);
      g->find_points(at, points);
      EXPECT_EQ(points.P, all.P);
    }
}

TEST(Patches, bases_convert_to_bezier) {
  // A b-spline of equally spaced points on a line is the middle third of it, traversed evenly.
  Matrix4 bspline{{-1 / 6.f, 3 / 6.f, -3 / 6.f, 1 / 6.f, 3 / 6.f, -1, 3 / 6.f, 0, -3 / 6.f, 0, 3 / 6.f, 0,
                   1 / 6.f, 4 / 6.f, 1 / 6.f, 0}};
  float values[16];
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      values[4 * j + i] = static_cast<float>(i + 10 * j);
  convert_to_bezier({bspline, 1}, bezier_basis(), values, 1);
  EXPECT_NEAR(values[0], 1, 1e-4f);
  EXPECT_NEAR(values[1], 4 / 3.0f, 1e-4f);
  EXPECT_NEAR(values[3], 2, 1e-4f);
  EXPECT_NEAR(values[15], 32, 1e-4f);
}

PrimitiveList polygon(std::vector<Vec3> P, std::vector<TypedParam> vars = {}) {
  PolygonFaces face;
  for (size_t i = 0; i < P.size(); ++i)
    face.vertices.push_back(static_cast<int>(i));
  face.loops = {static_cast<int>(P.size())};
  PrimitiveList out;
  out.add(std::make_shared<PrimitiveState>(), make_polygons(face, P, vars));
  return out;
}

TEST(Polygons, up_to_four_corners_are_one_patch_and_more_one_for_each) {
  EXPECT_EQ(polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).size(), 1u);
  EXPECT_EQ(polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 1u);
  EXPECT_EQ(polygon({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}}).size(), 5u);
}

TEST(Polygons, clockwise_from_outside_in_a_left_handed_space) {
  // The front side of the course's box: z = 0, outside is -z.
  auto p = polygon({{0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}});
  expect_near(glm::normalize(lattice(*p[0].geometry, {0.5f}, {0.5f}).N[0]), {0, 0, -1});
  // The left wall of the Cornell box: its normal points into the box, to +x.
  auto wall = polygon({{-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}, {-1, -1, -1}});
  expect_near(glm::normalize(lattice(*wall[0].geometry, {0.5f}, {0.5f}).N[0]), {1, 0, 0});
}

TEST(Polygons, texture_coordinates_are_object_x_and_y) {
  auto p = polygon({{2, 3, 0}, {4, 3, 0}, {4, 7, 0}, {2, 7, 0}});
  ASSERT_EQ(p[0].vars.size(), 1u);
  EXPECT_EQ(p[0].vars[0].name, "st");
  float out[2];
  float u = 0.5f, v = 0.5f;
  interpolate(p[0].vars[0], {{&u, 1}, {&v, 1}}, out, 1);
  EXPECT_FLOAT_EQ(out[0], 3);
  EXPECT_FLOAT_EQ(out[1], 5);
}

TEST(Polygons, values_linear_over_a_triangle_stay_linear) {
  TypedParam heat;
  heat.declaration = {"heat", StorageClass::kVarying};
  heat.numbers = {0, 1, 2};
  auto patches = polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {heat});
  for (const Primitive& patch : patches)
    for (float u : {0.1f, 0.7f})
      for (float v : {0.2f, 0.9f}) {
        Vec3 p = lattice(*patch.geometry, {u}, {v}).P[0];
        float value;
        interpolate(patch.vars[0], {{&u, 1}, {&v, 1}}, &value, 1);
        EXPECT_NEAR(value, p.x + 2 * p.y, 1e-6f);
      }
}

} // namespace
} // namespace render
