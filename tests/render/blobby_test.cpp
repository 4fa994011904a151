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

BlobbyField field(std::vector<int> code, std::vector<float> floats) {
  return BlobbyField::make(code, floats, [](const std::string& text) { ADD_FAILURE() << text; });
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
    return field(code, kNumbers).at(p);
  };
  EXPECT_NEAR(value({0, 3, 0, 1, 2}), a + b + c, 1e-12);
  EXPECT_NEAR(value({1, 2, 0, 1}), a * b, 1e-12);
  EXPECT_NEAR(value({2, 3, 0, 1, 2}), std::max({a, b, c}), 1e-12);
  EXPECT_NEAR(value({3, 3, 0, 1, 2}), std::min({a, b, c}), 1e-12);
  EXPECT_NEAR(value({4, 0, 1}), a - b, 1e-12); // RISpec 3.2, table 5.3
  EXPECT_NEAR(value({5, 0, 2}), a / c, 1e-12);
  EXPECT_NEAR(value({6, 1}), -b, 1e-12);
  EXPECT_NEAR(value({7, 1}), b, 1e-12);
  EXPECT_NEAR(value({4, 0, 1, 0, 2, 3, 2}), a - b + c, 1e-12); // results count as operands
}

TEST(Blobby, codes_of_application_note_31) {
  glm::dvec3 p(0.3, 0.1, 0);
  const double a = sphere(std::hypot(0.3, 0.1)), b = sphere(std::hypot(0.7, 0.1));
  auto value = [&](int code) {
    return BlobbyField::make(
               std::vector<int>{1001, 0, 1001, 16, code, 0, 1}, kNumbers, [](const std::string&) {}, {},
               BlobbyField::Codes::kNote31)
        .at(p);
  };
  EXPECT_NEAR(value(4), a / b, 1e-12);
  EXPECT_NEAR(value(5), a - b, 1e-12);
  // A scene says which; a small sphere dents a large one where it is taken away.
  auto reach = [](const std::string& option, int code) {
    const std::string dent =
        "Blobby 2 [1001 0 1001 16 " + std::to_string(code) +
        " 0 1] [2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1  1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1] [\"\"]";
    const Rendered r =
        render_text("Format 4 4 1 " + option + " WorldBegin Translate 0 0 5 " + dent + " WorldEnd");
    EXPECT_EQ(r.messages, "");
    Box box;
    for (const Primitive& piece : r.scene.primitives)
      box.add(piece.camera_bound({}));
    return box.max.x;
  };
  const float plain = reach("", 4);
  EXPECT_LT(plain, 0.8f) << "the sphere reaches to 1 on the other side";
  EXPECT_EQ(reach("Option \"blobby\" \"string codes\" [\"rispec\"]", 4), plain);
  EXPECT_EQ(reach("Option \"blobby\" \"string codes\" [\"note31\"]", 5), plain);
  EXPECT_NE(reach("Option \"blobby\" \"string codes\" [\"note31\"]", 4), plain);
  EXPECT_THAT(messages_of("Option \"blobby\" \"string codes\" [\"prman\"]"),
              HasSubstr("Option: \"codes\" is \"rispec\" or \"note31\", found \"prman\""));
}

