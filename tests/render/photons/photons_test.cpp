// Frames with Hider "photon": what they store, against closed forms; and pictures that use it.
#include "render/photons/photon_tracer.h"
#include "render/renderer.h"
#include "slvm/support/files.h"
#include "tests/render/shader_texts.h"
#include "tests/temp_folder.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace render {
namespace {

using ::testing::HasSubstr;

constexpr int kSize = 16;

/// A lamp of even light in all directions; in half of them; and parallel light.
constexpr const char* kBulb =
    "light bulb(float intensity = 1; point from = point \"shader\" (0, 0, 0); color c = 1) { "
    "illuminate(from) Cl = intensity * c / (L . L); }";
constexpr const char* kSpot =
    "light spot(float intensity = 1, angle = .5; point from = point \"shader\" (0, 0, 0)) { "
    "illuminate(from, vector \"shader\" (0, -1, 0), angle) Cl = intensity / (L . L); }";
constexpr const char* kSun =
    "light sun(float intensity = 1) { solar(vector \"shader\" (0, -1, 0), 0) Cl = intensity; }";
constexpr const char* kLinear =
    "light linear(point from = point \"shader\" (0, 0, 0)) { illuminate(from) Cl = 1 / length(L); }";

class PhotonFrame : public ::testing::Test {
protected:
  std::map<std::string, std::string> shaders_ = {
      {"bulb", kBulb},
      {"spot", kSpot},
      {"sun", kSun},
      {"linear", kLinear},
      {"constant", "surface constant() { Ci = Cs; Oi = Os; }"},
      {"map",
       "surface map(string file = \"\", type = \"irradiance\"; float n = 200) { Ci = photonmap(file, P, "
       "faceforward(normalize(N), I), \"estimator\", n, \"lookuptype\", type); Oi = 1; }"},
      {"gathered",
       "surface gathered() { Ci = indirectdiffuse(P, faceforward(normalize(N), I), 256); Oi = 1; }"}};
  anemone::test::TempFolder folder_;
  std::string messages_;
  PhotonReport report_;

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  void run(const std::string& rib, int threads = 2) {
    RendererSettings settings;
    settings.threads = threads;
    settings.shader_loader = [this](const std::string& name, const std::vector<std::string>&) {
      return testing::compile_shader_text(shaders_, name);
    };
    settings.photons = [this](const PhotonReport& r) { report_ = r; };
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    Renderer renderer(sources, diagnostics, settings);
    renderer.read_text("scene.rib", rib);
    renderer.finish();
    messages_ = format_diagnostics(diagnostics, sources);
  }
  /// A frame of photons, all stored in a.gpm.
  std::vector<Photon> emit(const std::string& world, int photons = 40000, int threads = 2) {
    std::filesystem::remove(file("a.gpm"));
    run(fmt::format(
            "Hider \"photon\" \"int emit\" {}\nWorldBegin Attribute \"photon\" \"string globalmap\" \"{}\" "
            "Attribute \"trace\" \"int maxdiffusedepth\" 0 \"int maxspeculardepth\" 5 \"float bias\" "
            ".001\n{}\nWorldEnd\n",
            photons, file("a.gpm"), world),
        threads);
    return photons_in("a.gpm");
  }
  std::vector<Photon> photons_in(const std::string& name) {
    auto table = read_point_table(file(name));
    if (!table) return {};
    auto photons = photons_of(*table, name);
    EXPECT_TRUE(photons) << photons.error();
    return photons ? std::move(*photons) : std::vector<Photon>();
  }
  static Color power_of(const std::vector<Photon>& photons) {
    glm::dvec3 sum(0);
    for (const Photon& p : photons)
      sum += glm::dvec3(p.power);
    return Color(sum);
  }
  /// kSize x kSize pixels of 4 floats, of the square [-1, 1]^2 seen along z.
  std::vector<float> picture(const std::string& world) {
    run(fmt::format(
        "Format {0} {0} 1 Display \"{1}\" \"openexr\" \"rgba\" PixelSamples 2 2 Projection \"orthographic\" "
        "WorldBegin {2} WorldEnd\n",
        kSize, file("out.exr"), world));
    std::vector<float> pixels(kSize * kSize * 4);
    if (auto in = OIIO::ImageInput::open(file("out.exr")))
      in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, pixels.data());
    return pixels;
  }
  static double mean(const std::vector<float>& pixels, size_t c) {
    double sum = 0;
    for (size_t i = 0; i < kSize * kSize; ++i)
      sum += static_cast<double>(pixels[4 * i + c]) / (kSize * kSize);
    return sum;
  }
  static std::string floor(float size = 1, float y = 0) {
    return fmt::format("Polygon \"P\" [-{0} {1} -{0} -{0} {1} {0} {0} {1} {0} {0} {1} -{0}]\n", size, y);
  }
};

