// Scatter maps: baked of meshes that are laid out flat, read back by shaders; files that are no scatter maps.
#include "tests/render/run_slrender.h"

#include <OpenImageIO/imageio.h>
#include <cmath>
#include <gmock/gmock.h>
#include <map>
#include <numbers>
#include <set>

namespace {

using ::testing::HasSubstr;

struct Triple {
  float x = 0, y = 0, z = 0;
};
float dot(Triple a, Triple b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A cube of 4 by 4 by 6 faces blown up to a ball of radius 1; `inside_out`: its faces turn the other way.
std::string ball(bool inside_out) {
  constexpr int kN = 4;
  std::map<std::array<int, 3>, int> numbers;
  std::string faces, points, counts;
  for (int side = 0; side < 6; ++side)
    for (int i = 0; i < kN; ++i)
      for (int j = 0; j < kN; ++j) {
        counts += "4 ";
        for (int corner = 0; corner < 4; ++corner) {
          const int k = inside_out ? 3 - corner : corner;
          const int a = 2 * (i + (k == 1 || k == 2)) - kN, b = 2 * (j + (k >= 2)) - kN;
          std::array<int, 3> p{};
          const auto axis = static_cast<size_t>(side / 2);
          p[axis] = side % 2 ? kN : -kN;
          p[(axis + 1) % 3] = side % 2 ? a : b;
          p[(axis + 2) % 3] = side % 2 ? b : a;
          const auto [it, is_new] = numbers.emplace(p, static_cast<int>(numbers.size()));
          faces += fmt::format("{} ", it->second);
          const float r = std::sqrt(static_cast<float>(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
          if (is_new)
            points += fmt::format("{} {} {} ", static_cast<float>(p[0]) / r, static_cast<float>(p[1]) / r,
                                  static_cast<float>(p[2]) / r);
        }
      }
  return fmt::format("SubdivisionMesh \"catmull-clark\" [{}] [{}] [] [] [] [] \"P\" [{}]\n", counts, faces,
                     points);
}

class ScatterMapFiles : public anemone::test::SlrenderTest {
protected:
  /// Renders NAME.tif with its four maps of ball.rib, whose middle is at (3, 0, 10) in the world.
  void bake(const std::string& name, const std::string& transform = "", const std::string& camera = "") {
    file(name + ".rib", fmt::format(R"(
Format 200 200 1
PixelSamples 1 1
PixelFilter "box" 1 1
Quantize "rgba" 0 0 0 0
ShadingInterpolation "smooth"
Display "{0}.tif" "tiff" "rgba"
Display "+{0}P.tif" "tiff" "varying point ScatterP" "string compression" ["lzw"]
Display "+{0}N.tif" "tiff" "varying normal ScatterN" "string compression" ["lzw"]
Display "+{0}A.tif" "tiff" "varying float ScatterA" "string compression" ["lzw"]
Display "+{0}F.tif" "tiff" "varying float ScatterF" "string compression" ["lzw"]
Projection "orthographic"
{2}
WorldBegin
Translate 3 0 10
{1}
CoordinateSystem "actualobject"
Surface "bakescatter" "string ScatterActualObject" "actualobject"
CoordSysTransform "NDC"
Procedural "Fragment" ["ball.rib"] [0 1 0 1 0 1]
WorldEnd
)",
                                    name, transform, camera));
    const Outcome o = run(name + ".rib");
    EXPECT_EQ(o.text, "");
    EXPECT_EQ(o.status, 0);
  }
  struct Samples {
    size_t count = 0, outward = 0;
    double area = 0, farthest = 0, nearest = 1e9, off_centre = 0;
  };
  Samples samples(const std::string& name) {
    const auto P = pixels(name + "P.tif"), N = pixels(name + "N.tif"), A = pixels(name + "A.tif");
    Samples s;
    double middle[3] = {};
    for (size_t i = 0; i < A.size(); ++i) {
      if (!(A[i] > 0)) continue;
      ++s.count;
      const Triple p{P[3 * i] - 3, P[3 * i + 1], P[3 * i + 2] - 10}, n{N[3 * i], N[3 * i + 1], N[3 * i + 2]};
      const double r = std::sqrt(static_cast<double>(dot(p, p)));
      s.area += static_cast<double>(A[i]);
      s.farthest = std::max(s.farthest, r), s.nearest = std::min(s.nearest, r);
      s.outward += dot(p, n) > 0.97f * static_cast<float>(r);
      for (int c = 0; c < 3; ++c)
        middle[c] += static_cast<double>(A[i] * (c == 0 ? p.x : c == 1 ? p.y : p.z));
    }
    for (double m : middle)
      s.off_centre = std::max(s.off_centre, std::abs(m) / s.area);
    return s;
  }
};

// The limit surface is a ball of radius 0.933 to 0.974, its area 11.45.
TEST_F(ScatterMapFiles, HoldTheSurfaceInTheWorld) {
  file("ball.rib", ball(false));
  bake("a");
  const Samples s = samples("a");
  EXPECT_GT(s.count, 10000u);
  EXPECT_EQ(s.outward, s.count);
  EXPECT_NEAR(s.area, 11.45, 0.06);
  EXPECT_NEAR(s.nearest, 0.9327, 0.003);
  EXPECT_NEAR(s.farthest, 0.974, 0.001);
  EXPECT_LT(s.off_centre, 0.003);
}

TEST_F(ScatterMapFiles, NormalsAreThoseOfTheMeshHoweverItAndTheCameraAreTurned) {
  file("ball.rib", ball(true));
  bake("a", "Rotate 30 1 1 0");
  Samples s = samples("a");
  EXPECT_EQ(s.outward, 0u);
  EXPECT_NEAR(s.area, 11.45, 0.06);
  file("ball.rib", ball(false));
  bake("b", "Rotate 30 1 1 0", "Rotate 40 0 1 0 Scale -1 1 1");
  s = samples("b");
  EXPECT_EQ(s.outward, s.count);
  EXPECT_NEAR(s.area, 11.45, 0.06);
}

/// One pixel of a file, of a frame of `surface` on a part of the ball.
const char* const kPatch = R"(
Format 24 24 1
PixelSamples 1 1
PixelFilter "box" 1 1
Projection "orthographic"
ScreenWindow -.2 .2 -.2 .2
Translate -3 0 -6
Display "out.tif" "tiff" "rgb" "float[4] quantize" [0 0 0 0]
WorldBegin
LightSource "{}" 1 "from" [0 0 0] "to" [0 0 1]
Translate 3 0 10
Surface "scatterskin" "map" "{}" "width" {} "amount" 1 "Ks" 0
ReadArchive "ball.rib"
WorldEnd
)";

// On top of the ball the light falls off as 1 - d^2/(2 r^2), and the kernel's mean of d^2 is 5/21 D^2: 0.995
// and 0.916. For the greater distance bounce attenuation takes 4 % more.
TEST_F(ScatterMapFiles, ShadersScatterByThem) {
  file("ball.rib", ball(false));
  bake("skin");
  // A light as for filtered shadows: it learns that a sample is lit, and its area, as a part of all samples'.
  file("knowing.sl", "light knowing(point from = 0, to = 0;) {\n  float samples = 0, area = 0;\n"
                     "  surface(\"__overrideDerivs\", samples);\n  surface(\"__derivA\", area);\n"
                     "  solar(to - from, 0) Cl = samples * color (1, area, 1);\n}\n");
  auto at = [&](const std::string& map, double width, const std::string& light = "distantlight",
                size_t channel = 0) {
    file("b.rib", fmt::format(fmt::runtime(kPatch), light, map, width));
    const Outcome o = run("b.rib");
    EXPECT_EQ(o.text, "");
    const auto p = pixels("out.tif");
    return p.empty() ? 0.0f : p[3 * (12 * 24 + 12) + channel];
  };
  EXPECT_NEAR(at("skin.tif", 0.2), 0.995, 0.03);
  EXPECT_NEAR(at("skin.tif", 0.8), 0.885, 0.03);
  EXPECT_NEAR(at("skin.tif", 0.2, "knowing"), 0.995, 0.03);
  const Samples all = samples("skin");
  EXPECT_NEAR(at("skin.tif", 0.2, "knowing", 1), all.area / static_cast<double>(all.count), 2e-4);
}

// With a fourth picture samples are found by faces: the same picture, with most of them on disk as well.
TEST_F(ScatterMapFiles, ByFaces) {
  file("ball.rib", ball(false));
  bake("skin");
  const auto F = pixels("skinF.tif"), A = pixels("skinA.tif");
  std::set<float> faces;
  for (size_t i = 0; i < A.size(); ++i)
    if (A[i] > 0) faces.insert(F[i]);
  EXPECT_EQ(faces.size(), 96u);
  EXPECT_EQ(*faces.rbegin(), 95);
  auto look = [&](const std::string& option) {
    file("b.rib", option + fmt::format(fmt::runtime(kPatch), "distantlight", "skin.tif", 0.3));
    const Outcome o = run("b.rib");
    EXPECT_EQ(o.text, "");
    return pixels("out.tif");
  };
  const auto by_faces = look(""), short_of_memory = look("Option \"limits\" \"int octreememory\" 50\n");
  std::filesystem::remove(directory_ / "skinF.tif");
  const auto by_tree = look("");
  EXPECT_EQ(short_of_memory, by_faces);
  ASSERT_EQ(by_tree.size(), by_faces.size());
  for (size_t i = 0; i < by_tree.size(); ++i)
    EXPECT_NEAR(by_faces[i], by_tree[i], 1e-4f);
}

TEST_F(ScatterMapFiles, WhatIsNoScatterMap) {
  file("ball.rib", ball(false));
  bake("skin");
  auto complaint = [&](const std::string& map) {
    file("b.rib", fmt::format(fmt::runtime(kPatch), "distantlight", map, 0.2));
    return run("b.rib").text;
  };
  auto save = [&](const std::string& name, int width, int channels, OIIO::TypeDesc type, int tile = 0) {
    const std::string path = (directory_ / name).string();
    auto out = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(width, width, channels, type);
    spec.tile_width = spec.tile_height = tile;
    ASSERT_TRUE(out->open(path, spec));
    std::vector<float> zero(static_cast<size_t>(width * width * channels), 1.0f);
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, zero.data()));
  };
  EXPECT_THAT(complaint("none.tif"), HasSubstr("noneP.tif: "));
  file("textP.tif", "no picture");
  EXPECT_THAT(complaint("text.tif"), HasSubstr("textP.tif: "));
  save("byteP.tif", 8, 3, OIIO::TypeDesc::UINT8);
  EXPECT_THAT(
      complaint("byte.tif"),
      HasSubstr("byteP.tif: a picture of a scatter map has 32-bit floats (Quantize \"rgba\" 0 0 0 0)"));
  save("thinP.tif", 8, 1, OIIO::TypeDesc::FLOAT);
  EXPECT_THAT(complaint("thin.tif"), HasSubstr("thinP.tif: it has 1 channels, 3 are wanted"));
  save("sizeP.tif", 8, 3, OIIO::TypeDesc::FLOAT);
  save("sizeN.tif", 9, 3, OIIO::TypeDesc::FLOAT);
  EXPECT_THAT(complaint("size.tif"),
              HasSubstr("sizeN.tif has 9 x 9 pixels, sizeP.tif 8 x 8: they must come from one rendering"));
  std::filesystem::resize_file(directory_ / "skinA.tif", 2000);
  EXPECT_THAT(complaint("skin.tif"), HasSubstr("skinA.tif: "));
  // Tiles and further channels are fine.
  save("tiledP.tif", 40, 3, OIIO::TypeDesc::FLOAT, 16);
  save("tiledN.tif", 40, 4, OIIO::TypeDesc::FLOAT, 16);
  save("tiledA.tif", 40, 1, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(complaint("tiled.tif"), "");
}

} // namespace
