// Ribbons and discs: positions, facing, widths, variables; pictures by area.
#include "render/prims/curves.h"

#include "tests/render/surface_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

using ::testing::HasSubstr;

TEST(Curves, cubic_ribbons_follow_their_bezier_curve_and_face_the_eye) {
  Scene s = scene_of("Translate 0 0 5 Curves \"cubic\" [4] \"nonperiodic\" \"P\" [0 0 0 1 0 0 2 0 0 3 0 0] "
                     "\"width\" [.2 .4]");
  ASSERT_EQ(s.primitives.size(), 1u);
  SurfacePoint middle = at(s.primitives[0], 0.5f, 0.25f), edge = at(s.primitives[0], 1, 0.25f);
  expect_near(middle.P, {0.75f, 0, 0});
  EXPECT_NEAR(glm::length(edge.P - middle.P), 0.125f, 1e-6f);
  EXPECT_NEAR(edge.P.x, 0.75f, 1e-6f);
  EXPECT_NEAR(edge.P.z, 0, 1e-6f);
  EXPECT_LT(middle.N.z, 0); // orthographic, from -z
  expect_near(middle.dPdv, {3, 0, 0}, 1e-3f);
  EXPECT_NEAR(glm::length(middle.dPdu), 0.25f, 1e-6f);
}

TEST(Curves, bases_steps_and_wraps) {
  Scene spline =
      scene_of("Basis \"bezier\" 3 \"b-spline\" 1 Curves \"cubic\" [6] \"nonperiodic\" \"P\" "
               "[0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0] \"constantwidth\" [.1] \"varying float y\" [0 1 2 3]");
  ASSERT_EQ(spline.primitives.size(), 3u);
  expect_near(at(spline.primitives[2], 0.5f, 0.5f).P, {3.5f, 0, 0});
  EXPECT_FLOAT_EQ(value(spline.primitives[2], "y", 0.5f, 0.5f), 2.5f);
  EXPECT_FLOAT_EQ(spline.primitives[1].uv.v0, 1 / 3.0f);
  Scene ring = scene_of("Basis \"bezier\" 3 \"catmull-rom\" 1 Curves \"cubic\" [4] \"periodic\" \"P\" "
                        "[1 0 0 0 1 0 -1 0 0 0 -1 0] \"constantwidth\" [.1] \"varying float y\" [0 1 2 3]");
  ASSERT_EQ(ring.primitives.size(), 4u);
  for (size_t k = 0; k < 4; ++k) {
    expect_near(at(ring.primitives[k], 0.3f, 1).P, at(ring.primitives[(k + 1) % 4], 0.3f, 0).P);
    EXPECT_FLOAT_EQ(value(ring.primitives[k], "y", 0, 1), static_cast<float>((k + 1) % 4));
  }
}

TEST(Curves, variables_of_every_class) {
  Scene s = scene_of("Curves \"cubic\" [4 7] \"nonperiodic\" \"P\" [0 0 0 1 0 0 2 0 0 3 0 0 "
                     "0 1 0 1 1 0 2 1 0 3 1 0 4 1 0 5 1 0 6 1 0] \"uniform float f\" [3 4] "
                     "\"vertex float x\" [0 1 2 3 0 1 2 3 4 5 6] \"varying float y\" [0 1 5 6 7] "
                     "\"constant float c\" [8]");
  ASSERT_EQ(s.primitives.size(), 3u);
  EXPECT_FLOAT_EQ(value(s.primitives[2], "f", 0, 0), 4);
  EXPECT_NEAR(value(s.primitives[2], "x", 0.2f, 0.5f), 4.5f, 1e-6f);
  EXPECT_FLOAT_EQ(value(s.primitives[2], "y", 0.2f, 0.5f), 6.5f);
  EXPECT_FLOAT_EQ(value(s.primitives[2], "c", 0, 0), 8);
}

TEST(Curves, linear_segments_meet) {
  Scene s =
      scene_of("Curves \"linear\" [3] \"nonperiodic\" \"P\" [0 0 0 1 0 0 1 1 0] \"constantwidth\" [.2]");
  ASSERT_EQ(s.primitives.size(), 2u);
  for (float u : {0.0f, 1.0f})
    expect_near(at(s.primitives[0], u, 1).P, at(s.primitives[1], u, 0).P);
  // Mitred: the corner is as far out as the sides of a strip of this width.
  EXPECT_NEAR(glm::distance(at(s.primitives[0], 0, 1).P, at(s.primitives[0], 1, 1).P), 0.2f * std::sqrt(2.0f),
              1e-5f);
}

