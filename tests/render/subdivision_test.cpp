// Subdivision surfaces: limit points and normals against the formulas of Catmull-Clark, tags, variables of
// every class, messages.
#include "render/prims/subdivision.h"

#include "tests/render/surface_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace render::testing {
namespace {

using ::testing::HasSubstr;

std::string message(const std::string& rib) {
  return messages_of("WorldBegin " + rib + " WorldEnd");
}

/// A cube of side 2, each face's normal outwards by Du(P) x Dv(P).
const char kCubeFaces[] = "[4 4 4 4 4 4] [0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5] ";
const char kCubeP[] = "\"P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1] ";

/// n x m quads over [0,n] x [0,m].
std::string sheet(int n, int m, const std::string& tags, const std::string& vars = "") {
  std::string counts, vertices, P;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) {
      P += std::to_string(i) + " " + std::to_string(j) + " 0 ";
      if (i == n || j == m) continue;
      int k = j * (n + 1) + i;
      counts += "4 ";
      for (int c : {k, k + 1, k + n + 2, k + n + 1})
        vertices += std::to_string(c) + " ";
    }
  return "SubdivisionMesh \"catmull-clark\" [" + counts + "] [" + vertices + "] " + tags + " \"P\" [" + P +
         "] " + vars;
}

const char kBoundary[] = "[\"interpolateboundary\"] [1 0] [1] [] ";

TEST(Subdivision, limit_points_and_normals_of_a_cube) {
  Scene s = scene_of(std::string("SubdivisionMesh \"catmull-clark\" ") + kCubeFaces + kCubeP);
  ASSERT_EQ(s.primitives.size(), 6u);
  for (const Primitive& p : s.primitives) {
    // A vertex of valence 3: (n^2 v + 4 sum e + sum f) / (n (n + 5)); its neighbours add up to v, the
    // far corners of its faces to -v.
    SurfacePoint corner = at(p, 0, 0);
    Vec3 v = glm::sign(corner.P);
    Vec3 limit = (9.0f * v + 4.0f * v - v) / 24.0f;
    expect_near(corner.P, limit, 1e-4f);
    expect_near(glm::normalize(corner.N), glm::normalize(v), 1e-3f);
    SurfacePoint middle = at(p, 0.5f, 0.5f);
    // By symmetry the middle is on an axis and its normal along it.
    expect_near(glm::normalize(middle.N), glm::normalize(middle.P), 1e-4f);
    for (float u : {0.2f, 0.9f}) {
      SurfacePoint q = at(p, u, 0.3f), next = at(p, u + 1e-3f, 0.3f), before = at(p, u - 1e-3f, 0.3f);
      expect_near(q.dPdu, (next.P - before.P) / 2e-3f, 3e-3f);
      Box b = p.geometry->bound({u - 0.05f, u + 0.05f, 0.25f, 0.35f});
      for (int k = 0; k < 3; ++k)
        EXPECT_TRUE(q.P[k] >= b.min[k] && q.P[k] <= b.max[k]);
    }
  }
}

// The whole of a mesh is round enough: 11 by 12 faces need not be cut in 16 each, which 3 by 3 are.
TEST(Subdivision, faces_of_meshes_of_many_may_be_one_micropolygon) {
  for (const Primitive& p : scene_of(sheet(11, 12, kBoundary)).primitives)
    EXPECT_EQ(p.geometry->coarsest(), (std::array<int, 2>{1, 1}));
  for (const Primitive& p : scene_of(sheet(3, 3, kBoundary)).primitives)
    EXPECT_EQ(p.geometry->coarsest(), (std::array<int, 2>{4, 4}));
}

TEST(Subdivision, neighbouring_faces_meet) {
  Scene s = scene_of(std::string("SubdivisionMesh \"catmull-clark\" ") + kCubeFaces + kCubeP);
  // The sum over all faces of the volumes over the origin, by the divergence theorem, is that of a closed
  // body.
  double volume = 0;
  Vec3 area(0.0f);
  constexpr int kSteps = 24;
  for (const Primitive& p : s.primitives)
    for (int j = 0; j < kSteps; ++j)
      for (int i = 0; i < kSteps; ++i) {
        SurfacePoint q =
            at(p, (static_cast<float>(i) + 0.5f) / kSteps, (static_cast<float>(j) + 0.5f) / kSteps);
        Vec3 n = glm::cross(q.dPdu, q.dPdv) / float(kSteps * kSteps);
        area += n;
        volume += static_cast<double>(glm::dot(q.P, n)) / 3;
      }
  expect_near(area, {0, 0, 0}, 1e-4f);
  EXPECT_GT(volume, 0);
  EXPECT_LT(volume, 4.18);
}