TEST_F(PhotonFrame, a_lamp_in_a_closed_ball_brings_all_its_power) {
  const auto photons =
      emit("LightSource \"bulb\" 1 \"intensity\" 3 \"color c\" [1 .5 .25] Sphere 2 -2 2 360");
  EXPECT_EQ(messages_, "");
  EXPECT_EQ(photons.size(), 40000u);
  const double whole = 4 * M_PI * 3;
  EXPECT_NEAR(power_of(photons).x, whole, 0.005 * whole);
  EXPECT_NEAR(power_of(photons).y, whole / 2, 0.005 * whole);
  // Everywhere alike: the irradiance of I / r^2.
  const PhotonMap map(photons);
  for (Vec3 n : {Vec3(1, 0, 0), Vec3(0, -1, 0), glm::normalize(Vec3(1, 2, -3))})
    EXPECT_NEAR(map.irradiance({2.0f * n, -n, 1000, kInfinity, 0}).x, 0.75f, 0.06f);
}

TEST_F(PhotonFrame, scattered_power_is_the_geometric_series) {
  // Albedo 0.6, three scatterings: 1 + 0.6 + 0.36 + 0.216.
  const auto photons =
      emit("LightSource \"bulb\" 1 Attribute \"trace\" \"int maxdiffusedepth\" 3 Color .6 .6 .3 "
           "Sphere 2 -2 2 360");
  const double whole = 4 * M_PI;
  EXPECT_NEAR(power_of(photons).x / whole, 2.176, 0.03);
  EXPECT_NEAR(power_of(photons).z / whole, 1 + .3 + .09 + .027, 0.03);
}

TEST_F(PhotonFrame, power_is_absorbed_or_escapes) {
  // A lamp over a large floor of albedo 0.5, scattered once: of the half that comes down half is absorbed
  // there.
  const auto photons =
      emit("LightSource \"bulb\" 1 \"point from\" [0 .02 0] Attribute \"trace\" \"int maxdiffusedepth\" 1 "
           "Color .5 .5 .5 " +
           floor(20));
  const double whole = 4 * M_PI;
  EXPECT_EQ(report_.emitted, 40000u);
  EXPECT_EQ(report_.stored, photons.size());
  EXPECT_NEAR(report_.power.x, whole, 0.005 * whole);
  EXPECT_NEAR((report_.absorbed.x + report_.escaped.x) / report_.power.x, 1, 1e-3);
  EXPECT_NEAR(report_.absorbed.x / whole, 0.25, 0.01);
  EXPECT_NEAR(report_.escaped.x / whole, 0.75, 0.01);
}

TEST_F(PhotonFrame, a_plane_under_a_lamp_is_lit_as_by_the_lamp) {
  emit("LightSource \"bulb\" 1 \"intensity\" 2 \"point from\" [0 1 0] Color .5 .5 .5 " + floor(3), 200000);
  const PhotonMap map(photons_in("a.gpm"));
  for (float x : {0.0f, 0.5f, 1.0f, 1.5f}) {
    const float d2 = 1 + x * x, expected = 2 / (d2 * std::sqrt(d2));
    EXPECT_NEAR(map.irradiance({{x, 0, 0}, {0, 1, 0}, 500, kInfinity, 0}).x, expected, 0.1f * expected) << x;
    EXPECT_EQ(map.irradiance({{x, 0, 0}, {0, -1, 0}, 500, kInfinity, 0}).x, 0);
  }
  // Radiance is that times the colour of the surface.
  EXPECT_NEAR(map.radiance({0, 0, 0}, {0, 1, 0}).x, 1, 0.2f);
}