TEST(Blobby, a_part_of_the_field_has_the_same_values) {
  // Six spheres in a row, and operators of all kinds over them.
  std::vector<int> code;
  std::vector<float> numbers;
  for (int i = 0; i < 6; ++i) {
    code.insert(code.end(), {1001, static_cast<int>(numbers.size())});
    numbers.insert(numbers.end(),
                   {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.8f * static_cast<float>(i), 0, 0, 1});
  }
  code.insert(code.end(), {1000, static_cast<int>(numbers.size())});
  numbers.push_back(0.25f);
  const std::vector<std::vector<int>> kOperations = {{0, 3, 0, 2, 4},
                                                     {1, 2, 0, 1},
                                                     {2, 3, 0, 3, 5},
                                                     {3, 2, 0, 5},
                                                     {4, 0, 1},
                                                     {4, 1, 6},
                                                     {5, 0, 5},
                                                     {5, 5, 0},
                                                     {6, 0},
                                                     {7, 5},
                                                     {0, 6, 0, 1, 2, 3, 4, 5},
                                                     {0, 2, 4, 5, 5, 7, 0},
                                                     {2, 2, 0, 6, 4, 3, 7}};
  for (const auto& operation : kOperations) {
    std::vector<int> all = code;
    all.insert(all.end(), operation.begin(), operation.end());
    BlobbyField whole = field(all, numbers);
    for (float x = -1.5f; x < 6; x += 0.5f) {
      Box box;
      box.add(Vec3(x, -0.2f, -0.2f));
      box.add(Vec3(x + 0.5f, 0.2f, 0.2f));
      BlobbyField part = whole.near(box);
      for (double t : {0.0, 0.1, 0.35, 0.5}) {
        glm::dvec3 p(static_cast<double>(x) + t, 0.1, -0.2);
        EXPECT_EQ(part.at(p), whole.at(p)) << operation[0] << " at " << p.x;
      }
    }
  }
}

/// Calls `f` with position and unit normal at corners of all pieces; returns the volume inside.
double visit(const Scene& s, const std::function<void(Vec3 P, Vec3 N)>& f) {
  double volume = 0;
  for (const Primitive& p : s.primitives) {
    SurfaceLattice l;
    float ends[2] = {0, 1};
    p.geometry->evaluate({ends, ends}, l);
    for (size_t k = 0; k < 4; ++k)
      f(l.P[k], glm::normalize(l.N[k]));
    volume += static_cast<double>(
        glm::dot(l.P[0] + l.P[1] + l.P[2] + l.P[3], glm::cross(l.P[3] - l.P[0], l.P[2] - l.P[1])));
  }
  return volume / 24;
}

TEST(Blobby, one_ellipsoid_is_one_of_half_the_size) {
  Scene s = scene_of("ShadingRate 1e-4 Blobby 1 [1001 0] [2 0 0 0 0 2 0 0 0 0 2 0 5 0 0 1] [\"\"]");
  ASSERT_FALSE(s.primitives.empty());
  double volume = visit(s, [](Vec3 P, Vec3 N) {
    Vec3 from_centre = P - Vec3(5, 0, 0);
    EXPECT_NEAR(glm::length(from_centre), 1, 1e-4f);
    EXPECT_NEAR(glm::dot(N, from_centre), 1, 1e-3f);
  });
  EXPECT_NEAR(volume, 4 * M_PI / 3, 0.05);
}

TEST(Blobby, pieces_are_as_fine_as_the_picture_needs) {
  auto pieces = [](const std::string& before) {
    return scene_of(before + " Blobby 1 [1001 0] [2 0 0 0 0 2 0 0 0 0 2 0 0 0 5 1] [\"\"]").primitives.size();
  };
  size_t fine = pieces("ShadingRate 1e-4"), coarse = pieces("ShadingRate 1e4");
  EXPECT_NEAR(static_cast<double>(fine) / static_cast<double>(coarse), 4, 0.5); // 24 and 12 across: squared
  EXPECT_EQ(pieces("ShadingRate 1e4 Scale 1e4 1e4 1"), fine);                   // larger in the picture
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
    p.geometry->evaluate({{&zero, 1}, {&zero, 1}}, l);
    double x = l.P[0].x, y = std::hypot(l.P[0].y, l.P[0].z);
    double a = sphere(std::hypot(x, y)), b = sphere(std::hypot(x - 0.8, y));
    ASSERT_EQ(p.vars.size(), 2u);
    EXPECT_NEAR(p.vars[0].values[0], b / (a + b), 1e-4);
    EXPECT_EQ(p.vars[1].values[0], 4);
  }
}

