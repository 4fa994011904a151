// Patch meshes: steps, wraps and bases against closed forms; variables of every class; the teapot.
#include "render/prims/patch_mesh.h"

#include "render/prims/teapot.h"
#include "render/prims/typed_vars.h"
#include "tests/render/surface_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

using ::testing::HasSubstr;

/// Points (i, j, 0), nu x nv.
std::string flat(int nu, int nv) {
  std::string out = " \"P\" [";
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      out += std::to_string(i) + " " + std::to_string(j) + " 0 ";
  return out + "]";
}

TEST(PatchMesh, bezier_patches_of_a_mesh_share_points_and_the_parameter_square) {
  Scene s = scene_of("PatchMesh \"bicubic\" 7 \"nonperiodic\" 4 \"nonperiodic\"" + flat(7, 4));
  ASSERT_EQ(s.primitives.size(), 2u);
  expect_near(at(s.primitives[0], 1, 0.5f).P, {3, 1.5f, 0});
  expect_near(at(s.primitives[1], 0, 0.5f).P, {3, 1.5f, 0});
  expect_near(at(s.primitives[1], 0.5f, 1).P, {4.5f, 3, 0});
  EXPECT_FLOAT_EQ(s.primitives[1].uv.u0, 0.5f);
  EXPECT_FLOAT_EQ(s.primitives[1].uv.u1, 1);
  EXPECT_FLOAT_EQ(s.primitives[1].uv.v1, 1);
}

TEST(PatchMesh, b_spline_and_catmull_rom_reproduce_straight_nets) {
  for (const char* basis : {"b-spline", "catmull-rom"}) {
    SCOPED_TRACE(basis);
    Scene s = scene_of("Basis \"" + std::string(basis) + "\" 1 \"" + basis +
                       "\" 1 PatchMesh \"bicubic\" 6 \"nonperiodic\" 5 \"nonperiodic\"" + flat(6, 5));
    ASSERT_EQ(s.primitives.size(), 6u);
    // Patch (2, 1): from point 3 to 4 in u, from 2 to 3 in v.
    expect_near(at(s.primitives[5], 0.25f, 0.75f).P, {3.25f, 2.75f, 0});
    expect_near(at(s.primitives[5], 0.3f, 0.6f).dPdu, {1, 0, 0}, 1e-4f);
  }
}

TEST(PatchMesh, hermite_power_and_arbitrary_bases) {
  // In u: p0 = 0, tangent 0, p1 = 1, tangent 0: 3t^2 - 2t^3. In v a straight line, written in the power
  // basis.
  std::string P = " \"P\" [";
  for (int j = 0; j < 4; ++j) {
    float y = j == 2 ? 1.0f : 0.0f, w = j == 3 ? 1.0f : 0.0f; // t^1 coefficient, t^0 coefficient
    for (float x : {0.0f, 0.0f, 1.0f, 0.0f})
      P += std::to_string(x * w) + " " + std::to_string(y) + " 0 ";
  }
  P += "]";
  // The hermite constant term is 1 for p0 and p1 only: y is weighted by h0 + t0 + h1 + t1.
  Scene named = scene_of("Basis \"hermite\" 2 \"power\" 4 Patch \"bicubic\"" + P);
  Scene matrix = scene_of("Basis [2 1 -2 1 -3 -2 3 -1 0 1 0 0 1 0 0 0] 2 [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] 4 "
                          "Patch \"bicubic\"" +
                          P);
  for (float t : {0.0f, 0.25f, 0.8f, 1.0f}) {
    expect_near(Vec3(at(named.primitives[0], t, 0.4f).P.x, 0, 0), {3 * t * t - 2 * t * t * t, 0, 0});
    expect_near(at(named.primitives[0], t, 0.4f).P, at(matrix.primitives[0], t, 0.4f).P);
  }
}

TEST(PatchMesh, hermite_meshes_step_by_two) {
  // Along u: points 0, 1, 2 with tangents 1; along v likewise: a flat sheet.
  std::string P = " \"P\" [";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 6; ++i) {
      float x = j % 2 ? 0.0f : (i % 2 ? 1.0f : static_cast<float>(i) / 2);
      float y = i % 2 ? 0.0f : (j % 2 ? 1.0f : static_cast<float>(j) / 2);
      P += std::to_string(x) + " " + std::to_string(y) + " 0 ";
    }
  Scene s =
      scene_of("Basis \"hermite\" 2 \"hermite\" 2 PatchMesh \"bicubic\" 6 \"nonperiodic\" 4 \"nonperiodic\"" +
               P + "]");
  ASSERT_EQ(s.primitives.size(), 2u);
  expect_near(at(s.primitives[1], 0.3f, 0.7f).P, {1.3f, 0.7f, 0});
}