TEST(Curves, widths_and_normals_by_vertex_follow_the_basis) {
  // B-spline: the ends have (a + 4 b + c) / 6.
  Scene s = scene_of("Basis \"bezier\" 3 \"b-spline\" 1 Curves \"cubic\" [4] \"nonperiodic\" "
                     "\"P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"vertex float width\" [.1 .2 .6 .3] "
                     "\"vertex normal N\" [0 0 1 0 1 0 0 1 0 0 0 1]");
  auto width = [&](float v) {
    return glm::distance(at(s.primitives[0], 0, v).P, at(s.primitives[0], 1, v).P);
  };
  EXPECT_NEAR(width(0), (0.1f + 4 * 0.2f + 0.6f) / 6, 1e-5f);
  EXPECT_NEAR(width(1), (0.2f + 4 * 0.6f + 0.3f) / 6, 1e-5f);
  EXPECT_NEAR(width(0.5f), (0.1f + 23 * 0.2f + 23 * 0.6f + 0.3f) / 48, 1e-5f);
  expect_near(at(s.primitives[0], 0, 0).N, glm::normalize(Vec3(0, 5, 1)), 1e-4f);
}

TEST(Curves, ribbons_with_normals_face_these) {
  Scene s =
      scene_of("Curves \"cubic\" [4] \"nonperiodic\" \"P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"constantwidth\" [2] "
               "\"N\" [0 1 0 0 0 1]");
  expect_near(at(s.primitives[0], 0, 0).N, {0, 1, 0});
  expect_near(at(s.primitives[0], 0, 1).N, {0, 0, 1});
  EXPECT_NEAR(std::abs(at(s.primitives[0], 1, 0).P.z), 1, 1e-5f);
}

TEST(Curves, bounds_hold_the_ribbon) {
  Scene s = scene_of(
      "Curves \"cubic\" [4] \"nonperiodic\" \"P\" [0 0 0 1 3 0 2 -3 1 3 0 0] \"constantwidth\" [.5]");
  UvRect r{0, 1, 0.25f, 0.5f};
  Box b = s.primitives[0].geometry->bound(r);
  for (float u : {0.0f, 1.0f})
    for (int i = 0; i <= 10; ++i) {
      Vec3 p = at(s.primitives[0], u, 0.25f + 0.025f * static_cast<float>(i)).P;
      for (int k = 0; k < 3; ++k)
        EXPECT_TRUE(p[k] >= b.min[k] - 1e-5f && p[k] <= b.max[k] + 1e-5f);
    }
}

TEST(Curves, nonsense_ends) {
  for (const char* P : {"0 0 0 0 0 0 0 0 0 0 0 0", "1e30 0 0 -1e30 0 0 0 1e30 1 0 -1e30 2"}) {
    Rendered r =
        render_text(std::string("Format 8 8 1 Projection \"perspective\" WorldBegin Translate 0 0 3 Curves "
                                "\"cubic\" [4] \"nonperiodic\" \"P\" [") +
                    P + "] WorldEnd");
    EXPECT_EQ(r.messages, "");
  }
}

TEST(Curves, cover_their_area) {
  Rendered r =
      render_text("Format 100 100 1 ScreenWindow 0 1 0 1 WorldBegin Translate 0 0 1 Curves \"cubic\" [4] "
                  "\"nonperiodic\" \"P\" [0 .5 0 .4 .5 0 .6 .5 0 1 .5 0] \"constantwidth\" [.1] WorldEnd");
  EXPECT_NEAR(r.covered(), 1000, 15);
}

