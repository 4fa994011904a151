// Quadrics: positions and normals against closed forms, bounds against sampling.
#include "render/prims/quadrics.h"
#include "slvm/support/turn.h"

#include "tests/render/surface_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace render {
namespace {

using testing::at;
using Point = testing::SurfacePoint;

void expect_near(Vec3 a, Vec3 b, float tolerance = 2e-5f) {
  testing::expect_near(a, b, tolerance);
}

struct Case {
  const char* name;
  std::shared_ptr<const Geometry> geometry;
  std::function<Vec3(float u, float v)> position; ///< RISpec 3.2, section 5.2
};

std::vector<Case> cases() {
  auto turn = [](float r, float angle, float z) { return Vec3(r * std::cos(angle), r * std::sin(angle), z); };
  float t = 300 * kPi / 180;
  float phi0 = std::asin(-0.5f), phi1 = std::asin(0.8f);
  return {
      {"sphere", *make_sphere(2, -1, 1.6f, 300),
       [=](float u, float v) {
         float phi = phi0 + v * (phi1 - phi0);
         return turn(2 * std::cos(phi), u * t, 2 * std::sin(phi));
       }},
      {"cone", *make_cone(3, 2, 300), [=](float u, float v) { return turn(2 * (1 - v), u * t, 3 * v); }},
      {"cylinder", *make_cylinder(2, -1, 4, 300),
       [=](float u, float v) { return turn(2, u * t, -1 + 5 * v); }},
      {"hyperboloid", *make_hyperboloid({2, 0, -1}, {0.5f, 1.5f, 2}, 300),
       [=](float u, float v) {
         Vec3 q = Vec3(2, 0, -1) * (1 - v) + Vec3(0.5f, 1.5f, 2) * v;
         float c = std::cos(u * t), s = std::sin(u * t);
         return Vec3(q.x * c - q.y * s, q.x * s + q.y * c, q.z);
       }},
      {"paraboloid", *make_paraboloid(2, 1, 4, 300),
       [=](float u, float v) {
         float z = 1 + 3 * v;
         return turn(2 * std::sqrt(z / 4), u * t, z);
       }},
      {"disk", *make_disk(0.5f, 2, 300), [=](float u, float v) { return turn(2 * (1 - v), u * t, 0.5f); }},
      {"torus", *make_torus(3, 1, 30, 200, 300),
       [=](float u, float v) {
         float phi = (30 + v * 170) * kPi / 180;
         return turn(3 + std::cos(phi), u * t, std::sin(phi));
       }},
  };
}

TEST(Quadrics, positions_follow_the_specification) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    for (float u : {0.0f, 0.3f, 0.7f, 1.0f})
      for (float v : {0.0f, 0.25f, 0.9f, 1.0f})
        expect_near(at(*c.geometry, u, v).P, c.position(u, v));
  }
}

TEST(Quadrics, tangents_are_derivatives_of_position) {
  constexpr float kStep = 1e-3f;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    for (float u : {0.1f, 0.6f})
      for (float v : {0.2f, 0.8f}) {
        Point p = at(*c.geometry, u, v);
        expect_near(p.dPdu, (c.position(u + kStep, v) - c.position(u - kStep, v)) / (2 * kStep), 2e-2f);
        expect_near(p.dPdv, (c.position(u, v + kStep) - c.position(u, v - kStep)) / (2 * kStep), 2e-2f);
        expect_near(glm::normalize(p.N), glm::normalize(glm::cross(p.dPdu, p.dPdv)), 1e-4f);
      }
  }
}

TEST(Quadrics, normals_point_outwards) {
  auto sphere = make_sphere(2, -2, 2, 360);
  for (float v : {0.0f, 0.3f, 1.0f}) { // the poles have a normal too
    Point p = at(**sphere, 0.2f, v);
    expect_near(glm::normalize(p.N), p.P / 2.0f, 1e-3f);
  }
  expect_near(glm::normalize(at(**make_disk(1, 2, 360), 0.3f, 1).N), {0, 0, 1});
  Point cone = at(**make_cone(1, 1, 360), 0, 1); // the tip: along the side
  expect_near(glm::normalize(cone.N), {std::sqrt(0.5f), 0, std::sqrt(0.5f)});
  Point apex = at(**make_paraboloid(1, 0, 1, 360), 0, 0);
  EXPECT_LT(glm::normalize(apex.N).z, -0.99f);
}

TEST(Quadrics, turns_are_exact_enough) {
  for (int i = -4000; i <= 4000; ++i) {
    float turn = static_cast<float>(i) / 1000, sine, cosine;
    slvm::sine_and_cosine(turn, sine, cosine);
    double angle = 2 * M_PI * static_cast<double>(turn);
    EXPECT_NEAR(sine, std::sin(angle), 1.5e-7) << turn;
    EXPECT_NEAR(cosine, std::cos(angle), 1.5e-7) << turn;
    if (i % 250 != 0) continue;
    EXPECT_EQ(sine, std::round(std::sin(angle))) << "whole quarters are exact";
    EXPECT_EQ(cosine, std::round(std::cos(angle)));
  }
}

TEST(Quadrics, a_negative_sweep_turns_the_normals_over) {
  Point p = at(**make_cylinder(1, 0, 1, -360), 0, 0.5f);
  expect_near(glm::normalize(p.N), {-1, 0, 0});
}

TEST(Quadrics, bounds_hold_all_points_and_are_tight) {
  const UvRect kRects[] = {{}, {0, 0.5f, 0, 1}, {0.25f, 0.375f, 0.5f, 0.625f}, {0.9f, 1, 0, 0.1f}};
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    for (const UvRect& r : kRects) {
      Box bound = c.geometry->bound(r), sampled;
      for (int i = 0; i <= 40; ++i)
        for (int j = 0; j <= 40; ++j)
          sampled.add(c.position(r.u0 + (r.u1 - r.u0) * static_cast<float>(i) / 40,
                                 r.v0 + (r.v1 - r.v0) * static_cast<float>(j) / 40));
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(bound.min[k], sampled.min[k] + 1e-4f);
        EXPECT_GE(bound.max[k], sampled.max[k] - 1e-4f);
      }
      // At most the arc of the wider end is added: sector bounds are exact up to sampling.
      float slack = 0.02f * glm::length(sampled.max - sampled.min) + 0.02f;
      EXPECT_LT(glm::length(bound.max - bound.min), glm::length(sampled.max - sampled.min) + slack);
    }
  }
}

TEST(Quadrics, those_without_a_surface_are_told_once_and_a_paraboloid_begins_at_its_apex) {
  testing::Rendered r = testing::render_text(
      "Format 4 4 1 WorldBegin Sphere 0 0 0 360 Sphere 0 0 0 360 Cylinder 0 1 2 360 WorldEnd");
  EXPECT_EQ(r.scene.primitives.size(), 0u);
  const std::string said = "Sphere: the radius is zero; nothing is drawn, here and wherever it is so";
  EXPECT_NE(r.messages.find(said), std::string::npos);
  EXPECT_EQ(r.messages.find(said), r.messages.rfind(said));
  EXPECT_EQ(r.messages.find("error"), std::string::npos);
  Scene s = testing::scene_of("Paraboloid 1 -1 4 360");
  testing::expect_near(testing::at(s.primitives[0], 0, 0).P, {0, 0, 0});
  testing::expect_near(testing::at(s.primitives[0], 0, 1).P, {1, 0, 4});
}

} // namespace
} // namespace render