TEST(Subdivision, regular_faces_are_b_splines) {
  Scene s = scene_of(sheet(3, 3, ""));
  // Without interpolateboundary only the middle face has a surface.
  ASSERT_EQ(s.primitives.size(), 1u);
  expect_near(at(s.primitives[0], 0.25f, 0.75f).P, {1.25f, 1.75f, 0});
  expect_near(at(s.primitives[0], 0.25f, 0.75f).dPdu, {1, 0, 0}, 1e-4f);
}

TEST(Subdivision, boundaries_are_interpolated) {
  Scene corners = scene_of(sheet(2, 2, kBoundary));
  ASSERT_EQ(corners.primitives.size(), 4u);
  expect_near(at(corners.primitives[0], 0, 0).P, {0, 0, 0});
  Scene edges = scene_of(sheet(2, 2, "[\"interpolateboundary\"] [1 0] [2] [] "));
  // The corner of an edge-only boundary: (p[-1] + 4 p + p[1]) / 6 along the border.
  expect_near(at(edges.primitives[0], 0, 0).P, {1 / 6.0f, 1 / 6.0f, 0}, 1e-4f);
  EXPECT_THAT(message(sheet(1, 1, "")),
              HasSubstr("warning: SubdivisionMesh: no face has a surface; a mesh with an open "
                        "boundary needs the tag \"interpolateboundary\""));
}

TEST(Subdivision, holes_creases_and_corners) {
  auto cube = [](const std::string& tags) {
    return scene_of(std::string("SubdivisionMesh \"catmull-clark\" ") + kCubeFaces + tags + kCubeP);
  };
  EXPECT_EQ(cube("[\"hole\"] [2 0] [0 3] [] ").primitives.size(), 4u);
  Scene corner = cube("[\"corner\"] [1 1] [0] [10] ");
  expect_near(at(corner.primitives[0], 0, 0).P, {-1, -1, -1}, 1e-4f);
  // A closed infinitely sharp crease round the face z = -1: its outline is the cubic b-spline of the square.
  Scene crease = cube("[\"crease\"] [5 1] [0 2 3 1 0] [10] ");
  expect_near(at(crease.primitives[0], 0, 0).P, Vec3(-4 / 6.0f, -4 / 6.0f, -1), 1e-4f);
  expect_near(at(crease.primitives[0], 0.5f, 0).P, {-44 / 48.0f, 0, -1}, 1e-4f);
}

TEST(Subdivision, triangles_smoother) {
  auto edge_of_tetrahedron = [](const std::string& tags) {
    const std::string rib = "SubdivisionMesh \"catmull-clark\" [3 3 3 3] [0 1 2 0 3 1 1 3 2 2 3 0] " + tags +
                            "\"P\" [1 1 1 -1 -1 1 -1 1 -1 1 -1 -1]";
    EXPECT_EQ(message(rib), "");
    return glm::length(at(scene_of(rib).primitives[0], 1, 0).P); // the middle of an edge, by symmetry
  };
  const float plain = edge_of_tetrahedron("");
  EXPECT_EQ(edge_of_tetrahedron("[\"smoothtriangles\"] [1 0] [0] [] "), plain);
  // The weight of the faces' middles in that of an edge is 0.470 instead of 1/4, and these lie further in.
  EXPECT_LT(edge_of_tetrahedron("[\"smoothtriangles\"] [1 1] [1] [1] "), plain - 0.01f);
}