TEST(Points, are_discs_that_face_the_eye) {
  Scene s = render_text("Format 4 4 1 Projection \"perspective\" WorldBegin Points \"P\" [3 0 4 0 0 5] "
                        "\"width\" [.2 .4] \"varying color Cs\" "
                        "[1 0 0 0 1 0] \"constant float k\" [2] WorldEnd")
                .scene;
  ASSERT_EQ(s.primitives.size(), 2u);
  SurfacePoint p = at(s.primitives[0], 0.5f, 0.5f);
  expect_near(p.P, {3, 0, 4});
  expect_near(glm::normalize(p.N), {-0.6f, 0, -0.8f});
  for (float u : {0.0f, 0.25f, 1.0f})
    EXPECT_NEAR(glm::length(at(s.primitives[1], u, 0).P - Vec3(0, 0, 5)), 0.2f, 1e-6f);
  EXPECT_FLOAT_EQ(value(s.primitives[1], "Cs", 0, 0), 0);
  EXPECT_FLOAT_EQ(value(s.primitives[1], "k", 0, 0), 2);
  SurfacePoint q = at(s.primitives[0], 0.3f, 0.6f);
  expect_near(q.dPdu, (at(s.primitives[0], 0.301f, 0.6f).P - at(s.primitives[0], 0.299f, 0.6f).P) / 0.002f,
              1e-3f);
  expect_near(glm::normalize(glm::cross(q.dPdu, q.dPdv)), glm::normalize(q.N), 1e-5f);
}

TEST(Points, cover_their_area) {
  Rendered r =
      render_text("Format 100 100 1 ScreenWindow 0 1 0 1 PixelSamples 4 4 WorldBegin Translate 0 0 1 Points "
                  "\"P\" [.5 .5 0] \"constantwidth\" [.8] WorldEnd");
  EXPECT_NEAR(r.covered(), kPi * 1600, kPi * 16);
}

TEST(Curves, a_bad_curve_is_left_out_alone) {
  const std::string first = "0 0 0 1 0 0 2 0 0 3 0 0 ", last = "0 1 0 1 1 0 2 1 0 3 1 0 ";
  Rendered r = render_text("Format 4 4 1 WorldBegin\nCurves \"cubic\" [4 3 4 4] \"nonperiodic\" \"P\" [" +
                           first + "7 7 7 7 7 7 7 7 7 0 0 0 1e39 0 0 1 0 0 2 0 0 " + last +
                           "] \"uniform float f\" [3 9 9 4] \"varying float y\" [0 1 9 9 9 9 5 6] "
                           "\"vertex float x\" [0 1 2 3 9 9 9 9 9 9 9 4 5 6 7] WorldEnd");
  EXPECT_THAT(r.messages,
              HasSubstr(":2:16: warning: Curves: 2 of 4 curves cannot be drawn and are left out; the "
                        "first, curve 1, counted from 0, has 3 points, where 4 are needed"));
  ASSERT_EQ(r.scene.primitives.size(), 2u);
  const Primitive& other = r.scene.primitives[1];
  expect_near(at(other, 0.5f, 0.5f).P, {1.5f, 1, 0});
  EXPECT_FLOAT_EQ(value(other, "f", 0, 0), 4);
  EXPECT_FLOAT_EQ(value(other, "y", 0.2f, 0.5f), 5.5f);
  EXPECT_FLOAT_EQ(value(other, "x", 0.2f, 0.5f), 5.5f);
  EXPECT_THAT(
      messages_of("WorldBegin Curves \"linear\" [2 2] \"nonperiodic\" \"P\" [0 0 0 1 0 0 0 1 0 1e39 0 0] "
                  "WorldEnd"),
      HasSubstr("curve 1, counted from 0, has a point that is not finite, 1"));
}

TEST(Curves, messages) {
  auto message = [](const std::string& rib) { return messages_of("WorldBegin " + rib + " WorldEnd"); };
  EXPECT_THAT(message("Curves \"spiral\" [4] \"periodic\""),
              HasSubstr("error: Curves: unknown type \"spiral\"; expected \"linear\" or \"cubic\""));
  EXPECT_THAT(
      message("Curves \"cubic\" [3] \"periodic\" \"P\" [0 0 0 1 1 1 2 2 2]"),
      HasSubstr("1 of 1 curves cannot be drawn and is left out; curve 0, counted from 0, has 3 points, "
                "where 4 are needed"));
  EXPECT_THAT(message("Curves \"linear\" [-1] \"nonperiodic\" \"P\" []"), HasSubstr("a curve has -1 points"));
  EXPECT_THAT(message("Points \"width\" []"), HasSubstr("Points: \"P\" is missing"));
}

} // namespace
} // namespace render::testing