TEST(Blobby, operators_hand_values_on) {
  glm::dvec3 p(0.3, 0.1, 0);
  double a = sphere(std::hypot(0.3, 0.1)), b = sphere(std::hypot(0.7, 0.1));
  auto shares = [&](std::vector<int> operation) {
    std::vector<int> code{1001, 0, 1001, 16, 1000, 32};
    code.insert(code.end(), operation.begin(), operation.end());
    std::vector<double> out(3);
    field(code, kNumbers).shares(p, out);
    return out;
  };
  using Shares = std::vector<double>;
  auto near = [](double x, double y, double z) {
    return ::testing::Pointwise(::testing::DoubleNear(1e-12), Shares{x, y, z});
  };
  EXPECT_THAT(shares({0, 3, 0, 1, 2}), near(a / (a + b), b / (a + b), 0)); // the constant has no value
  EXPECT_THAT(shares({1, 2, 0, 1}), near(a / (a + b), b / (a + b), 0));
  EXPECT_THAT(shares({2, 2, 0, 1}), near(1, 0, 0));
  EXPECT_THAT(shares({3, 2, 0, 1}), near(0, 1, 0));
  EXPECT_THAT(shares({4, 1, 0}), near(0, 1, 0));
  EXPECT_THAT(shares({5, 0, 1}), near(1, 0, 0));
  EXPECT_THAT(shares({7, 1}), near(0, 1, 0));
  // max(a + b, b): the sum decides.
  EXPECT_THAT(shares({0, 2, 0, 1, 2, 2, 1, 3}), near(a / (a + b), b / (a + b), 0));
}

TEST(Blobby, the_ground_repels) {
  GroundProfile profile{2, 0.1f, 0.5f, 0.3f};
  EXPECT_EQ(profile.at(2), 0);
  EXPECT_EQ(profile.at(kInfinity), 0);
  // The bulge's peak and end by themselves, and close to the ground -B / z.
  auto ease = [](double e) { return e * e * (3 - 2 * e); };
  EXPECT_NEAR(profile.at(0.5), (0.3 - 0.1 / 0.5) * (1 - ease(0.25)), 1e-6);
  EXPECT_NEAR(profile.at(1.2), -0.1 / 1.2 * (1 - ease(0.6)), 1e-6);
  EXPECT_NEAR(profile.at(1e-3), -100, 0.1);
  EXPECT_NEAR(profile.at(-5), -1e5, 1);
}

/// A camera at z = -9 that looks along z at 4 x 4 units in parallel; depths rise by 0.5 from one of its four
/// pixels in a row to the next, and the last column is empty.
BlobbyGround slope() {
  DepthImage image;
  image.width = image.height = 4;
  for (int k = 0; k < 16; ++k)
    image.depth.push_back(k % 4 == 3 ? 1e30f : 10 + 0.5f * static_cast<float>(k % 4));
  image.world_to_camera = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 9, 1};
  image.world_to_screen = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.01f, 0, 0, 0, 0.09f, 1};
  Matrix4 object_to_world;
  object_to_world(3, 0) = 1; // the Blobby stands at x = 1
  return BlobbyGround(std::move(image), object_to_world);
}

TEST(Blobby, heights_above_a_depth_image) {
  BlobbyGround ground = slope();
  // Pixel centres are at world x = -1.5, -0.5, 0.5; their ground at world z = 1, 1.5, 2.
  EXPECT_NEAR(ground.height({-2.5, 0, 0}), 1, 1e-6);
  EXPECT_NEAR(ground.height({-2, 0.3, 0}), 1.25, 1e-6);
  EXPECT_NEAR(ground.height({-1.5, -1, 1}), 0.5, 1e-6);
  EXPECT_NEAR(ground.height({-2.5, 0, 3}), -2, 1e-6);
  EXPECT_NEAR(ground.height({-0.4, 0, 0}), 2, 1e-6); // half the pixels there are empty
  EXPECT_EQ(ground.height({0.4, 0, 0}), kInfinity);  // most are
  EXPECT_EQ(ground.height({-3.5, 0, 0}), kInfinity); // beside the image
}