TEST(Subdivision, faces_with_any_number_of_corners) {
  // A tetrahedron: three quarters a face.
  Scene s = scene_of("SubdivisionMesh \"catmull-clark\" [3 3 3 3] [0 1 2 0 3 1 1 3 2 2 3 0] \"P\" "
                     "[1 1 1 -1 -1 1 -1 1 -1 1 -1 -1] \"facevarying float f\" [1 2 3 1 4 2 2 4 3 3 4 1]");
  ASSERT_EQ(s.primitives.size(), 12u);
  for (const Primitive& p : s.primitives)
    EXPECT_NEAR(std::abs(glm::dot(glm::normalize(at(p, 0, 0).N), glm::normalize(at(p, 0, 0).P))), 1, 1e-3f);
  EXPECT_NEAR(value(s.primitives[0], "f", 0, 0), 1, 1e-6f);
  EXPECT_NEAR(value(s.primitives[0], "f", 1, 1), 2, 1e-6f);
  EXPECT_NEAR(value(s.primitives[0], "f", 1, 0), 1.5f, 1e-6f);
  EXPECT_NEAR(value(s.primitives[0], "f", 0, 1), 2, 1e-6f);
  // A quadrilateral among triangles comes in quarters, too, and these meet.
  Scene mixed = scene_of(
      "SubdivisionMesh \"catmull-clark\" [4 3] [0 1 2 3 1 4 2] [\"interpolateboundary\"] [0 0] [] [] "
      "\"P\" [0 0 0 1 0 0 1 1 0 0 1 0 2 0 0] \"varying float x\" [0 1 1 0 2]");
  ASSERT_EQ(mixed.primitives.size(), 7u);
  expect_near(at(mixed.primitives[0], 1, 0.7f).P, at(mixed.primitives[1], 0.7f, 1).P, 1e-5f);
  EXPECT_NEAR(value(mixed.primitives[2], "x", 0, 0), 1, 1e-6f);
  for (const Primitive& p : mixed.primitives)
    EXPECT_GT(at(p, 0.5f, 0.5f).N.z, 0);
}

TEST(Subdivision, variables_of_every_class) {
  std::string vars = "\"uniform float f\" [0 1 2 3 4 5 6 7 8] \"constant float c\" [9] \"vertex float x\" [";
  std::string varying = "\"varying float y\" [", corners = "\"facevarying float g\" [";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      vars += std::to_string(i) + " ";
      varying += std::to_string(i * i) + " ";
    }
  for (int k = 0; k < 9; ++k)
    corners += std::to_string(k) + " " + std::to_string(k + 1) + " " + std::to_string(k + 1) + " " +
               std::to_string(k) + " ";
  Scene s = scene_of(sheet(3, 3, kBoundary,
                           vars + "] " + varying + "] " + corners + "] \"vertex float[2] a\" [" +
                               std::string("1 2 1 2 1 2 1 2 1 2 1 2 1 2 1 2 ") +
                               "1 2 1 2 1 2 1 2 1 2 1 2 1 2 1 2 ]"));
  ASSERT_EQ(s.primitives.size(), 9u);
  const Primitive& middle = s.primitives[4];
  EXPECT_FLOAT_EQ(value(middle, "f", 0.5f, 0.5f), 4);
  EXPECT_FLOAT_EQ(value(middle, "c", 0.5f, 0.5f), 9);
  EXPECT_NEAR(value(middle, "x", 0.25f, 0.5f), 1.25f, 1e-5f);
  EXPECT_NEAR(value(middle, "y", 0.5f, 0.5f), 2.5f, 1e-5f);
  EXPECT_NEAR(value(middle, "g", 0.25f, 0.5f), 4.25f, 1e-5f);
  EXPECT_NEAR(value(middle, "a", 0.25f, 0.5f), 1, 1e-5f);
}

TEST(Subdivision, facevarying_values_may_be_smoothed) {
  auto g = [](int mode) {
    std::string corners = "\"facevarying float g\" [";
    for (int k = 0; k < 9; ++k) {
      int i = k % 3;
      for (int c : {i, i + 1, i + 1, i})
        corners += std::to_string(c * c) + " ";
    }
    Scene s = scene_of(sheet(3, 3,
                             "[\"interpolateboundary\" \"facevaryinginterpolateboundary\"] [1 0 1 0] [1 " +
                                 std::to_string(mode) + "] [] ",
                             corners + "]"));
    return value(s.primitives[4], "g", 0, 0.5f);
  };
  EXPECT_NEAR(g(0), 1, 1e-5f);                  // linear: the value itself
  EXPECT_NEAR(g(2), (0 + 4 + 4) / 6.0f, 1e-4f); // smooth: (0 + 4 * 1 + 4) / 6
}

