// Light through layers.
#include "tests/render/rays/ray_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

std::string layers(int count, const std::string& what) {
  std::string rib = "WorldBegin " + what;
  for (int i = 0; i < count; ++i)
    rib += " Translate 0 0 .01 Polygon \"P\" [-2 -2 0 2 -2 0 2 2 0 -2 2 0]";
  return rib + " WorldEnd";
}
const std::map<std::string, std::string> kShaders = {
    {"film", "surface film() { Oi = Os; Ci = Cs * Oi; }"},
    {"glass", "surface glass() { Oi = 1 - color(1, .5, .25); Ci = 0; }"},
    {"left", "surface left() { Oi = s < 0 ? 1 : 0; Ci = 0; }"}};

void expect_near(Color a, Color b, float tolerance = 1e-5f) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

TEST(Transmission, n_layers_of_opacity_o) {
  for (int n : {0, 1, 2, 5, 100})
    for (const char* mode : {"Os", "shader"}) {
      SCOPED_TRACE(mode);
      RayScene s(
          layers(n, std::string(
                        "Surface \"film\" Opacity .02 .1 .3 Attribute \"visibility\" \"transmission\" \"") +
                        mode + "\""),
          kShaders);
      EXPECT_EQ(s.messages(), "");
      auto n_times = [&](float o) { return std::pow(1 - o, static_cast<float>(n)); };
      expect_near(s.transmission({0.1f, 0.2f, -1}, {0.1f, 0.2f, 9}),
                  {n_times(.02f), n_times(.1f), n_times(.3f)});
    }
}

TEST(Transmission, opaque_and_transparent_need_no_shader) {
  RayScene opaque(layers(3, "Surface \"glass\" Attribute \"visibility\" \"transmission\" \"opaque\""),
                  kShaders);
  expect_near(opaque.transmission({0, 0.1f, -1}, {0, 0.1f, 9}), Color(0.0f));
  EXPECT_EQ(opaque.tracer().usage().hit_grids, 0u);
  expect_near(opaque.transmission({5, 5, -1}, {5, 5, 9}), Color(1.0f));
  RayScene clear(layers(3, "Surface \"glass\" Attribute \"visibility\" \"transmission\" \"transparent\""),
                 kShaders);
  expect_near(clear.transmission({0, 0.1f, -1}, {0, 0.1f, 9}), Color(1.0f));
}

TEST(Transmission, coloured_glass_in_front_of_a_wall) {
  std::string rib =
      "WorldBegin Attribute \"visibility\" \"transmission\" \"shader\" Surface \"glass\" Translate 0 0 1 "
      "Polygon \"P\" [-2 -2 0 2 -2 0 2 2 0 -2 2 0] Translate 0 0 1 Polygon \"P\" [-2 -2 0 2 -2 0 2 2 0 -2 2 "
      "0] "
      "Attribute \"visibility\" \"transmission\" \"opaque\" Translate 0 0 3 Disk 0 1 360 WorldEnd";
  RayScene s(rib, kShaders);
  expect_near(s.transmission({0, .1f, 0}, {0, .1f, 4}), {1, .25f, .0625f});
  expect_near(s.transmission({0, .1f, 4}, {0, .1f, 0}), {1, .25f, .0625f});
  expect_near(s.transmission({0, .1f, 0}, {0, .1f, 6}), Color(0.0f));
  expect_near(s.transmission({0, .1f, 1.5f}, {0, .1f, 1.9f}), Color(1.0f));
}

TEST(Transmission, opacity_may_vary) {
  RayScene s(layers(1, "Surface \"left\" Attribute \"visibility\" \"transmission\" \"shader\""), kShaders);
  expect_near(s.transmission({-1, 0.1f, -1}, {-1, 0.1f, 1}), Color(0.0f));
  expect_near(s.transmission({1, 0.1f, -1}, {1, 0.1f, 1}), Color(1.0f));
  RayScene var("WorldBegin Attribute \"visibility\" \"transmission\" \"Os\" Polygon \"P\" [-1 -1 0 1 -1 0 1 "
               "1 0 -1 1 0] "
               "\"varying color Os\" [0 0 0 1 1 1 1 1 1 0 0 0] WorldEnd");
  expect_near(var.transmission({0.5f, 0, -1}, {0.5f, 0, 1}), Color(0.25f));
}