TEST(Blobby, a_ground_keeps_the_surface_off) {
  // A ball of radius 2 (half of it seen) sinks into the slope, which repels within 0.8 of it.
  auto ground = std::make_shared<BlobbyGround>(slope());
  std::vector<float> numbers{4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, -2, 0, 0.5f, 1, 0.8f, 0.01f, 0.3f, 0.2f};
  const BlobbyField made = BlobbyField::make(
      std::vector<int>{1001, 0, 1003, 7, 16, 0, 2, 0, 1}, numbers,
      [](const std::string& text) { ADD_FAILURE() << text; },
      [&](int string) {
        EXPECT_EQ(string, 7);
        return ground;
      });
  Scene s;
  add_blobby(made, 0, {}, std::make_shared<PrimitiveState>(), s.primitives);
  ASSERT_FALSE(s.primitives.empty());
  int near = 0, free = 0;
  visit(s, [&](Vec3 P, Vec3) {
    double height = ground->height(glm::dvec3(P)), r = glm::distance(P, Vec3(-2, 0, 0.5f)) / 4;
    if (P.x < -2.8f || P.x > -0.5f || std::abs(P.y) > 1.8f)
      return; // where the depths end the ground does, too
    EXPECT_GT(height, 0);
    double field = sphere(r) + GroundProfile{0.8f, 0.01f, 0.3f, 0.2f}.at(height);
    if (height > 0.05 && height < 0.8) {
      EXPECT_NEAR(field, BlobbyField::kThreshold, 0.01);
    }
    if (height > 0.81) {
      EXPECT_NEAR(r, 0.5, 1e-4);
    }
    near += height < 0.1;
    free += height > 0.81;
  });
  EXPECT_GT(near, 100);
  EXPECT_GT(free, 100);
}

TEST(Blobby, the_picture_is_a_disc) {
  Rendered r = render_text(
      "Format 100 100 1 ScreenWindow -1 1 -1 1 PixelSamples 4 4 WorldBegin Translate 0 0 3 Sides 1 "
      "Blobby 1 [1001 0] [1.6 0 0 0 0 1.6 0 0 0 0 1.6 0 0 0 0 1] [\"\"] WorldEnd");
  EXPECT_NEAR(r.covered(), kPi * 1600, kPi * 16);
}

TEST(Blobby, mpoints_are_where_the_leaves_would_be) {
  // Two leaves, of which the second one is scaled and moved; in the other pose both are unit spheres, at x =
  // 5 and x = 9.
  const std::string rib = "Blobby 2 [1001 0 1001 16 0 2 0 1] [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 "
                          "2 0 0 0 0 2 0 0 0 0 2 0 1 0 0 1] [\"\"] \"vertex mpoint Pref\" "
                          "[1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1 1 0 0 0 0 1 0 0 0 0 1 0 9 0 0 1]";
  Scene s = scene_of(rib);
  ASSERT_FALSE(s.primitives.empty());
  for (const Primitive& p : s.primitives) {
    SurfaceLattice l;
    float zero = 0;
    p.geometry->evaluate({{&zero, 1}, {&zero, 1}}, l);
    const glm::dvec3 at(l.P[0]), second = (at - glm::dvec3(1, 0, 0)) / 2.0;
    const double a = sphere(glm::length(at)), b = sphere(glm::length(second));
    const glm::dvec3 expected =
        (a * (at + glm::dvec3(5, 0, 0)) + b * (second + glm::dvec3(9, 0, 0))) / (a + b);
    ASSERT_EQ(p.vars.size(), 1u);
    const PatchVar var = p.vars[0];
    EXPECT_EQ(var.type, slvm::Type::kPoint);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(var.values[static_cast<size_t>(c)], expected[c], 1e-4);
  }
  EXPECT_THAT(
      messages_of("WorldBegin Sphere 1 -1 1 360 \"vertex mpoint Pref\" [1] WorldEnd"),
      HasSubstr("error: Sphere: \"Pref\" is an mpoint: a Blobby has these, one vertex value for each leaf"));
  EXPECT_THAT(messages_of("Attribute \"user\" \"uniform mpoint m\" [1]"),
              HasSubstr("\"m\" is an mpoint: only a Blobby has these"));
}

