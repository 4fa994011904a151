// Blobbies: fields by hand, operators, the surface of one leaf against the sphere and the capsule it is.
#include "render/prims/blobby.h"

#include "tests/render/surface_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace render::testing {
namespace {

using ::testing::HasSubstr;

BlobbyField field(int leaves, std::vector<int> code, std::vector<float> floats) {
  auto f = BlobbyField::make(leaves, code, floats);
  EXPECT_TRUE(bool(f)) << (f ? "" : f.error());
  return f ? *f : BlobbyField();
}

/// Unit sphere matrices at x = 0 and x = 1, then a constant 0.25.
const std::vector<float> kNumbers{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,    1,
                                  0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0.25f};

double sphere(double r) {
  return r < 1 ? std::pow(1 - r * r, 3) : 0;
}

TEST(Blobby, leaves_and_operators) {
  glm::dvec3 p(0.3, 0.1, 0);
  double a = sphere(std::hypot(0.3, 0.1)), b = sphere(std::hypot(0.7, 0.1)), c = 0.25;
  auto value = [&](std::vector<int> operation) {
    std::vector<int> code{1001, 0, 1001, 16, 1000, 32};
    code.insert(code.end(), operation.begin(), operation.end());
    return field(3, code, kNumbers).at(p);
  };
  EXPECT_NEAR(value({0, 3, 0, 1, 2}), a + b + c, 1e-12);
  EXPECT_NEAR(value({1, 2, 0, 1}), a * b, 1e-12);
  EXPECT_NEAR(value({2, 3, 0, 1, 2}), std::max({a, b, c}), 1e-12);
  EXPECT_NEAR(value({3, 3, 0, 1, 2}), std::min({a, b, c}), 1e-12);
  EXPECT_NEAR(value({4, 0, 2}), a / c, 1e-12);
  EXPECT_NEAR(value({5, 0, 1}), a - b, 1e-12);
  EXPECT_NEAR(value({6, 1}), -b, 1e-12);
  EXPECT_NEAR(value({7, 1}), b, 1e-12);
  EXPECT_NEAR(value({5, 0, 1, 0, 2, 3, 2}), a - b + c, 1e-12); // results count as operands
}

/// Calls `f` with position and unit normal at corners of all pieces; returns the volume inside.
double visit(const Scene& s, const std::function<void(Vec3 P, Vec3 N)>& f) {
  double volume = 0;
  for (const Primitive& p : s.primitives) {
    SurfaceLattice l;
    float ends[2] = {0, 1};
    p.geometry->evaluate(ends, ends, l);
    for (size_t k = 0; k < 4; ++k)
      f(l.P[k], glm::normalize(l.N[k]));
    volume += static_cast<double>(
        glm::dot(l.P[0] + l.P[1] + l.P[2] + l.P[3], glm::cross(l.P[3] - l.P[0], l.P[2] - l.P[1])));
  }
  return volume / 24;
}

TEST(Blobby, one_ellipsoid_is_one_of_half_the_size) {
  Scene s = scene_of("Blobby 1 [1001 0] [2 0 0 0 0 2 0 0 0 0 2 0 5 0 0 1] [\"\"]");
  ASSERT_FALSE(s.primitives.empty());
  double volume = visit(s, [](Vec3 P, Vec3 N) {
    Vec3 from_centre = P - Vec3(5, 0, 0);
    EXPECT_NEAR(glm::length(from_centre), 1, 1e-4f);
    EXPECT_NEAR(glm::dot(N, from_centre), 1, 1e-3f);
  });
  EXPECT_NEAR(volume, 4 * M_PI / 3, 0.05);
}

TEST(Blobby, one_segment_is_a_capsule) {
  Scene s = scene_of("Blobby 1 [1002 0] [0 0 0 0 0 3 1 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] [\"\"]");
  double volume = visit(s, [](Vec3 P, Vec3 N) {
    Vec3 axis(0, 0, std::clamp(P.z, 0.0f, 3.0f));
    EXPECT_NEAR(glm::distance(P, axis), 0.5f, 1e-3f);
    EXPECT_GT(glm::dot(N, P - axis), 0.49f);
  });
  EXPECT_NEAR(volume, M_PI / 4 * 3 + M_PI / 6, 0.05);
}

TEST(Blobby, variables_are_mixed_by_the_leaves) {
  Scene s = scene_of(
      "Blobby 2 [1001 0 1001 16 0 2 0 1] [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 "
      "1 0 0 0 0 1 0 0 0 0 1 0 .8 0 0 1] [\"\"] \"vertex float heat\" [0 1] \"constant float c\" [4]");
  ASSERT_FALSE(s.primitives.empty());
  for (const Primitive& p : s.primitives) {
    SurfaceLattice l;
    float zero = 0;
    p.geometry->evaluate({&zero, 1}, {&zero, 1}, l);
    double x = l.P[0].x, y = std::hypot(l.P[0].y, l.P[0].z);
    double a = sphere(std::hypot(x, y)), b = sphere(std::hypot(x - 0.8, y));
    ASSERT_EQ(p.vars.size(), 2u);
    EXPECT_NEAR(p.vars[0].values[0], b / (a + b), 1e-4);
    EXPECT_EQ(p.vars[1].values[0], 4);
  }
}

TEST(Blobby, the_picture_is_a_disc) {
  Rendered r = render_text(
      "Format 100 100 1 ScreenWindow -1 1 -1 1 PixelSamples 4 4 WorldBegin Translate 0 0 3 Sides 1 "
      "Blobby 1 [1001 0] [1.6 0 0 0 0 1.6 0 0 0 0 1.6 0 0 0 0 1] [\"\"] WorldEnd");
  EXPECT_NEAR(r.covered(), kPi * 1600, kPi * 16);
}

TEST(Blobby, messages) {
  auto message = [](const std::string& arguments) {
    return messages_of("WorldBegin Blobby " + arguments + " [\"\"] WorldEnd");
  };
  EXPECT_THAT(
      message("1 [1001 0] [1 2]"),
      HasSubstr("error: Blobby: a leaf of code 1001 takes 16 numbers; there are 2 from its index on"));
  EXPECT_THAT(message("1 [1001] []"), HasSubstr("a leaf of code 1001 has no index of its numbers"));
  EXPECT_THAT(message("1 [1001 0] [0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0]"),
              HasSubstr("the matrix of a leaf of code 1001 has no inverse"));
  EXPECT_THAT(message("1 [1001 0] [1e99 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0]"),
              HasSubstr("a leaf of code 1001 has a number that is not finite"));
  EXPECT_THAT(message("1 [1002 0] [0 0 0 1 1 1 0 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]"),
              HasSubstr("the radius of a segment is 0; it must be positive"));
  EXPECT_THAT(message("1 [1000 0 0 2 0] [1]"), HasSubstr("operator 0 ends before its operands"));
  EXPECT_THAT(message("1 [1000 0 6 1] [1]"),
              HasSubstr("operator 6 uses result 1, which does not precede it"));
  EXPECT_THAT(message("1 [1000 0 12] [1]"), HasSubstr("unknown code 12"));
  EXPECT_THAT(message("2 [1000 0] [1]"), HasSubstr("'nleaf' is 2, but the code has 1 leaves"));
  EXPECT_THAT(message("1 [1003 0 0] [1 1 1 1]"),
              HasSubstr("warning: Blobby: planes that repel (code 1003) have no effect"));
}

} // namespace
} // namespace render::testing
