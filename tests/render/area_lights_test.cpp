// Area lights: what a surface gets from shining ones, beside what form factors say in closed form (J. R.
// Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-11 to B-14); which primitives shine,
// and when.
#include "tests/render/renderer_fixture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace render {
namespace {

using ::testing::HasSubstr;

constexpr double kPi64 = std::numbers::pi;

/// Equally bright from all sides in front, as the standard shader; a point of it by "from" is another matter.
constexpr const char* kGlow =
    "light glow(float intensity = 1; color lightcolor = 1) { illuminate(P, N, PI / 2) "
    "Cl = intensity * lightcolor * (normalize(N) . normalize(L)) / (L . L); }";
constexpr const char* kPoint = "light point1(float intensity = 1; point from = point \"shader\" (0,0,0)) { "
                               "illuminate(from) Cl = intensity / (L . L); }";

class AreaLightTest : public testing::RendererTest {
protected:
  AreaLightTest() {
    shaders_ = {{"matte", testing::kMatte}, {"show", testing::kShow}, {"glow", kGlow}, {"point1", kPoint}};
  }

  /// A small piece of a plane, z = 0 of its space, under lights that `lights` makes above it, at negative z.
  std::string under(const std::string& lights, const std::string& receiver = "Surface \"matte\"",
                    const std::string& before = "") {
    return render("ScreenWindow -.005 .005 -.005 .005 PixelSamples 1 1 " + before +
                  " WorldBegin Translate 0 0 9 Attribute \"light\" \"nsamples\" 64 " + lights + receiver +
                  " Disk 0 9 360 WorldEnd");
  }
  /// The mean over the picture of a channel.
  double mean(int c = 0) const {
    double sum = 0;
    for (int i = 0; i < 256; ++i)
      sum += static_cast<double>(value(i % 16, i / 16, c));
    return sum / 256;
  }
};

/// An area light of this surface, which the camera does not see.
std::string lamp(const std::string& surface, const std::string& light = "\"glow\" 1 \"intensity\" 10") {
  return "AttributeBegin Attribute \"visibility\" \"camera\" 0 AreaLightSource " + light + " " + surface +
         " AttributeEnd Illuminate 1 1 ";
}

/// From an element of a plane to a parallel rectangle of sides a and b at distance h, a corner of which is
/// straight above it.
double corner_factor(double a, double b, double h) {
  const double x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPi64);
}

TEST_F(AreaLightTest, a_disk) {
  EXPECT_EQ(under(lamp("Translate 0 0 -2 Disk 0 1.5 360")), "");
  EXPECT_NEAR(mean(), 10 / (1.5 * 1.5 + 2 * 2), 0.005 * 1.6);
  // Each point by itself is near, too: samples are spread evenly.
  EXPECT_NEAR(value(5, 7, 0), 1.6f, 0.08f);
}

TEST_F(AreaLightTest, a_rectangle) {
  const double expected = 10 * kPi64 * corner_factor(3, 2, 1.5) / 6;
  EXPECT_EQ(under(lamp("Polygon \"P\" [0 0 -1.5 3 0 -1.5 3 2 -1.5 0 2 -1.5]")), "");
  const double one_side = mean();
  EXPECT_EQ(under(lamp("ReverseOrientation Polygon \"P\" [0 0 -1.5 3 0 -1.5 3 2 -1.5 0 2 -1.5]")), "");
  EXPECT_NEAR(std::max(one_side, mean()), expected, 0.005 * expected);
  EXPECT_EQ(std::min(one_side, mean()), 0); // it shines to one side
}

TEST_F(AreaLightTest, several_primitives_are_one_light_by_their_areas) {
  const double expected = 10 * kPi64 * corner_factor(3, 2, 1.5) / 6;
  // The same rectangle in unequal pieces: a mesh with triangles, a patch and a polygon.
  const std::string pieces =
      "PointsPolygons [3 3] [0 1 2 0 2 3] \"P\" [0 0 -1.5 1 0 -1.5 1 .5 -1.5 0 .5 -1.5] "
      "Patch \"bilinear\" \"P\" [1 0 -1.5 3 0 -1.5 1 .5 -1.5 3 .5 -1.5] "
      "Polygon \"P\" [0 .5 -1.5 3 .5 -1.5 3 2 -1.5 0 2 -1.5]";
  // Whichever way they face.
  shaders_["glow"] = "light glow(float intensity = 1) { illuminate(P) "
                     "Cl = intensity * abs(normalize(N) . normalize(L)) / (L . L); }";
  EXPECT_EQ(under(lamp(pieces)), "");
  EXPECT_NEAR(mean(), expected, 0.005 * expected);
}

