// NURBS: positions, tangents and bounds against closed forms; variables; trimming by area; messages.
#include "render/prims/nurbs_pieces.h"

#include "tests/render/surface_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

using ::testing::HasSubstr;

/// A cylinder of radius 1 and height 2: nine points round, two up.
const char kCylinder[] =
    "NuPatch 9 3 [0 0 0 1 1 2 2 3 3 4 4 4] 0 4 2 2 [0 0 1 1] 0 1 "
    "\"Pw\" [1 0 0 1 .70710678 .70710678 0 .70710678 0 1 0 1 -.70710678 .70710678 0 .70710678 -1 0 0 1 "
    "-.70710678 -.70710678 0 .70710678 0 -1 0 1 .70710678 -.70710678 0 .70710678 1 0 0 1 "
    "1 0 2 1 .70710678 .70710678 1.41421356 .70710678 0 1 2 1 -.70710678 .70710678 1.41421356 .70710678 -1 0 "
    "2 1 "
    "-.70710678 -.70710678 1.41421356 .70710678 0 -1 2 1 .70710678 -.70710678 1.41421356 .70710678 1 0 2 1] ";

TEST(Nurbs, a_rational_circle_is_a_circle) {
  Scene s = scene_of(kCylinder);
  ASSERT_EQ(s.primitives.size(), 4u);
  for (const Primitive& p : s.primitives)
    for (float u : {0.0f, 0.3f, 0.5f, 1.0f}) {
      SurfacePoint q = at(p, u, 0.25f);
      EXPECT_NEAR(glm::length(Vec2(q.P)), 1, 1e-6f);
      EXPECT_NEAR(q.P.z, 0.5f, 1e-6f);
      EXPECT_NEAR(glm::dot(glm::normalize(q.N), Vec3(q.P.x, q.P.y, 0)), 1, 1e-6f);
      EXPECT_NEAR(glm::dot(q.dPdu, q.P), 0.0f, 1e-5f);
      SurfacePoint next = at(p, u + 1e-3f, 0.25f), before = at(p, u - 1e-3f, 0.25f);
      if (u > 0 && u < 1) {
        EXPECT_NEAR(glm::length(q.dPdu - (next.P - before.P) / 2e-3f), 0, 2e-3f);
      }
    }
  EXPECT_FLOAT_EQ(s.primitives[2].uv.u0, 0.5f);
  EXPECT_FLOAT_EQ(s.primitives[2].uv.u1, 0.75f);
}

TEST(Nurbs, bounds_hold_the_surface_and_shrink_with_the_piece) {
  Scene s = scene_of(kCylinder);
  UvRect r{0.2f, 0.3f, 0, 0.5f};
  Box b = s.primitives[1].geometry->bound(r);
  for (int i = 0; i <= 20; ++i) {
    Vec3 p = at(s.primitives[1], 0.2f + 0.005f * static_cast<float>(i), 0.3f).P;
    EXPECT_TRUE(p.x >= b.min.x && p.x <= b.max.x && p.y >= b.min.y && p.y <= b.max.y);
  }
  EXPECT_LT(glm::length(Vec2(b.max - b.min)), 0.2f);
  EXPECT_NEAR(b.max.z, 1, 1e-4f);
}

/// f(x) = x^(order-1) on [0,3] as a spline with knots at 1 and 2, for any order: its blossom at the knots.
TEST(Nurbs, splines_of_any_order_reproduce_polynomials) {
  for (int order : {2, 3, 4, 5, 7}) {
    SCOPED_TRACE(order);
    std::vector<float> knots;
    for (int i = 0; i < order; ++i)
      knots.push_back(0);
    knots.push_back(1);
    knots.push_back(2);
    for (int i = 0; i < order; ++i)
      knots.push_back(3);
    int points = order + 2;
    auto u = NurbsBasis::make(points, order, knots, 0, 3, "u");
    ASSERT_TRUE(bool(u));
    for (double x : {0.0, 0.4, 1.0, 1.7, 2.5, 3.0}) {
      int interval = u->interval(x / 3);
      NurbsWeights w = u->at(x / 3, interval);
      double sum = 0, line = 0, slope = 0;
      for (int i = 0; i < order; ++i) {
        double product = 1, mean = 0; // control values: products and means of knots
        for (int k = 1; k < order; ++k) {
          auto knot = static_cast<double>(knots[static_cast<size_t>(w.first + i + k)]);
          product *= knot;
          mean += knot / (order - 1);
        }
        sum += w.w[i] * product;
        line += w.w[i] * mean;
        slope += w.slope[i] * product;
      }
      EXPECT_NEAR(line, x, 1e-12);
      EXPECT_NEAR(slope, 3 * (order - 1) * std::pow(x, order - 2), 1e-8);
      EXPECT_NEAR(sum, std::pow(x, order - 1), 1e-9);
    }
  }
}

