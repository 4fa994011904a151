// Constructive solid geometry: depths, areas and colours known by hand, misuse, and random trees against an
// evaluation of the same trees ray by ray.
#include "tests/render/render_text.h"
#include "tests/temp_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

namespace render::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Orthographic, 64 pixels for 2 units, z of the world is z of the camera less 5.
const std::string kFrame = "Format 64 64 1 PixelFilter \"box\" 1 1 PixelSamples 4 4 Translate 0 0 5 ";

std::string primitive(const std::string& surfaces) {
  return "SolidBegin \"primitive\" " + surfaces + " SolidEnd ";
}

std::string sphere(float x, float y, float z, float radius, const std::string& attributes = "") {
  return primitive(
      fmt::format("{} Translate {} {} {} Sphere {} {} {} 360", attributes, x, y, z, radius, -radius, radius));
}

std::string solid(const std::string& operation, const std::string& operands) {
  return fmt::format("SolidBegin \"{}\" {} SolidEnd ", operation, operands);
}

Rendered world(const std::string& content, const std::string& options = "", const FrameSettings& s = {}) {
  Rendered r = render_text(kFrame + options + " WorldBegin " + content + " WorldEnd", s);
  EXPECT_EQ(r.messages, "");
  return r;
}

/// A cube from -h to h in all directions, of six bilinear patches.
std::string cube(float h) {
  std::string out;
  const float corner[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  for (int axis = 0; axis < 3; ++axis)
    for (float side : {-1.0f, 1.0f}) {
      out += "Patch \"bilinear\" \"P\" [";
      for (auto [a, b] : corner) {
        float p[3];
        p[axis] = side;
        p[(axis + 1) % 3] = a;
        p[(axis + 2) % 3] = b;
        out += fmt::format("{} {} {} ", p[0] * h, p[1] * h, p[2] * h);
      }
      out += "] ";
    }
  return out;
}

TEST(Solids, difference_shows_the_far_wall_of_the_hole) {
  // The hole is a sphere of radius 0.6 around the point nearest to the eye: the wall is 0.6 behind it.
  Rendered r = world(
      solid("difference", sphere(0, 0, 0, 0.9f, "Color 1 0 0") + sphere(0, 0, -0.9f, 0.6f, "Color 0 1 0")));
  EXPECT_NEAR(r.z(32, 32), 5 - 0.9f + 0.6f, 0.002f);
  EXPECT_EQ(r.Ci(32, 32), Color(0, 1, 0));
  // The silhouette is that of the large sphere, whose surface shows around the hole.
  EXPECT_NEAR(r.covered(), M_PI * std::pow(32 * 0.9, 2), 12);
  EXPECT_EQ(r.Ci(32 + 26, 32), Color(1, 0, 0));
  double x = 20.5 / 32, y = 0.5 / 32;
  EXPECT_NEAR(r.z(32 + 20, 32), 5 - std::sqrt(0.81 - x * x - y * y), 0.016);
}

TEST(Solids, a_hole_through_everything_is_empty) {
  // A cylinder with its lids, longer than the sphere is thick.
  std::string drill = primitive("Cylinder .3 -2 2 360 Disk -2 .3 360 Disk 2 .3 360");
  Rendered r = world(solid("difference", sphere(0, 0, 0, 0.9f) + drill));
  EXPECT_EQ(r.alpha(32, 32), 0);
  EXPECT_NEAR(r.covered(), M_PI * 32 * 32 * (0.81 - 0.09), 12);
}

TEST(Solids, intersection_of_spheres_is_a_lens) {
  // Side by side, centres 0.8 apart: two segments of circles of radius 0.8.
  Rendered r = world(solid("intersection", sphere(-0.4f, 0, 0, 0.8f) + sphere(0.4f, 0, 0, 0.8f)));
  double radius = 0.8, distance = 0.8;
  double area = 2 * radius * radius * std::acos(distance / (2 * radius)) -
                distance / 2 * std::sqrt(4 * radius * radius - distance * distance);
  EXPECT_NEAR(r.covered(), area * 32 * 32, 8);
  // In the middle the two surfaces meet at z = -sqrt(0.64 - 0.16).
  EXPECT_NEAR(r.z(32, 32), 5 - std::sqrt(0.48), 0.02);
  // One behind the other, the front of the second is what shows.
  r = world(solid("intersection", sphere(0, 0, -0.3f, 0.7f) + sphere(0, 0, 0.3f, 0.7f)));
  EXPECT_NEAR(r.z(32, 32), 5 + 0.3f - 0.7f, 0.002f);
}

TEST(Solids, union_looks_like_its_parts_and_has_no_walls_inside) {
  std::string parts = sphere(-0.3f, 0, 0, 0.6f) + sphere(0.3f, 0, 0.2f, 0.6f);
  Rendered joined = world(solid("union", parts)), plain = world(parts);
  expect_alike(joined.image, plain.image);
  // Half transparent: two surfaces everywhere, not four.
  joined = world("Opacity .5 .5 .5 " + solid("union", parts));
  EXPECT_NEAR(joined.alpha(32, 32), 0.75f, 1e-5f);
  EXPECT_NEAR(world("Opacity .5 .5 .5 " + parts).alpha(32, 32), 1 - 1 / 16.0f, 1e-5f);
}

TEST(Solids, nested_trees) {
  // (A - B) and C, or D. Along the middle ray A is [-0.9, 0.9], B [-0.9, 0.3], C [-0.6, 0.6], D off to the
  // side.
  std::string tree =
      solid("union", solid("intersection", solid("difference", sphere(0, 0, 0, 0.9f, "Color 1 0 0") +
                                                                   sphere(0, 0, -0.3f, 0.6f, "Color 0 1 0")) +
                                               sphere(0, 0, 0, 0.6f, "Color 0 0 1")) +
                         sphere(0.8f, 0, 0, 0.1f, "Color 1 1 0"));
  Rendered r = world("Opacity .5 .5 .5 " + tree);
  // From 0.3, the wall of B, to 0.6, the back of C: 0.5 green over 0.5 blue.
  EXPECT_NEAR(r.alpha(32, 32), 0.75f, 1e-5f);
  EXPECT_NEAR(r.Ci(32, 32).y, 0.5f, 1e-5f);
  EXPECT_NEAR(r.Ci(32, 32).z, 0.25f, 1e-5f);
  EXPECT_EQ(r.Ci(32, 32).x, 0);
  EXPECT_GT(r.Ci(32 + 25, 32).x, 0.7f);
}

TEST(Solids, all_others_are_taken_from_the_first) {
  Rendered r = world(
      solid("difference", sphere(0, 0, 0, 0.9f) + sphere(0.3f, 0, 0, 1.0f) + sphere(-0.3f, 0, 0, 1.0f)));
  EXPECT_EQ(r.covered(), 0);
  r = world(solid("difference",
                  sphere(0, 0, 0, 0.9f) + sphere(0.5f, 0, -0.9f, 0.3f) + sphere(-0.5f, 0, -0.9f, 0.3f)));
  double front = 5 - std::sqrt(0.81 - 0.25 - std::pow(0.5 / 32, 2));
  EXPECT_GT(r.z(48, 32), front + 0.05);
  EXPECT_GT(r.z(15, 32), front + 0.05);
  EXPECT_NEAR(r.z(32, 32), 4.1f, 0.002f);
}

TEST(Solids, solids_and_plain_surfaces_hide_each_other) {
  std::string bitten = solid("difference", sphere(0, 0, 0, 0.9f) + sphere(0, 0, -0.9f, 0.6f));
  // A disk in the hole, in front of the wall; one behind the wall.
  for (const std::string& content : {bitten + "Color 1 0 0 Disk -.5 .2 360 Color 0 0 1 Disk -.1 .2 360",
                                     "AttributeBegin Color 1 0 0 Disk -.5 .2 360 AttributeEnd " + bitten}) {
    Rendered r = world(content);
    EXPECT_NEAR(r.z(32, 32), 4.5f, 1e-4f);
    EXPECT_EQ(r.Ci(32, 32), Color(1, 0, 0));
  }
  EXPECT_NEAR(world(bitten + "Disk -.1 .2 360").z(32, 32), 4.7f, 0.002f);
  // Two solids do not take part in each other.
  Rendered r = world(bitten + solid("intersection", sphere(0, 0, 0, 0.2f) + sphere(0, 0, 0.1f, 0.2f)));
  EXPECT_NEAR(r.z(32, 32), 4.7f, 0.002f);
}

TEST(Solids, a_primitive_by_itself_is_plain_geometry) {
  Rendered r = world(sphere(0, 0, 0, 0.9f) + "SolidBegin \"union\" " + sphere(0.5f, 0, 0, 0.3f) + "SolidEnd");
  EXPECT_EQ(r.image.data, world("Sphere .9 -.9 .9 360 Translate .5 0 0 Sphere .3 -.3 .3 360").image.data);
}

TEST(Solids, coinciding_faces) {
  // Cubes that share a face: the wall between them is gone. One taken from itself leaves nothing.
  std::string right = primitive("Translate .25 0 0 " + cube(0.25f)),
              left = primitive("Translate -.25 0 0 " + cube(0.25f)),
              behind = primitive("Translate 0 0 .5 " + cube(0.25f));
  Rendered r = world("Opacity .5 .5 .5 " + solid("union", primitive(cube(0.25f)) + behind));
  EXPECT_NEAR(r.alpha(32, 32), 0.75f, 1e-5f);
  r = world("Opacity .5 .5 .5 " + solid("union", right + left));
  EXPECT_NEAR(r.alpha(20, 32), 0.75f, 1e-5f);
  EXPECT_EQ(world(solid("difference", primitive(cube(0.5f)) + primitive(cube(0.5f)))).covered(), 0);
  r = world("Opacity .5 .5 .5 " + solid("intersection", primitive(cube(0.5f)) + primitive(cube(0.5f))));
  EXPECT_NEAR(r.alpha(32, 32), 0.75f, 1e-5f);
  EXPECT_NEAR(r.covered(), 0.75 * 32 * 32, 1);
}

TEST(Solids, sides_decide_what_shows_not_what_bounds) {
  std::string large = sphere(0, 0, 0, 0.9f), small = sphere(0, 0, -0.9f, 0.6f, "Color 0 1 0"),
              turned = sphere(0, 0, -0.9f, 0.6f, "ReverseOrientation Color 0 1 0");
  // The wall of the hole is the back of what was taken away, unless that is turned over.
  EXPECT_EQ(world("Sides 1 " + solid("difference", large + small)).alpha(32, 32), 0);
  Rendered r = world("Sides 1 " + solid("difference", large + turned));
  EXPECT_NEAR(r.z(32, 32), 4.7f, 0.002f);
  EXPECT_EQ(r.Ci(32, 32), Color(0, 1, 0));
  EXPECT_EQ(world("Sides 1 " + solid("union", large + small)).image.data,
            world(solid("union", large + small)).image.data);
}

TEST(Solids, matte_and_variables) {
  FrameSettings s;
  AovChannel u;
  u.name = "u";
  u.components = 1;
  s.aovs = {u};
  std::string bitten = solid("difference", sphere(0, 0, 0, 0.9f, "Matte 1") + sphere(0, 0, -0.9f, 0.6f));
  Rendered r = world("AttributeBegin Color 1 0 0 Disk .95 .95 360 AttributeEnd " + bitten, "", s);
  EXPECT_EQ(r.alpha(32 + 26, 32), 0); // a hole in the disk
  EXPECT_EQ(r.Ci(32, 32), Color(1, 1, 1));
  EXPECT_GT(r.image.at(Image::kAov, 28, 30), 0);
}

TEST(Solids, the_near_plane_may_be_inside) {
  // It cuts the sphere at z = -0.6; the hole begins in front of it and ends behind it.
  std::string bitten =
      solid("difference", sphere(0, 0, 0, 0.9f, "Color 1 0 0") + sphere(0, 0, -0.9f, 0.6f, "Color 0 1 0"));
  for (const char* projection : {"", "Projection \"perspective\" \"fov\" 20 "}) {
    SCOPED_TRACE(projection);
    Rendered r = render_text("Format 64 64 1 PixelFilter \"box\" 1 1 Clipping 4.4 100 " +
                             std::string(projection) + "Translate 0 0 5 WorldBegin " + bitten + "WorldEnd");
    EXPECT_EQ(r.messages, "");
    EXPECT_NEAR(r.z(32, 32), 4.7f, 0.002f);
    EXPECT_EQ(r.Ci(32, 32), Color(0, 1, 0));
    // Beside the hole the plane has opened the sphere, and its back shows.
    int beside = 32 + (projection[0] ? 24 : 18);
    EXPECT_GT(r.z(beside, 32), 5.3f);
    EXPECT_EQ(r.Ci(beside, 32), Color(1, 0, 0));
  }
}

TEST(Solids, what_is_too_far_or_clipped_still_bounds) {
  // The far plane cuts off the back of the hole: nothing is left in front of it.
  std::string bitten = solid("difference", sphere(0, 0, 0, 0.9f) + sphere(0, 0, -0.4f, 0.8f));
  EXPECT_EQ(world(bitten, "Clipping .1 5.2").alpha(32, 32), 0);
  EXPECT_NEAR(world(bitten).z(32, 32), 5.4f, 0.002f);
  // A plane that removes all in front of z = 4.5 removes the front of the hole, which stays a hole.
  Rendered r = world(solid("difference", sphere(0, 0, 0, 0.9f) + sphere(0, 0, -0.9f, 0.6f)),
                     "TransformBegin ClippingPlane 0 0 -.5 0 0 -1 TransformEnd");
  EXPECT_NEAR(r.z(32, 32), 4.7f, 0.002f);
}

TEST(Solids, open_surfaces_do_little_harm) {
  // A disk has no inside: taken away it removes nothing, and does not show.
  Rendered r = world(solid("difference", sphere(0, 0, 0, 0.9f) + primitive("Disk -.5 .5 360")));
  expect_alike(r.image, world("Sphere .9 -.9 .9 360").image);
  // A bowl without lid, looked into.
  r = world(solid("union", primitive("Sphere .9 0 .9 360") + sphere(0, 0, 3, 0.1f)));
  EXPECT_NEAR(r.z(32, 32), 5.9f, 0.002f);
  EXPECT_NEAR(r.covered(), M_PI * std::pow(32 * 0.9, 2), 12);
}

TEST(Solids, motion_blur_and_depth_of_field) {
  // The hole moves across the sphere while the shutter is open: its wall and the sphere share the time.
  std::string moving = "SolidBegin \"difference\" " + sphere(0, 0, 0, 0.9f, "Color 1 0 0") +
                       "SolidBegin \"primitive\" Color 0 1 0 MotionBegin [0 1] Translate -.5 0 -.9 Translate "
                       ".5 0 -.9 MotionEnd "
                       "Sphere .5 -.5 .5 360 SolidEnd SolidEnd";
  Rendered r = world(moving, "Shutter 0 1 PixelSamples 8 8");
  EXPECT_NEAR(r.covered(), M_PI * std::pow(32 * 0.9, 2), 12);
  // The spheres meet in a circle; the middle pixel is in it while |x| is below its radius.
  double wall = 0.9 - (0.9 * 0.9 + 0.9 * 0.9 - 0.5 * 0.5) / (2 * 0.9); // circle's plane behind the front
  double radius = std::sqrt(0.25 - wall * wall);
  EXPECT_NEAR(r.Ci(32, 32).y, 2 * radius, 0.06); // x goes from -0.5 to 0.5
  EXPECT_NEAR(r.Ci(32, 32).x + r.Ci(32, 32).y, 1, 1e-5f);
  // Out of focus by much: the same solid amount of light, spread.
  std::string still = solid("difference", sphere(0, 0, 0, 0.5f) + sphere(0, 0, -0.5f, 0.3f));
  double sharp = world(still).covered();
  r = render_text(
      "Format 64 64 1 PixelFilter \"box\" 1 1 PixelSamples 8 8 Projection \"perspective\" \"fov\" 40 "
      "DepthOfField 2 1 20 Translate 0 0 5 WorldBegin " +
      still + "WorldEnd");
  Rendered plain = render_text(
      "Format 64 64 1 PixelFilter \"box\" 1 1 PixelSamples 8 8 Projection \"perspective\" \"fov\" 40 "
      "DepthOfField 2 1 20 Translate 0 0 5 WorldBegin Sphere .5 -.5 .5 360 WorldEnd");
  EXPECT_NEAR(r.covered(), plain.covered(), 0.01 * plain.covered());
  EXPECT_GT(sharp, 0);
}

TEST(Solids, instances_are_solids_of_their_own) {
  std::string object = "ObjectBegin 1 " +
                       solid("difference", sphere(0, 0, 0, 0.4f) + sphere(0, 0, -0.4f, 0.2f)) + "ObjectEnd ";
  Rendered r = world(object + "Translate -.5 0 0 ObjectInstance 1 Translate 1 0 0 ObjectInstance 1");
  EXPECT_EQ(r.scene.solids, 2u);
  for (int x : {16, 48})
    EXPECT_NEAR(r.z(x, 32), 5 - 0.4f + 0.2f, 0.004f);
  // As an operand: the operation is around the instance.
  r = world("ObjectBegin \"ball\" " + sphere(0, 0, -0.9f, 0.6f) + " ObjectEnd " +
            solid("difference", sphere(0, 0, 0, 0.9f) + "ObjectInstance \"ball\""));
  EXPECT_NEAR(r.z(32, 32), 4.7f, 0.002f);
}

TEST(Solids, blocks_save_the_state) {
  Rendered r =
      world("Color 1 0 0 SolidBegin \"union\" Translate 0 0 9 Color 0 1 0 " + sphere(0, 0, -9.5f, 0.2f) +
            "SolidBegin \"primitive\" Translate 9 0 0 SolidEnd SolidEnd Disk 0 .9 360");
  EXPECT_EQ(r.Ci(32, 32), Color(0, 1, 0));
  EXPECT_EQ(r.Ci(48, 32), Color(1, 0, 0));
  EXPECT_NEAR(r.z(48, 32), 5, 1e-4f);
}

TEST(Solids, procedurals_bring_surfaces_and_solids) {
  // Both come after all requests of the world, and are still the operands they stood for.
  anemone::test::TempFolder folder;
  folder.write("solids.rib", sphere(0, 0, 0, 0.9f));
  folder.write("surface.rib", "Sphere .6 -.6 .6 360");
  auto delayed = [&](const std::string& file) {
    return fmt::format("Procedural \"DelayedReadArchive\" [\"{}\"] [-1 1 -1 1 -1 1] ",
                       (folder / file).string());
  };
  Rendered r = world(solid("difference", delayed("solids.rib") +
                                             primitive("Translate 0 0 -.9 " + delayed("surface.rib")) +
                                             sphere(0.8f, 0, 0, 0.2f)));
  EXPECT_NEAR(r.z(32, 32), 4.7f, 0.002f);
  EXPECT_NEAR(r.covered(), M_PI * std::pow(32 * 0.9, 2), 40);
  // A whole solid that is made when a bucket comes to it, some of it by another procedural.
  folder.write("bitten.rib", solid("difference", delayed("solids.rib") + sphere(0, 0, -0.9f, 0.6f)));
  std::string two = "Opacity .5 .5 .5 " + delayed("bitten.rib") + "Translate .3 0 0 " + delayed("bitten.rib");
  FrameSettings one;
  one.threads = 1;
  r = world(two, "Option \"limits\" \"bucketsize\" [8 8]", one);
  EXPECT_NEAR(r.alpha(8, 32), 0.75f, 1e-5f);
  EXPECT_EQ(world(two).image.data, r.image.data);
  EXPECT_EQ(
      world("Opacity .5 .5 .5 " + solid("difference", sphere(0, 0, 0, 0.9f) + sphere(0, 0, -0.9f, 0.6f)) +
            "Translate .3 0 0 " + solid("difference", sphere(0, 0, 0, 0.9f) + sphere(0, 0, -0.9f, 0.6f)))
          .alpha(50, 20),
      r.alpha(50, 20));
}

TEST(Solids, misuse_is_reported) {
  auto messages = [](const std::string& content) {
    return messages_of("WorldBegin " + content + " WorldEnd");
  };
  EXPECT_THAT(
      messages("SolidBegin \"union\" Sphere 1 -1 1 360 SolidEnd"),
      HasSubstr("Sphere: surfaces in an operation on solids belong in SolidBegin \"primitive\"; this one "
                "is read as a solid by itself"));
  EXPECT_THAT(messages("SolidBegin \"xor\" SolidEnd"),
              HasSubstr("SolidBegin: unknown operation \"xor\"; known are primitive, union, intersection, "
                        "difference; the block is read as a union"));
  EXPECT_THAT(messages("SolidBegin \"primitive\" SolidBegin \"union\" SolidEnd SolidEnd"),
              HasSubstr("SolidBegin: a \"primitive\" is made of surfaces, not of solids; those in this block "
                        "become part of it"));
  EXPECT_THAT(messages("SolidBegin \"difference\" SolidEnd"),
              HasSubstr("SolidEnd: the operation has no solids to work on"));
  EXPECT_THAT(messages("SolidEnd"),
              HasSubstr("SolidEnd: there is no open SolidBegin; the request is skipped"));
  EXPECT_THAT(messages("SolidBegin \"union\" " + sphere(0, 0, 0, 1)),
              HasSubstr("WorldEnd: SolidBegin is still open"));
  EXPECT_THAT(messages("AttributeBegin SolidBegin \"union\" " + sphere(0, 0, 0, 1) + "AttributeEnd"),
              HasSubstr("AttributeEnd: SolidBegin is still open"));
  EXPECT_EQ(messages(solid("difference", sphere(0, 0, 0, 1) + sphere(1, 0, 0, 1))), "");
}

TEST(Solids, misuse_keeps_what_can_be_kept) {
  // The loose sphere is an operand like the others; a lost end does not reach into what follows.
  Rendered r = render_text(kFrame + "WorldBegin SolidBegin \"difference\" Sphere .9 -.9 .9 360 " +
                           sphere(0, 0, -0.9f, 0.6f) + "SolidEnd WorldEnd");
  EXPECT_NEAR(r.z(32, 32), 4.7f, 0.002f);
  r = render_text(kFrame + "WorldBegin AttributeBegin SolidBegin \"intersection\" " + sphere(0, 0, 0, 0.2f) +
                  sphere(0, 0, 5, 0.2f) + "AttributeEnd Sphere .9 -.9 .9 360 WorldEnd");
  EXPECT_NEAR(r.z(32, 32), 4.1f, 0.002f);
}

// ---- random trees

struct Ball {
  glm::dvec3 centre, radii;
};

/// An expression over balls, and the RIB of it.
struct Tree {
  SolidOperation operation = SolidOperation::kPrimitive;
  size_t ball = 0;
  std::vector<Tree> operands;
};

class RandomSolid {
public:
  explicit RandomSolid(unsigned seed) : random_(seed) { root_ = grow(4); }

  std::string rib() const { return rib(root_); }

  struct Seen {
    double z = 0;
    size_t ball = 0;
    double gap = 0; ///< to the nearest other surface, part of the solid or not
    bool operator==(const Seen& o) const { return ball == o.ball; }
  };
  /// The nearest boundary along the ray through `at`; nothing: it misses the solid.
  std::optional<Seen> trace(double x, double y) const {
    std::vector<std::pair<double, size_t>> crossings;
    for (size_t i = 0; i < balls_.size(); ++i) {
      const Ball& b = balls_[i];
      double dx = (x - b.centre.x) / b.radii.x, dy = (y - b.centre.y) / b.radii.y, h = 1 - dx * dx - dy * dy;
      if (h <= 0) continue;
      crossings.emplace_back(b.centre.z - b.radii.z * std::sqrt(h), i);
      crossings.emplace_back(b.centre.z + b.radii.z * std::sqrt(h), i);
    }
    std::sort(crossings.begin(), crossings.end());
    std::vector<bool> in(balls_.size());
    for (size_t k = 0; k < crossings.size(); ++k) {
      auto [z, i] = crossings[k];
      in[i] = !in[i];
      double before = k > 0 ? z - crossings[k - 1].first : 1,
             after = k + 1 < crossings.size() ? crossings[k + 1].first - z : 1;
      if (inside(root_, in)) return Seen{z, i, std::min(before, after)};
    }
    return {};
  }
  static Color colour(size_t ball) {
    return {static_cast<float>(ball % 4) / 4 + 0.1f, static_cast<float>(ball / 4 % 4) / 4 + 0.1f,
            static_cast<float>(ball / 16) / 4 + 0.1f};
  }

private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  size_t pick(size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random_); }

  Tree grow(int depth) {
    Tree t;
    if (depth == 0 || (depth < 3 && pick(4) == 0)) {
      t.ball = balls_.size();
      balls_.push_back({{uniform(-0.6, 0.6), uniform(-0.6, 0.6), uniform(-0.6, 0.6)},
                        {uniform(0.2, 0.8), uniform(0.2, 0.8), uniform(0.2, 0.8)}});
      return t;
    }
    t.operation = static_cast<SolidOperation>(1 + pick(3));
    for (size_t n = 2 + pick(2); n > 0; --n)
      t.operands.push_back(grow(depth - 1));
    return t;
  }
  std::string rib(const Tree& t) const {
    constexpr const char* kNames[] = {"primitive", "union", "intersection", "difference"};
    std::string inner;
    for (const Tree& o : t.operands)
      inner += rib(o);
    if (t.operation == SolidOperation::kPrimitive) {
      const Ball& b = balls_[t.ball];
      Color c = colour(t.ball);
      inner = fmt::format("AttributeBegin Color {} {} {} Translate {} {} {} Scale {} {} {} Sphere 1 -1 1 360 "
                          "AttributeEnd ",
                          c.x, c.y, c.z, b.centre.x, b.centre.y, b.centre.z, b.radii.x, b.radii.y, b.radii.z);
    }
    return solid(kNames[static_cast<size_t>(t.operation)], inner);
  }
  static bool inside(const Tree& t, const std::vector<bool>& in) {
    if (t.operation == SolidOperation::kPrimitive) return in[t.ball];
    bool value = inside(t.operands[0], in);
    for (size_t i = 1; i < t.operands.size(); ++i) {
      bool other = inside(t.operands[i], in);
      value = t.operation == SolidOperation::kUnion          ? value || other
              : t.operation == SolidOperation::kIntersection ? value && other
                                                             : value && !other;
    }
    return value;
  }

  std::mt19937 random_;
  std::vector<Ball> balls_;
  Tree root_;
};