TEST_F(AreaLightTest, curved_surfaces_shine_by_their_areas) {
  // A sphere is as bright as its outline: a disk of the same radiance, which its area divides.
  EXPECT_EQ(under(lamp("Translate 0 0 -4 Sphere 1 -1 1 360")), "");
  EXPECT_NEAR(mean(), 10 / (4.0 * 4 * 4), 0.01 * 0.156);
  // The same as a scaled one, and a part of it as bright as all of it from below.
  EXPECT_EQ(under(lamp("Translate 0 0 -4 Scale .5 .5 .5 Sphere 2 -2 2 360")), "");
  EXPECT_NEAR(mean(), 10 / (4.0 * 4 * 4), 0.01 * 0.156);
}

TEST_F(AreaLightTest, a_light_that_knows_nothing_of_surfaces_shines_from_their_points) {
  EXPECT_EQ(under(lamp("Translate 0 0 -2 Disk 0 1.5 360", "\"point1\" 1 \"intensity\" 10")), "");
  const double r = 1.5, h = 2, expected = 10 * 2 / (r * r) * (1 - h / std::hypot(h, r));
  EXPECT_NEAR(mean(), expected, 0.005 * expected);
  // One that stands elsewhere goes on standing there.
  EXPECT_EQ(under(lamp("Translate 0 0 -2 Disk 0 1.5 360", "\"point1\" 1 \"intensity\" 10 \"from\" [0 0 -1]")),
            "");
  EXPECT_NEAR(mean(), 10, 1e-3);
}

TEST_F(AreaLightTest, light_shaders_read_the_surface) {
  shaders_["glow"] = "light glow(color lightcolor = 1) { illuminate(P) Cl = lightcolor * color(s, v, "
                     "length(dPdu)) / ((L . L) * (normalize(Ns) . normalize(-L))); }"; // and no cosines
  // All points are as far away as the sphere's middle: the mean of what is there.
  const std::string patch = "Patch \"bilinear\" \"P\" [-.01 -.01 -1 .01 -.01 -1 -.01 .01 -1 .01 .01 -1] ";
  EXPECT_EQ(under(lamp(patch + "\"s\" [0 2 0 2]", "\"glow\" 1")), "");
  EXPECT_NEAR(mean(0), 1, 0.01);
  EXPECT_NEAR(mean(1), 0.5, 0.005);
  EXPECT_NEAR(mean(2), 0.02, 0.0005);
  // A primitive variable is the parameter of its name.
  EXPECT_EQ(under(lamp(patch + "\"varying color lightcolor\" [1 0 0  1 0 0  3 0 4  3 0 4]", "\"glow\" 1")),
            "");
  EXPECT_NEAR(mean(0), 0.5 * (0.5 * 1 + 0.5 * 3), 0.02);
  EXPECT_NEAR(mean(2), 0.5 * 4 * 0.02, 0.001);
}

TEST_F(AreaLightTest, an_ambient_one_gives_the_mean_of_its_surface) {
  shaders_["inside"] = "light inside() { Cl = s; }";
  EXPECT_EQ(under(lamp("Translate 0 0 -2 Disk 0 1 360", "\"inside\" 1")), "");
  EXPECT_NEAR(mean(), 0.5, 0.005);
}

TEST_F(AreaLightTest, it_is_seen_and_ends_with_its_block_or_with_null) {
  // What shines is drawn with its own surface; what stands behind "null" or the block does not shine.
  const std::string square = "Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] ";
  EXPECT_EQ(render("WorldBegin AttributeBegin AreaLightSource \"glow\" 1 Surface \"show\" \"k\" .25 "
                   "Translate 0 0 5 " +
                   square + "AttributeEnd WorldEnd"),
            "");
  EXPECT_FLOAT_EQ(value(8, 8, 0), 0.25f);
  const std::string small = "Translate 0 0 -2 Disk 0 1.5 360 ";
  for (const std::string& more : {std::string("AreaLightSource \"null\" 2 "),
                                  std::string("AreaLightSource \"point1\" 2 \"intensity\" 0 ")}) {
    EXPECT_EQ(
        under(lamp("AttributeBegin " + small + "AttributeEnd " + more + "Translate 0 0 -8 Disk 0 6 360")),
        "");
    EXPECT_NEAR(mean(), 1.6, 0.01) << more;
  }
  EXPECT_EQ(under(lamp(small) + "AttributeBegin Translate 0 0 -8 Attribute \"visibility\" \"camera\" 0 "
                                "Disk 0 6 360 AttributeEnd "),
            "");
  EXPECT_NEAR(mean(), 1.6, 0.01);
}