TEST(Transmission, hit_modes) {
  RayScene s(layers(1, "Surface \"glass\" Opacity .5 .5 .5 Attribute \"visibility\" \"int transmission\" 1"),
             kShaders);
  slvm::RayOptions o;
  expect_near(s.transmission({0, .1f, -1}, {0, .1f, 1}, o), {1, .5f, .25f});
  o.mode = slvm::HitMode::kPrimitive;
  expect_near(s.transmission({0, .1f, -1}, {0, .1f, 1}, o), Color(.5f));
  RayScene plain(layers(1,
                        "Surface \"glass\" Opacity .5 .5 .5 Attribute \"visibility\" \"int transmission\" 1 "
                        "Attribute \"shade\" \"string transmissionhitmode\" \"primitive\""),
                 kShaders);
  expect_near(plain.transmission({0, .1f, -1}, {0, .1f, 1}), Color(.5f));
}

TEST(Transmission, an_edge_between_faces_is_one_layer) {
  // The middle of a disk and the corners inside a mesh belong to several faces.
  RayScene s("WorldBegin Opacity .5 .5 .5 Attribute \"visibility\" \"transmission\" \"Os\" "
             "PatchMesh \"bilinear\" 3 \"nonperiodic\" 3 \"nonperiodic\" \"P\" [-1 -1 0 0 -1 0 1 -1 0 -1 0 0 "
             "0 0 0 1 0 0 "
             "-1 1 0 0 1 0 1 1 0] WorldEnd");
  expect_near(s.transmission({0, 0, -1}, {0, 0, 1}), Color(.5f));
  expect_near(s.transmission({0, .5f, -1}, {0, .5f, 1}), Color(.5f));
  // Faces are two triangles to a ray.
  RayScene diagonals(layers(3, "Opacity .5 .5 .5 Attribute \"visibility\" \"transmission\" \"Os\""));
  expect_near(diagonals.transmission({0, 0, -1}, {0, 0, 1}), Color(.125f));
  expect_near(diagonals.transmission({1, 1, -1}, {1, 1, 1}), Color(.125f));
  expect_near(diagonals.transmission({1, -1, -1}, {1, -1, 1}), Color(.125f));
}

TEST(Transmission, too_many_layers_end) {
  RayScene s(layers(700, "Opacity .001 .001 .001 Attribute \"visibility\" \"transmission\" \"Os\""),
             kShaders);
  expect_near(s.transmission({0, .1f, -1}, {0, .1f, 9}), Color(std::pow(.999f, 700.0f)), 1e-4f);
}

// Shadow rays that hit lit surfaces would shoot as many from each, and so on.
TEST(Transmission, opacities_need_no_lights) {
  const std::map<std::string, std::string> shaders = {
      {"lit", "surface lit() { Oi = Os; Ci = Oi * diffuse(N); }"},
      {"dim", "surface dim() { color c = diffuse(N); Oi = Os * step(-1, comp(c, 0)); Ci = Oi * c; }"},
      {"lamp", "light lamp() { illuminate(point(0, 0, -9)) Cl = transmission(Ps, point(0, 0, -9), "
               "\"samples\", 16, \"samplecone\", .1); }"}};
  auto shot = [&](const std::string& shader) {
    RayScene s(layers(3, "LightSource \"lamp\" 1 Surface \"" + shader +
                             "\" Opacity .5 .5 .5 Attribute \"visibility\" \"transmission\" \"shader\""),
               shaders);
    expect_near(s.transmission({0, 0.1f, -1}, {0, 0.1f, 9}), Color(.125f));
    EXPECT_EQ(s.messages(), "");
    return s.tracer().usage().shadow_rays;
  };
  EXPECT_EQ(shot("lit"), 1u);
  EXPECT_EQ(shot("dim"), 1u); // the lamp shines through everything there
}

} // namespace
} // namespace render::testing