TEST(Subdivision, bilinear_scheme) {
  Scene s = scene_of("SubdivisionMesh \"bilinear\" [4] [0 1 2 3] [\"interpolateboundary\"] [0 0] [] [] \"P\" "
                     "[0 0 0 1 0 0 1 1 1 0 1 0]");
  ASSERT_EQ(s.primitives.size(), 1u);
  expect_near(at(s.primitives[0], 0.5f, 0.5f).P, {0.5f, 0.5f, 0.25f});
}

TEST(Subdivision, survives_any_faces) {
  std::mt19937 random(3);
  for (int run = 0; run < 200; ++run) {
    std::string counts, vertices, P, f;
    int faces = 1 + static_cast<int>(random() % 6), points = 4 + static_cast<int>(random() % 4);
    for (int i = 0; i < faces; ++i) {
      int n = 3 + static_cast<int>(random() % 4);
      counts += std::to_string(n) + " ";
      for (int k = 0; k < n; ++k) {
        vertices += std::to_string(random() % static_cast<unsigned>(points)) + " ";
        f += std::to_string(random() % 3) + " ";
      }
    }
    vertices += std::to_string(points - 1) + " ";
    vertices += "0 1 "; // a face that uses the last point
    counts += "3 ";
    f += "0 1 2 ";
    for (int i = 0; i < 3 * points; ++i)
      P += std::to_string(static_cast<int>(random() % 9) - 4) + " ";
    Rendered r = render_text("Format 8 8 1 WorldBegin Translate 0 0 9 SubdivisionMesh \"catmull-clark\" [" +
                             counts + "] [" + vertices +
                             "] [\"interpolateboundary\" \"facevaryinginterpolateboundary\"] "
                             "[0 0 1 0] [1] [] \"P\" [" +
                             P + "] \"facevarying float f\" [" + f + "] WorldEnd");
    EXPECT_EQ(r.messages.find("error"), std::string::npos) << r.messages;
  }
}

TEST(Subdivision, messages) {
  std::string cube = std::string("SubdivisionMesh \"catmull-clark\" ") + kCubeFaces;
  EXPECT_THAT(message(cube + "[\"crease\"] [2] [0 1] [3] " + kCubeP),
              HasSubstr("error: SubdivisionMesh: 'nargs' takes two numbers for each of 1 tags, found 1"));
  EXPECT_THAT(message(cube + "[\"crease\"] [3 1] [0 1] [3] " + kCubeP),
              HasSubstr("there are fewer numbers than 'nargs' says for \"crease\""));
  EXPECT_THAT(
      message(cube + "[\"crease\"] [2 1] [0 99] [3] " + kCubeP),
      HasSubstr("warning: SubdivisionMesh: tag \"crease\": a number is not that of a vertex; it is skipped"));
  EXPECT_THAT(message(cube + "[\"crease\"] [1 1] [0] [3] " + kCubeP),
              HasSubstr("a crease has at least 2 vertices"));
  EXPECT_THAT(message(cube + "[\"crease\"] [2 0] [0 1] [] " + kCubeP),
              HasSubstr("a crease takes one sharpness, or one for each edge"));
  EXPECT_THAT(message(cube + "[\"corner\"] [2 0] [0 1] [] " + kCubeP),
              HasSubstr("corners take one sharpness, or one each"));
  EXPECT_THAT(message(cube + "[\"hole\"] [1 0] [6] [] " + kCubeP),
              HasSubstr("a number is not that of a face"));
  EXPECT_THAT(message(cube + "[\"interpolateboundary\"] [1 0] [3] [] " + kCubeP),
              HasSubstr("the value is 0, 1 or 2"));
  EXPECT_THAT(message(cube + "[\"facevaryinginterpolateboundary\"] [1 0] [4] [] " + kCubeP),
              HasSubstr("the value is 0, 1, 2 or 3"));
  EXPECT_THAT(message(cube + "[\"wrinkle\"] [0 0] [] [] " + kCubeP),
              HasSubstr("tag \"wrinkle\": this tag is not known and has no effect; it is skipped"));
  EXPECT_THAT(message(std::string("SubdivisionMesh \"butterfly\" ") + kCubeFaces + kCubeP),
              HasSubstr("scheme \"butterfly\" is not known; read as \"catmull-clark\""));
  std::string many = "SubdivisionMesh \"catmull-clark\" [70000] [", P;
  for (int i = 0; i < 70000; ++i) {
    many += std::to_string(i) + " ";
    P += std::to_string(i) + " 0 0 ";
  }
  EXPECT_THAT(
      message(many + "] \"P\" [" + P + "]"),
      HasSubstr("the faces do not make a mesh: one has too many corners, or a vertex too many edges"));
}

