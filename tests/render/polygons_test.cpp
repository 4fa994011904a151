// Triangulation, concave polygons and holes, variables of faces and corners.
#include "render/prims/polygons.h"

#include "render/prims/motion.h"
#include "render/prims/triangulate.h"
#include "tests/render/surface_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace render::testing {
namespace {

using ::testing::HasSubstr;
using Points = std::vector<glm::dvec2>;

/// Checks that all triangles turn like the outline, and returns twice their area.
double covered(const Points& points, const std::vector<int>& loops) {
  double sum = 0, sign = loop_area({points.data(), static_cast<size_t>(loops[0])}) < 0 ? -1 : 1;
  for (const Triangle& t : triangulate(points, loops)) {
    Points corners;
    for (int i : t)
      corners.push_back(points[static_cast<size_t>(i)]);
    double area = loop_area(corners);
    EXPECT_GT(area * sign, 0);
    sum += area;
  }
  return sum;
}

TEST(Triangulate, concave_outlines) {
  Points arrow{{0, 0}, {4, 0}, {4, 4}, {2, 1}};
  EXPECT_DOUBLE_EQ(covered(arrow, {4}), loop_area(arrow));
  Points comb;
  for (int i = 0; i < 9; ++i)
    comb.push_back({i, i % 2 ? 1 : 10});
  comb.push_back({8, 0});
  comb.push_back({0, 0});
  EXPECT_DOUBLE_EQ(covered(comb, {11}), loop_area(comb));
  std::reverse(comb.begin(), comb.end());
  EXPECT_DOUBLE_EQ(covered(comb, {11}), loop_area(comb));
}

TEST(Triangulate, holes_whatever_way_they_turn) {
  Points p{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {1, 1}, {1, 3}, {3, 3}, {3, 1},
           {5, 5}, {8, 5},  {8, 8},   {5, 8},  {1, 5}, {2, 6}, {1, 7}};
  // The square, less two squares and a triangle, each counted twice.
  EXPECT_DOUBLE_EQ(covered(p, {4, 4, 4, 3}), 200 - 8 - 18 - 2);
  // Holes that touch the outline and each other's level.
  Points touching{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {4, 2}, {3, 1}, {3, 3}, {1, 2}, {2, 1}, {2, 3}};
  EXPECT_NEAR(covered(touching, {4, 3, 3}), 32 - 2 - 2, 1e-12);
}

TEST(Triangulate, random_stars_with_a_hole) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(2, 10), small(0.2, 1.9);
  for (int run = 0; run < 200; ++run) {
    Points p;
    for (int i = 0; i < 24; ++i) {
      double a = i * 2 * M_PI / 24, r = radius(random);
      p.push_back({r * std::cos(a), r * std::sin(a)});
    }
    for (int i = 0; i < 11; ++i) {
      double a = i * 2 * M_PI / 11, r = small(random);
      p.push_back({r * std::cos(a), r * std::sin(a)});
    }
    double wanted = loop_area({p.data(), 24}) - loop_area({p.data() + 24, 11});
    EXPECT_NEAR(covered(p, {24, 11}), wanted, 1e-9) << run;
  }
}

TEST(Triangulate, ends_on_nonsense) {
  double nan = std::nan("");
  EXPECT_LE(triangulate(Points{{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0.5, 2}}, std::vector{5}).size(), 3u);
  EXPECT_TRUE(triangulate(Points{{nan, 0}, {1, nan}, {nan, nan}, {0, 1}}, std::vector{4}).empty());
  EXPECT_TRUE(triangulate(Points(50, glm::dvec2(1, 1)), std::vector{30, 20}).empty());
  EXPECT_TRUE(triangulate(Points{{0, 0}, {1, 1}}, std::vector{2}).empty());
}