TEST_F(PhotonFrame, a_plane_under_an_area_light_is_lit_as_by_its_light_loops) {
  shaders_["glow"] = "light glow(float intensity = 1) { illuminate(P, N, PI / 2) Cl = intensity * "
                     "(normalize(N) . normalize(L)) / (L . L); }";
  const std::vector<Photon> photons =
      emit("AttributeBegin AreaLightSource \"glow\" 1 \"intensity\" 2 Translate 0 1 0 Rotate 90 1 0 0 "
           "Disk 0 .8 360 AttributeEnd Illuminate 1 1 " +
               floor(9),
           200000);
  EXPECT_EQ(messages_, "");
  EXPECT_NEAR(power_of(photons).x, 2 * M_PI, 0.15 * M_PI); // but for what misses the floor
  const PhotonMap map(photons);
  EXPECT_NEAR(map.irradiance({{0, 0, 0}, {0, 1, 0}, 1000, kInfinity, 0}).x, 2 / (0.8f * 0.8f + 1), 0.1f);
}

TEST_F(PhotonFrame, parallel_light_is_as_strong_everywhere) {
  emit("LightSource \"sun\" 1 \"intensity\" .8 " + floor(2), 100000);
  EXPECT_EQ(messages_, "");
  const PhotonMap map(photons_in("a.gpm"));
  for (float x : {-1.2f, 0.0f, 0.9f})
    EXPECT_NEAR(map.irradiance({{x, 0, x / 2}, {0, 1, 0}, 500, kInfinity, 0}).x, 0.8f, 0.08f);
}

TEST_F(PhotonFrame, cones_and_shares_are_those_of_the_shaders) {
  // In a cone of 0.5: 2 pi (1 - cos 0.5) of the lamp's intensity.
  auto photons = emit("LightSource \"spot\" 1 \"point from\" [0 2 0] " + floor(3));
  const double cone = 2 * M_PI * (1 - std::cos(0.5));
  EXPECT_NEAR(power_of(photons).x, cone, 0.02 * cone);
  for (const Photon& p : photons)
    EXPECT_LE(std::hypot(p.P.x, p.P.z), 2 * std::tan(0.5) + 1e-3);
  // Two lamps, 1 to 3, each over a floor of its own.
  photons =
      emit("LightSource \"spot\" 1 \"point from\" [-10 2 0] LightSource \"spot\" 2 \"point from\" [10 2 0] "
           "\"intensity\" 3 " +
           floor(20));
  double left = 0;
  for (const Photon& p : photons)
    left += p.P.x < 0;
  EXPECT_NEAR(left / static_cast<double>(photons.size()), 0.25, 0.02);
}

TEST_F(PhotonFrame, what_surfaces_do) {
  const std::string lamp = "LightSource \"spot\" 1 \"float angle\" .3 \"point from\" [0 2 0]\n";
  auto count = [&](const std::string& model, const std::string& more = "") {
    return emit(lamp + "AttributeBegin Attribute \"photon\" \"string shadingmodel\" \"" + model + "\" " +
                more + floor(1) + "AttributeEnd " + floor(4, -1))
        .size();
  };
  const size_t all = count("transparent");
  EXPECT_NEAR(static_cast<double>(all), 40000, 8000); // what misses the cone is not stored
  for (const Photon& p : photons_in("a.gpm"))
    EXPECT_NEAR(p.P.y, -1, 1e-3);
  EXPECT_EQ(count("chrome"), 0u); // back up, where nothing is
  EXPECT_EQ(count("matte", "Color 0 0 0 "), 0u);
  EXPECT_EQ(count("matte"), all);
  ASSERT_FALSE(photons_in("a.gpm").empty());
  EXPECT_EQ(photons_in("a.gpm")[0].P.y, 0);
  // A pane: enters, and leaves by total reflection or refraction; a little is reflected.
  EXPECT_NEAR(static_cast<double>(count("glass")) / static_cast<double>(all), 0.96, 0.01);
  EXPECT_NEAR(static_cast<double>(count("water")) / static_cast<double>(all), 0.98, 0.01);
  // Other indices of refraction, in the model or beside it: ((n - 1) / (n + 1))^2 is reflected.
  EXPECT_NEAR(static_cast<double>(count("refractive:ior=1.333")) / static_cast<double>(all), 0.98, 0.01);
  EXPECT_NEAR(static_cast<double>(count("glass", "Attribute \"photon\" \"float ior\" 2 ")) /
                  static_cast<double>(all),
              0.889, 0.01);
  // Half of what is scattered goes down.
  EXPECT_NEAR(static_cast<double>(count("translucent", "Attribute \"trace\" \"int maxdiffusedepth\" 1 ")) /
                  static_cast<double>(all),
              1.5, 0.1);
}

