// Rays and meshes that are there many times: what they share, and what each has of its own.
#include "tests/render/rays/ray_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

using slvm::Type;

const std::string kSeen = "Attribute \"visibility\" \"trace\" 1 \"transmission\" \"opaque\" ";
const std::string kCamera = "Format 200 200 1 Projection \"perspective\" \"fov\" 45 ";

/// A roof of n x n squares, each cut in two, over [-1, 1] x [-1, 1]: z = |x|.
std::string roof(int n, const std::string& more = "") {
  std::string counts, corners, points;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      points +=
          fmt::format("{:.5f} {:.5f} {:.5f} ", 2.0 * i / n - 1, 2.0 * j / n - 1, std::abs(2.0 * i / n - 1));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      counts += "3 3 ";
      corners += fmt::format("{} {} {} {} {} {} ", a, a + 1, b + 1, a, b + 1, b);
    }
  return fmt::format("PointsPolygons [{}] [{}] \"P\" [{}] {} ", counts, corners, points, more);
}

size_t faces_of(int n) {
  return size_t{2} * static_cast<size_t>(n) * static_cast<size_t>(n);
}

TEST(RayInstances, meshes_share_faces_wherever_they_come_from) {
  const std::string mesh = roof(20);
  const std::string contents[] = {mesh, "ReadArchive \"a\" ", "ObjectInstance 1 "};
  for (const std::string& content : contents) {
    std::string world = "ArchiveBegin \"a\" " + mesh + "ArchiveEnd ObjectBegin 1 " + mesh + "ObjectEnd ";
    for (int k = 0; k < 5; ++k)
      world += fmt::format("AttributeBegin Color [{} 0 1] Translate {} 0 {} {} AttributeEnd ", k + 1, 3 * k,
                           k + 5, content);
    RayScene s(kCamera + "WorldBegin " + kSeen + world + "WorldEnd");
    for (int k = 0; k < 5; ++k) {
      const auto x = static_cast<float>(3 * k);
      EXPECT_NEAR(s.distance({{x + 0.5f, 0.2f, 0}}), static_cast<float>(k) + 5.5f, 1e-3f) << content << k;
      EXPECT_NEAR(s.distance({{x - 0.5f, 0.2f, 0}}), static_cast<float>(k) + 5.5f, 1e-3f) << content << k;
      // Attributes are those of the instance.
      auto Cs = s.value({{x + 0.5f, 0.2f, 0}}, "primitive:Cs", Type::kColor);
      ASSERT_EQ(Cs.size(), 3u);
      EXPECT_FLOAT_EQ(Cs[0], static_cast<float>(k) + 1);
    }
    const RayGeometryUsage usage = s.tracer().usage().geometry;
    EXPECT_EQ(usage.made, 1u) << content;
    EXPECT_EQ(usage.faces, faces_of(20)) << content;
  }
}

TEST(RayInstances, groups_and_visibility_are_each_ones_own) {
  auto at = [](int x, const char* what) {
    return fmt::format("AttributeBegin {} Translate {} 0 5 ObjectInstance 1 AttributeEnd ", what, x);
  };
  RayScene s(kCamera + "WorldBegin " + kSeen + "ObjectBegin 1 " + roof(20) + "ObjectEnd " +
             at(0, "Attribute \"grouping\" \"membership\" \"a\"") +
             at(3, "Attribute \"visibility\" \"int specular\" 0") + at(6, "Sides 1") +
             at(9, "Sides 1 ReverseOrientation") + "WorldEnd");
  slvm::RayOptions in_a;
  in_a.subset = "a";
  EXPECT_LT(s.distance({{0.5f, 0.2f, 0}}, in_a), 6);
  EXPECT_EQ(s.distance({{3.5f, 0.2f, 0}}, in_a), kInfinity);
  slvm::RayOptions diffuse;
  diffuse.kind = slvm::RayKind::kDiffuse;
  EXPECT_EQ(s.distance({{3.5f, 0.2f, 0}}), kInfinity);
  EXPECT_LT(s.distance({{3.5f, 0.2f, 0}}, diffuse), 6);
  EXPECT_NE(s.distance({{6.5f, 0.2f, 0}}) < kInfinity, s.distance({{9.5f, 0.2f, 0}}) < kInfinity);
  EXPECT_EQ(s.tracer().usage().geometry.made, 1u);
}