/// Area and, in `sum`, the integral of a variable's first component, by the corners of the (flat) patches.
double area_of(const Scene& s, std::string_view name = "", double* sum = nullptr) {
  double area = 0;
  for (const Primitive& p : s.primitives) {
    constexpr int kSteps = 64; // exact for bilinear functions: midpoint rule
    for (int j = 0; j < kSteps; ++j)
      for (int i = 0; i < kSteps; ++i) {
        float u = (static_cast<float>(i) + 0.5f) / kSteps, v = (static_cast<float>(j) + 0.5f) / kSteps;
        SurfaceLattice l;
        p.geometry->evaluate({{&u, 1}, {&v, 1}}, l);
        double a = l.N[0].z / kSteps / kSteps;
        area += a;
        for (const PatchVar& var : p.vars)
          if (sum && var.name == name) {
            std::vector<float> value(var.width());
            interpolate(var, {{&u, 1}, {&v, 1}}, value.data(), 1);
            *sum += value[0] * a;
          }
      }
  }
  return area;
}

TEST(Polygons, faces_share_what_their_mesh_holds) {
  Scene s = scene_of("PointsPolygons [4 3] [0 1 2 3 0 2 4] \"P\" [0 0 0 1 0 0 1 1 0 0 1 0 -1 1 0] "
                     "\"varying float heat\" [0 1 2 3 4] \"uniform float f\" [5 6]");
  ASSERT_EQ(s.primitives.size(), 2u);
  for (const Primitive& p : s.primitives) {
    EXPECT_EQ(p.vars.source(), s.primitives[0].vars.source());
    EXPECT_EQ(p.state, s.primitives[0].state);
  }
  // Scenes have millions: a face is what its mesh keeps of it, and no more.
  EXPECT_EQ(s.primitives.runs().size(), 1u);
  // A mesh outlives the scene as long as a list has it.
  const PrimitiveList list = s.primitives;
  s = {};
  SurfaceLattice l;
  float one = 1;
  list[1].geometry->evaluate({{&one, 1}, {&one, 1}}, l);
  EXPECT_EQ(l.P[0], Vec3(-1, 1, 0));
}

TEST(Polygons, triangles_begin_with_their_shortest_side) {
  // Each corner in turn is the one opposite to it: a needle takes few points, whatever its first corner.
  for (const char* P : {"0 0 0 .1 0 0 0 4 0", "0 4 0 0 0 0 .1 0 0", ".1 0 0 0 4 0 0 0 0"}) {
    const Scene s = scene_of(std::string("Polygon \"P\" [") + P + "]");
    ASSERT_EQ(s.primitives.size(), 1u);
    const Primitive p = s.primitives[0];
    for (float u : {0.0f, 0.3f, 1.0f}) {
      EXPECT_NEAR(at(p, u, 0).P.x, 0.1f * u, 1e-7f) << P;
      EXPECT_EQ(at(p, u, 1).P, Vec3(0, 4, 0)) << P;
      EXPECT_GT(at(p, u, 1).N.z, 0) << P; // also at the corner that is a side
    }
    EXPECT_NEAR(area_of(s), 0.2, 1e-6);
    const Rendered r = render_text(std::string("Format 100 100 1 ScreenWindow 0 5 0 5 WorldBegin "
                                               "Translate 0 0 1 Polygon \"P\" [") +
                                   P + "] WorldEnd");
    EXPECT_LT(r.report.shaded_points, 400u);
  }
}

TEST(Polygons, shapes_of_a_moving_triangle_have_the_same_corners) {
  // Its shortest side is not that of its other shape. Halfway, corner by corner, it is a third triangle.
  for (const std::string request : {"Polygon", "PointsPolygons [3] [0 1 2]"}) {
    const std::string moving = "MotionBegin [0 1] " + request + " \"P\" [0 0 0 4 0 0 0 1 0] " + request +
                               " \"P\" [0 0 0 1 0 0 0 4 0] MotionEnd ";
    const std::string start = "Format 4 4 1 Shutter 0 1 WorldBegin ";
    const Scene s = render_text(start + moving + "WorldEnd").scene;
    ASSERT_EQ(s.primitives.size(), 1u);
    const Primitive p = s.primitives[0];
    ASSERT_EQ(p.deformation.size(), 2u);
    const Primitive half = primitive_at(p, 0.5f);
    EXPECT_EQ(at(half, 0, 0).P, Vec3(0, 0, 0));
    EXPECT_EQ(at(half, 1, 0).P, Vec3(2.5f, 0, 0));
    EXPECT_EQ(at(half, 0, 1).P, Vec3(0, 2.5f, 0));
    // The same mesh where nothing moves has its own.
    const Scene both =
        render_text(start + request + " \"P\" [0 0 0 4 0 0 0 1 0] " + moving + "WorldEnd").scene;
    EXPECT_EQ(at(both.primitives[0], 0, 0).P, Vec3(0, 1, 0));
    EXPECT_EQ(at(primitive_at(both.primitives[1], 1), 0, 1).P, Vec3(0, 4, 0));
  }
}