TEST_F(PhotonFrame, arrive_with_the_colour_they_had) {
  for (const Photon& p : emit("LightSource \"bulb\" 1 \"point from\" [0 1 0] Color .9 0 0 " + floor(2)))
    EXPECT_EQ(p.power.x, p.power.y);
}

TEST_F(PhotonFrame, caustics_come_by_mirrors_only) {
  run(fmt::format(
      "Hider \"photon\" \"int emit\" 20000 WorldBegin Attribute \"trace\" \"float bias\" .001\n"
      "LightSource \"spot\" 1 \"point from\" [0 2 0] Attribute \"photon\" \"string globalmap\" \"{}\" "
      "\"string causticmap\" \"{}\" {} Attribute \"photon\" \"string shadingmodel\" \"chrome\" "
      "Polygon \"P\" [-.3 .5 -.3 -.3 .6 .3 .3 .6 .3 .3 .5 -.3] "
      "Attribute \"photon\" \"string shadingmodel\" \"matte\" {} WorldEnd",
      file("g.gpm"), file("c.gpm"), floor(3), floor(9, 4)));
  EXPECT_EQ(messages_, "");
  const auto caustic = photons_in("c.gpm");
  ASSERT_GT(caustic.size(), 500u);
  for (const Photon& p : caustic)
    EXPECT_NEAR(p.P.y, 4, 1e-3);
  EXPECT_GT(photons_in("g.gpm").size(), caustic.size());
}

TEST_F(PhotonFrame, do_not_depend_on_threads) {
  const std::string world =
      "LightSource \"bulb\" 1 \"point from\" [.5 1 0] Attribute \"trace\" \"int maxdiffusedepth\" 3 "
      "Color .7 .6 .5 " +
      floor(2) + "Translate 0 .5 0 Sphere .3 -.3 .3 360";
  emit(world, 20000, 1);
  const auto one = slvm::read_file(file("a.gpm"));
  emit(world, 20000, 4);
  EXPECT_EQ(*one, *slvm::read_file(file("a.gpm")));
}

TEST_F(PhotonFrame, limits_of_lights_are_said) {
  emit("LightSource \"linear\" 1 \"point from\" [0 1 0] " + floor(2));
  EXPECT_THAT(messages_, HasSubstr("warning: light linear: its light does not fall off by the square of the "
                                   "distance, as that of photons does"));
  emit(floor(2));
  EXPECT_THAT(messages_, HasSubstr("no light sends photons into the scene: no photon map is made"));
  shaders_["soft"] = "light soft() { illuminate(point (random(), random(), random())) Cl = 1; }";
  emit("LightSource \"soft\" 1 " + floor(2));
  EXPECT_THAT(messages_,
              HasSubstr("light soft: it stands neither at a point nor far away: it sends no photons"));
  run("Hider \"photon\" WorldBegin LightSource \"bulb\" 1 Translate 0 -1 0 Sphere .5 -.5 .5 360 WorldEnd");
  EXPECT_THAT(messages_, HasSubstr("no photon was stored: surfaces need Attribute \"photon\" \"globalmap\""));
}