TEST(Subdivision, loop_scheme_of_triangles) {
  // An octahedron. Limit of a vertex of valence n: (1 - n w) v + w (sum of neighbours), w = 1 / (n + 3 / (8
  // b)), n b = 5/8 - (3/8 + cos(2 pi / n) / 4)^2 (Loop 1987); here the neighbours' sum is 0.
  Scene s =
      scene_of("SubdivisionMesh \"loop\" [3 3 3 3 3 3 3 3] [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5] "
               "\"P\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1] \"vertex float x\" [1 -1 0 0 0 0] "
               "\"facevarying float f\" [0 1 2 0 1 2 0 1 2 0 1 2 0 1 2 0 1 2 0 1 2 0 1 2] "
               "\"uniform float k\" [0 1 2 3 4 5 6 7]");
  ASSERT_EQ(s.primitives.size(), 24u);
  double b = (5 / 8.0 - 9 / 64.0) / 4, w = 1 / (4 + 3 / (8 * b));
  expect_near(at(s.primitives[0], 0, 0).P, {static_cast<float>(1 - 4 * w), 0, 0}, 1e-5f);
  expect_near(at(s.primitives[2], 0, 0).P, {0, 0, static_cast<float>(1 - 4 * w)}, 1e-5f);
  for (const Primitive& p : s.primitives)
    for (float u : {0.0f, 0.3f, 1.0f})
      for (float v : {0.0f, 0.8f, 1.0f}) {
        SurfacePoint q = at(p, u, v);
        // Convex, round the origin; the variable goes the way of P; tangents agree with differences.
        EXPECT_GT(std::abs(glm::dot(glm::normalize(q.N), glm::normalize(q.P))), 0.9f);
        EXPECT_NEAR(value(p, "x", u, v), q.P.x, 1e-5f);
        float h = u < 0.5f ? 0.01f : -0.01f, g = v < 0.5f ? 0.01f : -0.01f;
        expect_near((at(p, u + h, v).P - q.P) / h, q.dPdu, 0.02f);
        expect_near((at(p, u, v + g).P - q.P) / g, q.dPdv, 0.02f);
      }
  // The parts of a face meet in its middle, those of two faces along their side.
  expect_near(at(s.primitives[0], 1, 1).P, at(s.primitives[1], 1, 1).P, 1e-5f);
  expect_near(at(s.primitives[0], 1, 0).P, at(s.primitives[1], 0, 1).P, 1e-5f);
  // The side from 2 to 4 of the first face, from 4 to 2 in the second.
  expect_near(at(s.primitives[1], 0.5f, 0).P, at(s.primitives[3], 0, 0.5f).P, 1e-5f);
  EXPECT_NEAR(value(s.primitives[0], "f", 1, 1), 1, 1e-5f);
  EXPECT_EQ(value(s.primitives[23], "k", 0, 0), 7);
  EXPECT_THAT(
      messages_of(
          "WorldBegin SubdivisionMesh \"loop\" [4] [0 1 2 3] \"P\" [0 0 0 1 0 0 1 1 0 0 1 0] WorldEnd"),
      ::testing::HasSubstr("SubdivisionMesh: the scheme \"loop\" takes triangles only"));
}

} // namespace
} // namespace render::testing