TEST_F(AreaLightTest, without_a_surface_it_is_a_light_like_others) {
  EXPECT_THAT(
      under("AttributeBegin Translate 0 0 -2 AreaLightSource \"point1\" 1 \"intensity\" 10 "
            "AttributeEnd Illuminate 1 1 "),
      HasSubstr("warning: AreaLightSource: \"point1\" has no surface: no primitive follows, or none with "
                "an area; it shines from the origin of its space [-Wrib-shader]\n"));
  EXPECT_NEAR(mean(), 2.5, 1e-3);
}

TEST_F(AreaLightTest, its_shadows_are_soft) {
  shaders_["glow"] = "light glow(float intensity = 1) { illuminate(P, N, PI / 2) Cl = intensity * "
                     "(normalize(N) . normalize(L)) / (L . L) * transmission(Ps, P); }";
  // A rectangle seen half of: the edge of what is in between is above the point.
  const std::string screen = "AttributeBegin Attribute \"visibility\" \"camera\" 0 \"transmission\" "
                             "\"opaque\" Polygon \"P\" [0 -9 -1 9 -9 -1 9 9 -1 0 9 -1] AttributeEnd ";
  EXPECT_EQ(under(lamp("Translate 0 0 -2 Disk 0 1.5 360") + screen), "");
  EXPECT_NEAR(mean(), 0.8, 0.01);
}

TEST_F(AreaLightTest, pictures_do_not_depend_on_threads) {
  const std::string scene = "PixelSamples 2 2 Option \"limits\" \"bucketsize\" [4 4] WorldBegin "
                            "Translate 0 0 9 Attribute \"light\" \"nsamples\" 4 " +
                            lamp("Translate 0 0 -2 Disk 0 1.5 360") +
                            "Surface \"matte\" Disk 0 9 360 Sphere .5 -.5 .5 360 WorldEnd";
  EXPECT_EQ(render(scene), "");
  std::vector<float> one;
  for (int i = 0; i < 256; ++i)
    one.push_back(value(i % 16, i / 16, 0));
  settings_.threads = 4;
  EXPECT_EQ(render(scene), "");
  for (int i = 0; i < 256; ++i)
    EXPECT_EQ(value(i % 16, i / 16, 0), one[static_cast<size_t>(i)]) << i;
}

TEST_F(AreaLightTest, samples_are_an_attribute) {
  // One sample is a point of the surface, another for each shading point: rough, but right on average.
  auto roughness = [&](const char* samples) {
    EXPECT_EQ(
        under("Attribute \"light\" " + std::string(samples) + " " + lamp("Translate 0 0 -2 Disk 0 1.5 360")),
        "");
    double sum = 0, middle = mean();
    for (int i = 0; i < 256; ++i)
      sum += std::pow(static_cast<double>(value(i % 16, i / 16, 0)) - middle, 2);
    EXPECT_NEAR(middle, 1.6, 0.1);
    return std::sqrt(sum / 256);
  };
  const double rough = roughness("\"nsamples\" 1"), smooth = roughness("\"nsamples\" 16"),
               smoother = roughness("\"nsamples\" 256");
  EXPECT_GT(rough, 4 * smooth);
  EXPECT_GT(smooth, 4 * smoother);
}

TEST_F(AreaLightTest, the_surface_may_come_from_a_procedural_and_is_where_it_is_without_displacement) {
  shaders_["up"] = "displacement up() { P += vector \"object\" (0, 0, 1); }";
  std::ofstream(path("lamp.rib")) << "Disk 0 1.5 360\n";
  EXPECT_THAT(under(lamp("Displacement \"up\" Translate 0 0 -2 Procedural \"DelayedReadArchive\" [\"" +
                         path("lamp.rib") + "\"] [-2 2 -2 2 -1 1]")),
              HasSubstr("AreaLightSource: its surface sends light from where it is without displacement"));
  EXPECT_NEAR(mean(), 1.6, 0.01);
}

} // namespace
} // namespace render