TEST(PatchMesh, periodic_meshes_close) {
  Scene bilinear =
      scene_of("PatchMesh \"bilinear\" 4 \"periodic\" 2 \"nonperiodic\" \"P\" [1 0 0 0 1 0 -1 0 0 0 -1 0 "
               "1 0 1 0 1 1 -1 0 1 0 -1 1]");
  ASSERT_EQ(bilinear.primitives.size(), 4u);
  expect_near(at(bilinear.primitives[3], 1, 0).P, {1, 0, 0});
  // A b-spline ring of points on a circle: closed, and with continuous tangents.
  std::string P = " \"P\" [";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 8; ++i) {
      float a = 2 * kPi * static_cast<float>(i) / 8;
      P += std::to_string(std::cos(a)) + " " + std::to_string(std::sin(a)) + " " + std::to_string(j) + " ";
    }
  Scene ring = scene_of(
      "Basis \"b-spline\" 1 \"bezier\" 3 PatchMesh \"bicubic\" 8 \"periodic\" 4 \"nonperiodic\"" + P + "]");
  ASSERT_EQ(ring.primitives.size(), 8u);
  for (size_t k = 0; k < 8; ++k) {
    SurfacePoint end = at(ring.primitives[k], 1, 0.5f), start = at(ring.primitives[(k + 1) % 8], 0, 0.5f);
    expect_near(end.P, start.P);
    expect_near(end.dPdu, start.dPdu, 1e-4f);
    // (p[k] + 4 p[k+1] + p[k+2]) / 6 on a circle
    EXPECT_NEAR(glm::length(Vec2(end.P)), (4 + 2 * std::cos(kPi / 4)) / 6, 1e-5f);
  }
}

TEST(PatchMesh, variables_of_every_class) {
  Scene s = scene_of("PatchMesh \"bilinear\" 3 \"nonperiodic\" 2 \"nonperiodic\"" + flat(3, 2) +
                     " \"constant float c\" [7] \"uniform float f\" [1 2] \"varying float y\" [0 1 2 3 4 5]"
                     " \"vertex float x\" [0 1 2 3 4 5] \"facevarying float w\" [0 1 2 3 4 5]"
                     " \"uniform float[2] a\" [1 2 3 4]");
  ASSERT_EQ(s.primitives.size(), 2u);
  const Primitive& second = s.primitives[1];
  EXPECT_FLOAT_EQ(value(second, "c", 0.5f, 0.5f), 7);
  EXPECT_FLOAT_EQ(value(second, "f", 0.5f, 0.5f), 2);
  EXPECT_FLOAT_EQ(value(second, "a", 0.5f, 0.5f), 3);
  for (const char* name : {"y", "x", "w"})
    EXPECT_FLOAT_EQ(value(second, name, 0.25f, 0.5f), 1.25f + 1.5f);
  Scene cubic =
      scene_of("Patch \"bicubic\"" + flat(4, 4) +
               " \"vertex float x\" [0 1 2 3 0 1 2 3 0 1 2 3 0 1 2 3] \"varying float y\" [0 3 0 3]");
  EXPECT_NEAR(value(cubic.primitives[0], "x", 0.2f, 0.9f), 0.6f, 1e-6f);
  EXPECT_NEAR(value(cubic.primitives[0], "y", 0.2f, 0.9f), 0.6f, 1e-6f);
}

TEST(PatchMesh, weights_make_patches_rational) {
  // A quarter circle as a rational cubic: its quadratic form raised by a degree.
  std::string P = " \"Pw\" [";
  for (int j = 0; j < 4; ++j) {
    float h = static_cast<float>(j);
    auto point = [&](double x, double y, double w) {
      P += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(h * static_cast<float>(w)) +
           " " + std::to_string(w) + " ";
    };
    double s = std::sqrt(0.5), w = (1 + 2 * s) / 3;
    point(1, 0, 1), point((1 + 2 * s) / 3, 2 * s / 3, w), point(2 * s / 3, (1 + 2 * s) / 3, w),
        point(0, 1, 1);
  }
  Scene s = scene_of("Patch \"bicubic\"" + P + "]");
  for (float u : {0.0f, 0.2f, 0.5f, 0.9f}) {
    EXPECT_NEAR(glm::length(Vec2(at(s.primitives[0], u, 0.5f).P)), 1, 1e-5f);
    EXPECT_NEAR(at(s.primitives[0], u, 0.5f).P.z, 1.5f, 1e-5f);
  }
  Scene bilinear = scene_of("Patch \"bilinear\" \"Pw\" [0 0 0 1 3 0 0 3 0 1 0 1 3 3 0 3]");
  // x(u) = 3u / (1 + 2u)
  expect_near(at(bilinear.primitives[0], 0.5f, 0).P, {0.75f, 0, 0});
}