TEST(Solids, random_trees_agree_with_rays) {
  constexpr int kSize = 48;
  int compared = 0, empty = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    RandomSolid tree(seed);
    Rendered r =
        render_text(fmt::format("Format {0} {0} 1 PixelFilter \"box\" 1 1 PixelSamples 1 1 Hider "
                                "\"hidden\" \"jitter\" 0 ShadingRate .25 Translate 0 0 5 WorldBegin {1} "
                                "WorldEnd",
                                kSize, tree.rib()));
    ASSERT_EQ(r.messages, "");
    int wrong = 0;
    for (int j = 0; j < kSize; ++j)
      for (int i = 0; i < kSize; ++i) {
        auto at = [&](double di, double dj) {
          return tree.trace((i + di) * 2.0 / kSize - 1, 1 - (j + dj) * 2.0 / kSize);
        };
        // Pixels near an edge of the solid are left out: micropolygons are flat.
        auto seen = at(0.5, 0.5);
        bool edge = seen && seen->gap < 0.003;
        for (double dj : {-0.2, 0.5, 1.2})
          for (double di : {-0.2, 0.5, 1.2})
            edge = edge || at(di, dj) != seen;
        if (edge) continue;
        ++compared;
        empty += !seen;
        bool right =
            seen ? r.Ci(i, j) == RandomSolid::colour(seen->ball) && std::abs(r.z(i, j) - 5 - seen->z) < 0.02
                 : r.alpha(i, j) == 0;
        if (!right && ++wrong == 1)
          ADD_FAILURE() << "pixel " << i << " " << j << ": z " << r.z(i, j) << " alpha " << r.alpha(i, j)
                        << ", expected " << (seen ? seen->z + 5 : -1);
      }
    EXPECT_EQ(wrong, 0);
  }
  EXPECT_GT(compared, 30 * kSize * kSize / 2);
  EXPECT_LT(empty, compared * 9 / 10);
}

TEST(Solids, threads_buckets_and_moving_samples_change_nothing) {
  RandomSolid a(3), b(7);
  std::string options = "Format 80 64 1 PixelSamples 3 3 PixelFilter \"gaussian\" 2 2 ",
              content = "Translate 0 0 5 WorldBegin Opacity .7 .7 .7 Translate -.4 0 0 " + a.rib() +
                        " Translate .8 0 .3 " + b.rib() + " WorldEnd";
  FrameSettings one, four;
  one.threads = 1;
  four.threads = 4;
  Rendered reference = render_text(options + content, one);
  EXPECT_GT(reference.covered(), 100);
  EXPECT_EQ(render_text(options + content, four).image.data, reference.image.data);
  Rendered buckets = render_text("Option \"limits\" \"bucketsize\" [7 5] " + options + content, four);
  EXPECT_EQ(buckets.image.data, reference.image.data);
}

} // namespace
} // namespace render::testing