TEST(RayInstances, an_object_of_several_materials_is_shared) {
  // Two meshes with shaders of their own; and instances in instances, whose surfaces are hit once.
  const std::string pair = "ObjectBegin 1 Color [.5 0 0] Opacity [.5 .5 .5] " + roof(20) +
                           " Color [.25 0 0] Translate 0 3 0 " + roof(20, "\"constant float x\" [1]") +
                           "ObjectEnd ";
  const std::string two = "ObjectBegin 2 ObjectInstance 1 TransformBegin Translate 4 0 0 ObjectInstance 1 "
                          "TransformEnd ObjectEnd ";
  RayScene s(kCamera + "WorldBegin Attribute \"visibility\" \"trace\" 1 \"transmission\" \"Os\" " + pair +
             two +
             "AttributeBegin Translate 0 0 5 ObjectInstance 2 AttributeEnd "
             "AttributeBegin Translate 8 0 5 ObjectInstance 2 AttributeEnd WorldEnd");
  for (float x : {0.0f, 4.0f, 8.0f, 12.0f}) {
    EXPECT_FLOAT_EQ(s.value({{x + 0.5f, 0.2f, 0}}, "primitive:Cs", Type::kColor)[0], 0.5f) << x;
    EXPECT_FLOAT_EQ(s.value({{x + 0.5f, 3.2f, 0}}, "primitive:Cs", Type::kColor)[0], 0.25f) << x;
    EXPECT_FLOAT_EQ(s.transmission({x + 0.5f, 0.2f, 0}, {x + 0.5f, 0.2f, 9}).x, 0.5f) << x;
  }
  const RayGeometryUsage usage = s.tracer().usage().geometry;
  EXPECT_LE(usage.faces, 4 * faces_of(20));
}

TEST(RayInstances, straight_faces_are_one_however_small_and_far) {
  // Rounding bends lines of small faces far from the origin; that once gave each sixteen.
  RayScene s(kCamera + "WorldBegin " + kSeen + "Translate 150.3 70.1 901.7 Scale .1 .1 .1 " + roof(40) +
             "WorldEnd");
  EXPECT_NEAR(s.distance({{150.35f, 70.11f, 890}}), 11.75f, 1e-2f);
  EXPECT_EQ(s.tracer().usage().geometry.faces, faces_of(40));
}

TEST(RayInstances, are_as_fine_as_the_nearest_needs) {
  // A tube of cubic patches in 32 faces, near and far: its faces follow the surface at both.
  std::string points;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i < 16; ++i)
      points += fmt::format("{:.6f} {} {:.6f} ", std::cos(i * M_PI / 8), j - 1, std::sin(i * M_PI / 8));
  std::string counts, corners;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 16; ++i) {
      counts += "4 ";
      corners += fmt::format("{} {} {} {} ", 16 * j + i, 16 * j + (i + 1) % 16, 16 * j + 16 + (i + 1) % 16,
                             16 * j + 16 + i);
    }
  const std::string tube = "ObjectBegin 1 SubdivisionMesh \"catmull-clark\" [" + counts + "] [" + corners +
                           "] [\"interpolateboundary\"] [1 0] [1] [] \"P\" [" + points + "] ObjectEnd ";
  auto faces = [&](const std::string& where) {
    RayScene s(kCamera + "WorldBegin " + kSeen + tube + where + "WorldEnd");
    EXPECT_NEAR(s.distance({{0, 0, -0.5f}, {0.3f, 0, 1}}), s.distance({{0, 0, -0.5f}, {-0.3f, 0, 1}}), 1e-3f);
    return s.tracer().usage().geometry.faces;
  };
  const std::string near = "AttributeBegin ObjectInstance 1 AttributeEnd ",
                    far = "AttributeBegin Translate 0 0 900 ObjectInstance 1 AttributeEnd ",
                    farther = "AttributeBegin Translate 0 0 990 ObjectInstance 1 AttributeEnd ";
  const size_t fine = faces(near);
  EXPECT_EQ(faces(near + far), fine);
  EXPECT_EQ(faces(far + near + farther), fine);
  RayScene s(kCamera + "WorldBegin " + kSeen + tube + far + farther + "WorldEnd");
  EXPECT_NEAR(s.distance({{0, 0, 0}}), 899, 0.1f);
  EXPECT_LT(s.tracer().usage().geometry.faces, fine);
}

} // namespace
} // namespace render::testing