TEST(Blobby, what_is_wrong_leaves_the_rest) {
  glm::dvec3 p(0.3, 0.1, 0);
  const double a = sphere(std::hypot(0.3, 0.1)), b = sphere(std::hypot(0.7, 0.1));
  auto value = [&](std::vector<int> code, std::string expected) {
    std::string said;
    const BlobbyField f =
        BlobbyField::make(code, kNumbers, [&](const std::string& text) { said += text + "\n"; });
    EXPECT_THAT(said, HasSubstr(expected));
    return f.at(p);
  };
  // A plug-in has five operands; it counts as a leaf. So does one without its numbers.
  EXPECT_NEAR(value({1001, 0, 1004, 0, 8, 0, 0, 0, 1001, 16, 0, 3, 0, 1, 2}, "plug-in"), a + b, 1e-12);
  EXPECT_NEAR(value({1001, 0, 1001, 30, 1001, 16, 2, 3, 0, 1, 2}, "takes 16 numbers"), std::max(a, b), 1e-12);
  EXPECT_NEAR(value({1001, 0, 9000, 4, 0, 16, 1, 32, 1001, 16, 0, 3, 0, 1, 2}, "code 9000 is a plug-in"),
              a + b, 1e-12);
  EXPECT_NEAR(value({1001, 0, 9000, 4, 0}, "code 9000 ends early"), a, 1e-12);
  // How long an unknown code is nobody knows: what stands before, used by no operator, is added up.
  EXPECT_NEAR(value({1001, 0, 1001, 16, 0, 2, 0, 1, 9001, 3, 1, 0, 1}, "unknown code 9001"), a + b, 1e-12);
  EXPECT_NEAR(value({1001, 0, 1001, 16, 9001, 0, 0, 2, 0, 1}, "unknown code 9001"), a + b, 1e-12);
}

TEST(Blobby, messages) {
  auto message = [](const std::string& arguments) {
    return messages_of("WorldBegin Blobby " + arguments + " [\"\"] WorldEnd");
  };
  EXPECT_THAT(
      message("1 [1001 0] [1 2]"),
      HasSubstr("warning: Blobby: a leaf of code 1001 takes 16 numbers; there are 2 from its index on; its "
                "field is 0"));
  EXPECT_THAT(message("1 [1001] []"), HasSubstr("a leaf of code 1001 ends early; what follows is not read"));
  EXPECT_THAT(message("1 [1001 0] [0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0]"),
              HasSubstr("the matrix of a leaf of code 1001 has no inverse"));
  EXPECT_THAT(message("1 [1001 0] [1e99 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0]"),
              HasSubstr("a leaf of code 1001 has a number that is not finite"));
  EXPECT_THAT(message("1 [1002 0] [0 0 0 1 1 1 0 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]"),
              HasSubstr("the radius of a segment is 0; it must be positive"));
  EXPECT_THAT(message("1 [1000 0 0 2 0] [1]"), HasSubstr("operator 0 ends before its operands"));
  EXPECT_THAT(message("1 [1000 0 6 1] [1]"),
              HasSubstr("operator 6 uses result 1, which does not precede it"));
  EXPECT_THAT(
      message("1 [1000 0 12] [1]"),
      HasSubstr(
          "warning: Blobby: unknown code 12; what follows is not read, what stands before is added up"));
  EXPECT_THAT(message("1 [1000 7] [1]"),
              HasSubstr("a leaf of code 1000 has its numbers from 7 on, and there are 1; its field is 0"));
  EXPECT_THAT(message("2 [1000 0] [1]"),
              HasSubstr("warning: Blobby: 'nleaf' is 2, but the code has 1 leaves, and that counts"));
  EXPECT_THAT(message("1 [1004 0 0 0 0 0] [1]"),
              HasSubstr("a leaf of code 1004 is a plug-in, and these are not supported; its field is 0"));
  EXPECT_THAT(message("1 [1003 3 0] [1 1 1 1]"),
              HasSubstr("a ground has the file 3 of 1; the ground has no effect"));
  EXPECT_THAT(message("1 [1003 0 0] [1 1 1 1]"),
              HasSubstr("\"\": no such file in the texture search path; the ground has no effect"));
  EXPECT_THAT(message("1 [1003 0 0] [0 1 1 1]"),
              HasSubstr("the heights of a ground are 0 and 1; they must be positive"));
}

} // namespace
} // namespace render::testing