TEST(Polygons, concave_polygons_keep_their_shape_and_variables) {
  double heat = 0;
  Scene s = scene_of("Polygon \"P\" [0 0 0 4 0 0 4 4 0 2 1 0] \"varying float heat\" [0 4 4 2]");
  EXPECT_NEAR(area_of(s, "heat", &heat), 6, 1e-5);
  // heat is x: area times the centroid's x of the triangles (0,0)(4,0)(2,1) and (4,0)(4,4)(2,1).
  EXPECT_NEAR(heat, 2 * 2 + 4 * (10.0 / 3), 1e-3);
}

TEST(Polygons, holes_are_left_out_of_the_picture) {
  Scene s = scene_of("GeneralPolygon [4 4] \"P\" [0 0 0 6 0 0 6 6 0 0 6 0 2 2 0 4 2 0 4 4 0 2 4 0]");
  EXPECT_NEAR(area_of(s), 32, 1e-4);
  // In the image: a frame around a square hole.
  Rendered r =
      render_text("Format 60 60 1 ScreenWindow 0 6 0 6 WorldBegin Translate 0 0 1 GeneralPolygon [4 4] "
                  "\"P\" [0 0 0 6 0 0 6 6 0 0 6 0 2 2 0 4 2 0 4 4 0 2 4 0] WorldEnd");
  EXPECT_NEAR(r.covered(), 3600 - 400, 3600 * 0.01);
  EXPECT_EQ(r.alpha(30, 30), 0);
  EXPECT_EQ(r.alpha(10, 30), 1);
}

TEST(Polygons, many_faces_with_holes_and_variables_of_face_and_corner) {
  std::string rib = "PointsGeneralPolygons [2 1] [4 3 3] [0 1 2 3 4 5 6 1 7 2] "
                    "\"P\" [0 0 0 4 0 0 4 4 0 0 4 0 1 1 0 2 1 0 1 2 0 8 0 0] "
                    "\"uniform float id\" [10 20] \"facevarying float f\" [1 1 1 1 1 1 1 3 3 3] "
                    "\"constant color c\" [1 0 0]";
  double id = 0, f = 0;
  EXPECT_NEAR(area_of(scene_of(rib), "id", &id), 16 - 0.5 + 8, 1e-4);
  EXPECT_NEAR(id, 15.5 * 10 + 8 * 20, 1e-2);
  area_of(scene_of(rib), "f", &f);
  EXPECT_NEAR(f, 15.5 + 24, 1e-3);
}

TEST(Polygons, empty_meshes_and_faces_without_area) {
  for (std::string nothing : {"PointsPolygons [] [] \"P\" []", "PointsPolygons [] [] \"P\" [1 2 3]",
                              "PointsGeneralPolygons [] [] [] \"P\" []",
                              "SubdivisionMesh \"catmull-clark\" [] [] [] [] [] [] \"P\" []"})
    EXPECT_EQ(scene_of(nothing).primitives.size(), 0u) << nothing;
  // A point and an edge among the faces: the square keeps its own uniform value. They are warned of.
  Rendered r = render_text("Format 4 4 1 WorldBegin PointsPolygons [1 4 2 0] [0 0 1 2 3 1 2] \"P\" "
                           "[0 0 0 2 0 0 2 2 0 0 2 0] \"uniform float id\" [1 2 3 4] WorldEnd");
  EXPECT_THAT(r.messages,
              HasSubstr("3 of 4 faces cannot be drawn and are left out; the first, face 0, counted from "
                        "0, has 1 vertex"));
  double id = 0;
  EXPECT_NEAR(area_of(r.scene, "id", &id), 4, 1e-6);
  EXPECT_NEAR(id, 4 * 2, 1e-6);
}