TEST(Nurbs, part_of_the_knots_may_be_in_use) {
  // A uniform cubic b-spline of points on a line; the middle part in use.
  Scene s = scene_of(
      "NuPatch 6 4 [0 1 2 3 4 5 6 7 8 9] 3.5 5 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 "
      "5 0 0 0 1 0 1 1 0 2 1 0 3 1 0 4 1 0 5 1 0]");
  ASSERT_EQ(s.primitives.size(), 2u);
  EXPECT_NEAR(at(s.primitives[0], 0, 0).P.x, 1.5f, 1e-6f);
  EXPECT_NEAR(at(s.primitives[1], 1, 0).P.x, 3, 1e-6f);
  EXPECT_NEAR(s.primitives[1].uv.u0, 1 / 3.0f, 1e-6f);
}

TEST(Nurbs, variables_of_every_class) {
  Scene s =
      scene_of("NuPatch 3 2 [0 0 1 2 2] 0 2 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0] "
               "\"uniform float f\" [5 6] \"varying float y\" [0 1 2 3 4 5] \"vertex float x\" [0 1 2 3 4 5] "
               "\"constant float c\" [9]");
  ASSERT_EQ(s.primitives.size(), 2u);
  EXPECT_FLOAT_EQ(value(s.primitives[1], "f", 0.5f, 0.5f), 6);
  EXPECT_FLOAT_EQ(value(s.primitives[1], "y", 0.25f, 0.5f), 2.75f);
  EXPECT_FLOAT_EQ(value(s.primitives[1], "x", 0.25f, 0.5f), 2.75f);
  EXPECT_FLOAT_EQ(value(s.primitives[0], "c", 0, 0), 9);
}

/// A unit square as a NURBS, u = x, v = y.
const char kSquare[] = "NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0 1 0 0 0 1 0 1 1 0] "
                       "\"varying float x\" [0 1 0 1]";
/// A circle of radius .25 round (.5, .5).
const char kCircle[] = "[0 0 0 1 1 2 2 3 3 4 4 4]";
const char kCircleU[] = "0.75 .53033009 .5 .17677670 .25 .17677670 .5 .53033009 .75";
const char kCircleV[] = "0.5 .53033009 .75 .53033009 .5 .17677670 .25 .17677670 .5";
const char kCircleW[] = "1 .70710678 1 .70710678 1 .70710678 1 .70710678 1";

std::string circle() {
  return std::string("TrimCurve [1] [3] ") + kCircle + " [0] [4] [9] [" + kCircleU + "] [" + kCircleV +
         "] [" + kCircleW + "] ";
}

double area_of(const Scene& s) {
  double area = 0;
  constexpr int kSteps = 8;
  for (const Primitive& p : s.primitives)
    for (int k = 0; k < kSteps * kSteps; ++k) {
      SurfacePoint q = at(p, (static_cast<float>(k % kSteps) + 0.5f) / kSteps,
                          (static_cast<float>(k / kSteps) + 0.5f) / kSteps);
      area += static_cast<double>(glm::cross(q.dPdu, q.dPdv).z) / kSteps / kSteps;
      EXPECT_NEAR(q.N.z, 1, 1e-6f);
    }
  return area;
}