TEST_F(PhotonFrame, what_photons_do_not_see_is_not_there) {
  EXPECT_TRUE(
      emit("LightSource \"bulb\" 1 \"point from\" [0 1 0] Attribute \"visibility\" \"int photon\" 0 " +
           floor(2) + "Attribute \"visibility\" \"int photon\" 1 " + floor(2, -1))
          .size() > 1000);
  for (const Photon& p : photons_in("a.gpm"))
    EXPECT_NEAR(p.P.y, -1, 1e-3);
}

TEST_F(PhotonFrame, shaders_look_maps_up) {
  shaders_["front"] = "light front() { solar(vector \"world\" (0, 0, 1), 0) Cl = .5; }";
  emit("LightSource \"front\" 1 Color .4 .4 .4 Polygon \"P\" [-3 -3 1 -3 3 1 3 3 1 3 -3 1]", 100000);
  EXPECT_EQ(messages_, "");
  auto seen = [&](const std::string& type, const std::string& name) {
    return picture(fmt::format("Surface \"map\" \"string file\" \"{}\" \"string type\" \"{}\" "
                               "Polygon \"P\" [-1 -1 1 -1 1 1 1 1 1 1 -1 1]",
                               file(name), type));
  };
  EXPECT_NEAR(mean(seen("irradiance", "a.gpm"), 0), 0.5, 0.02);
  EXPECT_EQ(messages_, "");
  EXPECT_NEAR(mean(seen("radiance", "a.gpm"), 0), 0.2, 0.02);
  EXPECT_EQ(mean(seen("irradiance", "no.gpm"), 0), 0);
  EXPECT_THAT(messages_, HasSubstr("photonmap: there is no photon map '" + file("no.gpm") + "'"));
  seen("flux", "a.gpm");
  EXPECT_THAT(messages_,
              HasSubstr("photonmap: \"lookuptype\" is \"irradiance\" or \"radiance\", not \"flux\""));
}

TEST_F(PhotonFrame, diffuse_rays_take_light_from_maps) {
  // A wall at z = 2, lit from the front by photons; seen by a wall at z = 1 that looks at it.
  shaders_["front"] = "light front() { solar(vector \"world\" (0, 0, 1), 0) Cl = .5; }";
  run(fmt::format(
      "Hider \"photon\" \"int emit\" 100000 WorldBegin LightSource \"front\" 1 Attribute \"photon\" "
      "\"string globalmap\" \"{}\" Color 1 .5 .25 Polygon \"P\" [-9 -9 2 -9 9 2 9 9 2 9 -9 2] WorldEnd",
      file("w.gpm")));
  EXPECT_EQ(messages_, "");
  shaders_["back"] = "surface back() { Ci = indirectdiffuse(P, normal \"world\" (0, 0, 1), 256); Oi = 1; }";
  shaders_["green"] = "surface green() { printf(\"ran \"); Ci = color(0, 9, 0); Oi = 1; }";
  auto with = [&](const std::string& attribute) {
    return picture("Surface \"back\" Polygon \"P\" [-1 -1 1 -1 1 1 1 1 1 1 -1 1] Surface \"green\" Attribute "
                   "\"visibility\" "
                   "\"int diffuse\" 1 \"int camera\" 0 " +
                   attribute + " Polygon \"P\" [-9 -9 2 -9 9 2 9 9 2 9 -9 2]");
  };
  const auto photons = with("Attribute \"photon\" \"string globalmap\" \"" + file("w.gpm") + "\"");
  EXPECT_EQ(messages_, "");
  // Nearly all of the half space is the wall, lit as strongly everywhere.
  EXPECT_NEAR(mean(photons, 0), 0.5, 0.05);
  EXPECT_NEAR(mean(photons, 1), 0.25, 0.03);
  EXPECT_GT(mean(with(""), 1), 8);
  const auto without = with("Attribute \"photon\" \"string globalmap\" \"none.gpm\"");
  EXPECT_GT(mean(without, 1), 8);
  EXPECT_THAT(messages_,
              HasSubstr("there is no photon map 'none.gpm': a frame with Hider \"photon\" must write it "
                        "first; surface shaders run instead"));
}

} // namespace
} // namespace render