TEST(Polygons, a_bad_face_is_left_out_alone) {
  // A vertex that does not exist, a point that is no number, and two squares, by whatever list of faces.
  const std::string p = " \"P\" [0 0 0 2 0 0 2 2 0 0 2 0 5 5 0 1e39 0 0 5 7 0 3 7 0] "
                        "\"uniform float id\" [1 2 3 4] \"facevarying float f\" "
                        "[1 1 1 1 7 7 7 9 9 9 2 2 2 2] ";
  for (const std::string& list :
       {std::string("PointsPolygons "), std::string("PointsGeneralPolygons [1 1 1 1] "),
        std::string("SubdivisionMesh \"bilinear\" ")}) {
    const bool subdivision = list.starts_with("Sub");
    Rendered r = render_text("Format 4 4 1 WorldBegin " + list + "[4 3 3 4] [0 1 2 3 0 1 8 0 1 5 1 4 6 2] " +
                             (subdivision ? "[\"interpolateboundary\"] [0 0] [] []" : "") + p + " WorldEnd");
    EXPECT_THAT(r.messages, HasSubstr(":1:")); // the line
    EXPECT_THAT(r.messages, HasSubstr("2 of 4 faces cannot be drawn and are left out; the first, face 1, "
                                      "counted from 0, has the vertex 8, and there are 8"));
    double id = 0, f = 0;
    const double area = area_of(r.scene, "id", &id);
    area_of(r.scene, "f", &f);
    // N of subdivision surfaces has length 1: each face counts 1.
    const double first = subdivision ? 1 : 4, other = area - first;
    EXPECT_GT(other, 0.9) << list;
    EXPECT_NEAR(id, first * 1 + other * 4, 1e-4) << list;
    EXPECT_NEAR(f, first * 1 + other * 2, 1e-4) << list;
  }
  Rendered nan =
      render_text("Format 4 4 1 WorldBegin PointsPolygons [3] [0 1 2] \"P\" [0 0 0 1e39 0 0 0 1 0] "
                  "WorldEnd");
  EXPECT_THAT(nan.messages, HasSubstr("face 0, counted from 0, has a point that is not finite, 1"));
}

TEST(Subdivision, holes_are_those_of_the_faces_that_were_meant) {
  Rendered r =
      render_text("Format 4 4 1 WorldBegin SubdivisionMesh \"bilinear\" [2 4 4] [0 1 0 1 2 3 1 4 5 2] "
                  "[\"interpolateboundary\" \"hole\"] [0 0 1 0] [1] [] \"uniform float id\" [1 2 3] "
                  "\"P\" [0 0 0 1 0 0 1 1 0 0 1 0 3 0 0 3 1 0] WorldEnd");
  double id = 0;
  EXPECT_NEAR(area_of(r.scene, "id", &id), 1, 1e-5); // one face, each of which counts 1
  EXPECT_NEAR(id, 3, 1e-5);
}

TEST(Polygons, messages_of_general_polygons) {
  auto message = [](const std::string& rib) { return messages_of("WorldBegin " + rib + " WorldEnd"); };
  EXPECT_THAT(message("GeneralPolygon [3 2] \"P\" [0 0 0 1 0 0 0 1 0 0 0 0 1 1 0]"),
              HasSubstr("GeneralPolygon: a polygon has at least 3 vertices, found 2"));
  EXPECT_THAT(message("GeneralPolygon [] \"P\" []"),
              HasSubstr("a polygon has at least one loop of vertices"));
  EXPECT_THAT(message("PointsGeneralPolygons [2] [3] [0 1 2] \"P\" [0 0 0 1 0 0 0 1 0]"),
              HasSubstr("'nloops' must be positive and add up to the 1 loops of 'nvertices'"));
  EXPECT_THAT(message("PointsGeneralPolygons [1] [3] [0 1] \"P\" [0 0 0 1 0 0 0 1 0]"),
              HasSubstr("'nvertices' asks for 3 vertex numbers, found 2"));
}

} // namespace
} // namespace render::testing