TEST(Trim, keeps_the_inside_of_an_odd_number_of_loops) {
  constexpr double kDisk = M_PI / 16;
  EXPECT_NEAR(area_of(scene_of(circle() + kSquare)), kDisk, 1e-4);
  EXPECT_NEAR(area_of(scene_of("Attribute \"trimcurve\" \"string sense\" \"outside\" " + circle() + kSquare)),
              1 - kDisk, 1e-4);
  // The whole square as an outer loop of four straight curves, the circle as a hole in it.
  std::string both = "TrimCurve [4 1] [2 2 2 2 3] [0 0 1 1 0 0 1 1 0 0 1 1 0 0 1 1 0 0 0 1 1 2 2 3 3 4 4 4] "
                     "[0 0 0 0 0] [1 1 1 1 4] [2 2 2 2 9] [0 1 1 1 1 0 0 0 " +
                     std::string(kCircleU) + "] [0 0 0 1 1 1 1 0 " + kCircleV + "] [1 1 1 1 1 1 1 1 " +
                     kCircleW + "] ";
  EXPECT_NEAR(area_of(scene_of(both + kSquare)), 1 - kDisk, 1e-4);
  EXPECT_NEAR(area_of(scene_of(circle() + "TrimCurve [] [] [] [] [] [] [] [] [] " + kSquare)), 1, 1e-6);
}

TEST(Trim, variables_and_parameters_follow_the_surface) {
  Scene s = scene_of(circle() + kSquare);
  for (const Primitive& p : s.primitives)
    for (float a : {0.1f, 0.9f}) {
      SurfacePoint q = at(p, a, 0.4f);
      EXPECT_NEAR(value(p, "x", a, 0.4f), q.P.x, 1e-6f);
      EXPECT_NEAR(value(p, "u", a, 0.4f), q.P.x, 1e-6f);
      EXPECT_NEAR(value(p, "v", a, 0.4f), q.P.y, 1e-6f);
    }
}

TEST(Trim, edges_are_antialiased) {
  Rendered r =
      render_text("Format 64 64 1 ScreenWindow 0 1 0 1 PixelSamples 4 4 WorldBegin Translate 0 0 1 " +
                  circle() + kSquare + " WorldEnd");
  EXPECT_NEAR(r.covered(), 64 * 64 * M_PI / 16, 64 * 64 * 0.002);
}

TEST(Nurbs, messages) {
  auto message = [](const std::string& rib) { return messages_of("WorldBegin " + rib + " WorldEnd"); };
  auto patch = [&](const std::string& u) {
    return message("NuPatch " + u + " 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0]");
  };
  EXPECT_THAT(patch("2 1 [0 0 1] 0 1"), HasSubstr("error: NuPatch: uorder is 1; it must be from 2 to 32"));
  EXPECT_THAT(patch("2 3 [0 0 1 1 1] 0 1"), HasSubstr("nu is 2; order 3 takes at least 3 points"));
  EXPECT_THAT(patch("2 2 [0 0 1] 0 1"), HasSubstr("'uknot' takes nu + uorder = 4 numbers, found 3"));
  EXPECT_THAT(patch("2 2 [0 1 0 1] 0 1"), HasSubstr("'uknot' must not decrease; 0 follows 1"));
  EXPECT_THAT(patch("2 2 [0 0 1 1] 1 0"), HasSubstr("no part of the knots lies between umin 1 and umax 0"));
  EXPECT_THAT(message("NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 \"Pw\" [0 0 0 1 1 0 0 1 0 1 0 1 1 1 0 0]"),
              HasSubstr("a weight is 0; they must be positive"));
  EXPECT_THAT(message("TrimCurve [1] [2] [0 0 1] [0] [1] [2] [0 1] [0 1] [1 1]"),
              HasSubstr("TrimCurve: 'knot' takes 4 numbers, found 3"));
  EXPECT_THAT(message("TrimCurve [1] [1] [0 0 1] [0] [1] [2] [0 1] [0 1] [1 1]"),
              HasSubstr("TrimCurve: curve 1: order is 1"));
  EXPECT_THAT(message("TrimCurve [1] [2] [0 0 1 1] [0] [1] [2] [0 1] [0 1] [1 0]"),
              HasSubstr("TrimCurve: a weight is 0; they must be positive"));
}

} // namespace
} // namespace render::testing