TEST(PatchMesh, heights_stand_on_the_unit_square) {
  Scene s = scene_of("PatchMesh \"bilinear\" 3 \"nonperiodic\" 2 \"nonperiodic\" \"Pz\" [0 1 2 3 4 5]");
  ASSERT_EQ(s.primitives.size(), 2u);
  expect_near(at(s.primitives[1], 0.5f, 0).P, {0.75f, 0, 1.5f});
  expect_near(at(s.primitives[1], 1, 1).P, {1, 1, 5});
}

TEST(PatchMesh, nowrap_is_an_old_name_of_nonperiodic) {
  auto mesh = [](const std::string& wrap) {
    return scene_of("PatchMesh \"bilinear\" 3 \"" + wrap + "\" 2 \"nonperiodic\" \"Pz\" [0 1 2 3 4 5]");
  };
  EXPECT_EQ(mesh("nowrap").primitives.size(), mesh("nonperiodic").primitives.size());
}

TEST(PatchMesh, messages) {
  auto message = [](const std::string& rib) { return messages_of("WorldBegin " + rib + " WorldEnd"); };
  EXPECT_THAT(message("PatchMesh \"bicubic\" 3 \"periodic\" 4 \"periodic\" \"P\" [0 0 0]"),
              HasSubstr("error: PatchMesh: nu is 3; a bicubic mesh has at least 4"));
  EXPECT_THAT(message("PatchMesh \"bicubic\" 4 \"closed\" 4 \"periodic\" \"P\" [0 0 0]"),
              HasSubstr("unknown wrap \"closed\"; expected \"periodic\" or \"nonperiodic\""));
  EXPECT_THAT(message("PatchMesh \"bicubic\" 4 \"nonperiodic\" 5 \"nonperiodic\"" + flat(4, 5)),
              HasSubstr("nv is 5, which steps of 3 do not divide; the points left over are not used"));
  EXPECT_THAT(message("PatchMesh \"quadratic\" 4 \"periodic\" 4 \"periodic\""),
              HasSubstr("unknown type \"quadratic\""));
  EXPECT_THAT(message("Patch \"bilinear\" \"Pw\" [0 0 0 0 1 0 0 1 0 1 0 1 1 1 0 1]"),
              HasSubstr("error: Patch: a point is not finite; the primitive is skipped"));
  EXPECT_THAT(message("Geometry \"cube\""), HasSubstr("unknown geometry \"cube\"; known is \"teapot\""));
}

TEST(PatchMesh, normals_at_collapsed_edges_and_corners_are_exact) {
  // An octant of a sphere-like dome whose row v = 1 is one point: the normal there is the axis.
  std::array<Vec3, 16> p;
  constexpr float k = 0.5522848f;
  const Vec2 profile[4] = {{1, 0}, {1, k}, {k, 1}, {0, 1}};
  const Vec2 circle[4] = {{1, 0}, {1, k}, {k, 1}, {0, 1}};
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i)
      p[4 * j + i] = {profile[j].x * circle[i].x, profile[j].x * circle[i].y, profile[j].y};
  PrimitiveList out;
  MeshDirection side;
  add_patch_mesh(side, side, p, {}, nullptr, out);
  for (float u : {0.0f, 0.4f, 1.0f})
    expect_near(glm::normalize(at(out[0], u, 1).N), {0, 0, 1}, 3e-6f);
}

TEST(Teapot, is_closed_in_and_its_normals_point_outwards) {
  auto patches = teapot_patches();
  ASSERT_EQ(patches.size(), 32u);
  Box box;
  PrimitiveList out;
  MeshDirection side;
  for (const auto& p : patches)
    add_patch_mesh(side, side, p, {}, nullptr, out);
  for (size_t k = 0; k < out.size(); ++k) {
    SurfacePoint q = at(out[k], 0.5f, 0.5f);
    box.add(out[k].geometry->bound({}));
    // Away from the axis of the body, or from the middle of handle and spout. The first four are the rim.
    Vec3 inside = k < 24 ? Vec3(0, 0, q.P.z) : Vec3(q.P.x, 0, q.P.z);
    Vec3 outwards = k >= 12 && k < 16 ? Vec3(0, 0, -1) : q.P - inside;
    if (k >= 4) {
      EXPECT_GT(glm::dot(q.N, outwards), 0) << k;
    }
  }
  expect_near(box.min, {-3, -2, 0}, 1e-5f);
  expect_near(box.max, {3.525f, 2, 3.15f}, 1e-5f);
}

TEST(Teapot, geometry_request) {
  Scene s = scene_of("Geometry \"teapot\" \"constant float shine\" [3]");
  ASSERT_EQ(s.primitives.size(), 32u);
  EXPECT_FLOAT_EQ(value(s.primitives[31], "shine", 0, 0), 3);
}

} // namespace
} // namespace render::testing
