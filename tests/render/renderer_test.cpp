// The whole chain: RIB with RSL shaders, compiled by slc, run by the virtual machine, rendered to pixels.
// Scenes have answers known by hand.
#include "tests/render/renderer_fixture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

namespace render {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::kMatte, testing::kShow;
using RendererTest = testing::RendererTest;

constexpr const char* kDistant = "light distant(float intensity = 1; point from = point \"shader\" (0,0,0), "
                                 "to = point \"shader\" (0,0,1)) { solar(to - from, 0) Cl = intensity; }";
/// A disk over the whole image at z = 5 in an orthographic camera.
const std::string kSheet = " Translate 0 0 5 Disk 0 9 360 ";

TEST_F(RendererTest, parameters_reach_the_shader) {
  shaders_["show"] = kShow;
  EXPECT_EQ(
      render("WorldBegin Color .5 .5 .5 Surface \"show\" \"k\" .5 \"tint\" [1 .5 .25]" + kSheet + "WorldEnd"),
      "");
  EXPECT_FLOAT_EQ(value(3, 3, 0), 0.25f);
  EXPECT_FLOAT_EQ(value(3, 3, 1), 0.125f);
  EXPECT_FLOAT_EQ(value(3, 3, 2), 0.0625f);
  EXPECT_FLOAT_EQ(value(3, 3, 3), 1);
}

TEST_F(RendererTest, a_text_reaches_a_string_parameter_whose_name_is_predeclared_otherwise) {
  shaders_["named"] =
      "surface named(string background = \"\") { Ci = background == \"b.tif\" ? 1 : 0; Oi = 1; }";
  EXPECT_EQ(render("WorldBegin Surface \"named\" \"background\" \"b.tif\"" + kSheet + "WorldEnd"), "");
  EXPECT_EQ(value(8, 8, 0), 1);
}

TEST_F(RendererTest, primitive_variables_override_parameters) {
  shaders_["show"] = "surface show(varying float k = 1) { Ci = k; Oi = 1; }";
  EXPECT_EQ(
      render(
          "WorldBegin Surface \"show\" \"k\" .5 Translate 0 0 5 Polygon \"P\" [-2 -2 0 2 -2 0 2 2 0 -2 2 0] "
          "\"varying float k\" [0 4 4 0] WorldEnd"),
      "");
  EXPECT_NEAR(value(8, 8, 0), 2, 0.1f); // k is x + 2
  EXPECT_NEAR(value(12, 8, 0), 2.5, 0.1f);
}

TEST_F(RendererTest, a_display_of_a_variable_that_nobody_has_is_told) {
  shaders_["show"] = kShow;
  const std::string scene = "WorldBegin Surface \"show\" \"k\" .5" + kSheet + "WorldEnd";
  EXPECT_EQ(render(scene, "varying color nosuch"),
            "warning: no surface in the picture has a variable \"nosuch\"; its channels are 0 [-Wdisplay]\n");
  EXPECT_EQ(render(scene, "varying normal N"), "");
  EXPECT_EQ(render("WorldBegin WorldEnd", "varying color nosuch"), ""); // nothing that could have it
}

TEST_F(RendererTest, one_distant_light_on_a_tilted_plane) {
  shaders_["matte"] = kMatte;
  shaders_["distant"] = kDistant;
  EXPECT_EQ(render("WorldBegin LightSource \"distant\" 1 \"from\" [0 0 0] \"to\" [0 0 1] \"intensity\" 2 "
                   "Surface \"matte\" \"Kd\" .5 Translate 0 0 5 Rotate 60 0 1 0 Disk 0 9 360 WorldEnd"),
            "");
  EXPECT_NEAR(value(8, 8, 0), 0.5f, 1e-4f); // Kd * intensity * cos 60
}

TEST_F(RendererTest, lights_stand_in_the_space_of_their_request_and_shine_where_they_are_on) {
  shaders_["matte"] = kMatte;
  shaders_["distant"] = kDistant;
  // The light looks along its own z, which the rotation turns to the world's x.
  EXPECT_EQ(
      render(
          "WorldBegin AttributeBegin Rotate 90 0 1 0 LightSource \"distant\" 1 AttributeEnd Illuminate 1 1 "
          "Surface \"matte\" Translate 0 0 5 Rotate 45 0 1 0 Disk 0 9 360 WorldEnd"),
      "");
  EXPECT_NEAR(value(8, 8, 0), std::sqrt(0.5f), 1e-4f);
  EXPECT_EQ(
      render("WorldBegin LightSource \"distant\" 1 Illuminate 1 0 Surface \"matte\"" + kSheet + "WorldEnd"),
      "");
  EXPECT_EQ(value(8, 8, 0), 0);
}

TEST_F(RendererTest, spaces_of_shaders) {
  shaders_["where"] = "surface where(string space = \"world\") { Ci = color(transform(space, P)); Oi = 1; }";
  auto at = [&](const std::string& space) {
    EXPECT_EQ(render("Translate 0 0 3 WorldBegin Translate 0 0 1 CoordinateSystem \"here\" Translate 0 0 1 "
                     "Surface \"where\" \"space\" \"" +
                     space + "\" Translate 0 0 1 Disk 0 9 360 WorldEnd"),
              "");
    return std::array{value(12, 4, 0), value(12, 4, 1), value(12, 4, 2)};
  };
  // The centre of pixel (12, 4) lies at x = 12.5 / 8 - 1, y = 1 - 4.5 / 8.
  const float x = 0.5625f, y = 0.4375f;
  auto expect = [&](const std::string& space, float ex, float ey, float ez) {
    SCOPED_TRACE(space);
    auto p = at(space);
    EXPECT_NEAR(p[0], ex, 0.1f * std::max(1.0f, std::abs(ex) / 2));
    EXPECT_NEAR(p[1], ey, 0.1f * std::max(1.0f, std::abs(ey) / 2));
    EXPECT_NEAR(p[2], ez, 1e-4f);
  };
  expect("camera", x, y, 6);
  expect("current", x, y, 6);
  expect("world", x, y, 3);
  expect("here", x, y, 2);
  expect("shader", x, y, 1);
  expect("object", x, y, 0);
  expect("NDC", 12.5f / 16, 4.5f / 16, at("NDC")[2]);
  expect("raster", 12.5f, 4.5f, at("raster")[2]);
}

TEST_F(RendererTest, displacement_moves_the_silhouette_and_the_normals) {
  shaders_["swell"] =
      "displacement swell(float by = 0.5) { P += by * normalize(N); N = calculatenormal(P); }";
  shaders_["show"] = kShow;
  EXPECT_EQ(
      render(
          "PixelSamples 8 8 WorldBegin Translate 0 0 5 Surface \"show\" Displacement \"swell\" "
          "Attribute \"displacementbound\" \"sphere\" .5 ShadingRate .05 Sphere .25 -.25 .25 360 WorldEnd"),
      "");
  double area = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      area += value(x, y, 3);
  EXPECT_NEAR(area, M_PI * 36, 1.0); // radius 0.75 is 6 pixels
}

TEST_F(RendererTest, orientation_reaches_calculatenormal) {
  shaders_["facing"] = "surface facing() { normal n = normalize(calculatenormal(P)); "
                       "Ci = color(n . normalize(N), zcomp(n), 0); Oi = 1; }";
  for (const char* how : {"", "ReverseOrientation", "Scale -1 1 1", "Orientation \"rh\" Scale 1 -1 1"}) {
    SCOPED_TRACE(how);
    EXPECT_EQ(render(fmt::format("WorldBegin Surface \"facing\" {}{} WorldEnd", how, kSheet)), "");
    EXPECT_NEAR(value(8, 8, 0), 1, 1e-4f);
  }
}

TEST_F(RendererTest, output_variables_become_channels) {
  shaders_["aov"] = "surface aov(output varying float heat = 0; output varying color inner = 0) "
                    "{ heat = 10 * u; inner = color(1, 2, 3); Ci = 0; Oi = 1; }";
  std::string scene = "WorldBegin Surface \"aov\" Translate 0 0 5 "
                      "Patch \"bilinear\" \"P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0] WorldEnd";
  EXPECT_EQ(render(scene, "varying float heat"), "");
  EXPECT_NEAR(value(8, 8, 0), 5.3f, 0.35f);
  EXPECT_EQ(render(scene, "varying color inner"), "");
  EXPECT_FLOAT_EQ(value(4, 4, 2), 3);
}

TEST_F(RendererTest, atmosphere_and_imager) {
  shaders_["show"] = kShow;
  shaders_["dim"] = "volume dim() { Ci = 0.5 * Ci; }";
  shaders_["backdrop"] = "imager backdrop(color c = 1) { Ci += (1 - alpha) * c; Oi = 1; alpha = 1; }";
  EXPECT_EQ(render("Imager \"backdrop\" \"c\" [.1 .2 .3] WorldBegin Surface \"show\" Atmosphere \"dim\" "
                   "Translate -2 0 5 Disk 0 2 360 WorldEnd"),
            "");
  EXPECT_FLOAT_EQ(value(2, 8, 0), 0.5f);
  EXPECT_FLOAT_EQ(value(14, 8, 1), 0.2f);
  EXPECT_FLOAT_EQ(value(14, 8, 3), 1);
}

TEST_F(RendererTest, the_background_takes_its_colour_by_two_names) {
  shaders_["background"] = "imager background(color bgcolor = 1) { Ci += (1 - alpha) * bgcolor; }";
  for (const char* name : {"bgcolor", "color"}) {
    EXPECT_EQ(render(fmt::format("Imager \"background\" \"{}\" [.5 .25 0] WorldBegin WorldEnd", name)), "");
    EXPECT_EQ(value(3, 3, 0), 0.5f) << name;
    EXPECT_EQ(value(3, 3, 1), 0.25f) << name;
  }
}

TEST_F(RendererTest, attributes_and_options_can_be_asked_for) {
  shaders_["ask"] =
      "surface ask() { float sides = 0, heat = 0, format[3] = {0,0,0}; string pass = \"\"; "
      "attribute(\"Sides\", sides); attribute(\"user:heat\", heat); option(\"Format\", format); "
      "option(\"user:pass\", pass); Ci = color(sides, heat, format[0]); "
      "if (pass == \"beauty\") Ci *= 2; Oi = 1; }";
  EXPECT_EQ(
      render(
          "Option \"user\" \"string pass\" \"beauty\" WorldBegin Surface \"ask\" Sides 1 ReverseOrientation "
          "Attribute \"user\" \"float heat\" 7" +
          kSheet + "WorldEnd"),
      "");
  EXPECT_EQ(value(8, 8, 0), 2);
  EXPECT_EQ(value(8, 8, 1), 14);
  EXPECT_EQ(value(8, 8, 2), 32);
}

TEST_F(RendererTest, printf_goes_to_the_program) {
  shaders_["talk"] = "surface talk() { uniform float x = 3; printf(\"x is %f\\n\", x); Ci = 1; Oi = 1; }";
  EXPECT_EQ(render("ShadingRate 400 WorldBegin Surface \"talk\"" + kSheet + "WorldEnd"), "");
  EXPECT_THAT(printed_, HasSubstr("x is 3"));
}

TEST_F(RendererTest, messages_about_shaders_stand_at_their_request) {
  shaders_["show"] = kShow;
  shaders_["distant"] = kDistant;
  auto surface = [&](const std::string& request) {
    return render("WorldBegin\n" + request + kSheet + "WorldEnd");
  };
  EXPECT_THAT(
      surface("Surface \"shwo\""),
      HasSubstr("scene.rib:5:1: warning: Surface: no shader \"shwo\" in the search path \".\"; the default "
                "surface is drawn instead"));
  EXPECT_GT(value(8, 8, 0), 0.9f); // the default surface
  EXPECT_THAT(surface("Surface \"distant\""),
              HasSubstr("error: Surface: \"distant\" is a light shader, not a surface shader"));
  EXPECT_THAT(
      surface("Surface \"show\" \"tnit\" [1 0 0]"),
      HasSubstr("warning: Surface: shader \"show\" has no parameter \"tnit\"; did you mean \"tint\"?"));
  EXPECT_THAT(surface("Surface \"show\" \"tint\" [1 0]"),
              HasSubstr("error: Surface: parameter \"tint\" of shader \"show\" takes 3 numbers, found 2"));
  EXPECT_THAT(surface("Surface \"show\" \"k\" \"x\""),
              HasSubstr("error: Surface: parameter \"k\" of shader \"show\" takes 1 number, found 0"));
}

TEST_F(RendererTest, colours_that_are_not_numbers_are_reported_and_drawn_black) {
  shaders_["nan"] = "surface nan(float zero = 0) { Ci = zero / zero; Oi = 1; }";
  EXPECT_THAT(render("WorldBegin Surface \"nan\"" + kSheet + "WorldEnd"),
              HasSubstr("shading points have a colour that is not a finite number; they are drawn black"));
  EXPECT_EQ(value(8, 8, 0), 0);
  EXPECT_EQ(value(8, 8, 3), 1);
}

TEST_F(RendererTest, an_imager_inside_the_world_is_that_of_the_frame) {
  shaders_["background"] = "imager background(color bgcolor = 1) { Ci += (1 - alpha) * bgcolor; }";
  const std::string world = "WorldBegin Imager \"background\" \"color\" [.5 .25 0] WorldEnd ";
  EXPECT_THAT(render(world),
              HasSubstr("warning: Imager: it is an option and holds for the whole frame: it belongs "
                        "before WorldBegin"));
  EXPECT_EQ(value(8, 8, 0), 0.5f);
  EXPECT_EQ(value(8, 8, 1), 0.25f);
  render(world + "WorldBegin WorldEnd"); // and of no other frame
  EXPECT_EQ(value(8, 8, 0), 0);
}

TEST_F(RendererTest, a_surface_that_only_sets_oi_to_zero_makes_a_hole) {
  shaders_["ring"] = "surface ring() { if (u < .5) Oi = 0; else Ci = Cs; }";
  shaders_["glow"] = "surface glow() { Ci = .25; Oi = 0; }";
  shaders_["show"] = kShow;
  const std::string sheet = "Patch \"bilinear\" \"P\" [-1 1 5 1 1 5 -1 -1 5 1 -1 5] ";
  const std::string behind = "Color 0 0 1 Surface \"show\" Translate 0 0 9 Disk 0 20 360 WorldEnd";
  EXPECT_EQ(render("WorldBegin Color 0 1 0 Surface \"ring\" " + sheet + behind), "");
  EXPECT_EQ(value(3, 8, 1), 0); // through the hole
  EXPECT_EQ(value(3, 8, 2), 1);
  EXPECT_EQ(value(12, 8, 1), 1);
  EXPECT_EQ(value(12, 8, 2), 0);
  EXPECT_EQ(render("WorldBegin Color 0 1 0 Surface \"glow\" " + sheet + behind), "");
  EXPECT_EQ(value(8, 8, 1), 0.25f); // light that is added
  EXPECT_EQ(value(8, 8, 2), 1.25f);
}

TEST_F(RendererTest, textures_are_found_on_their_search_path) {
  shaders_["paint"] =
      "surface paint(string map = \"\") { Ci = color texture(map, 0.5, 0.375, \"width\", 0); Oi = 1; }";
  std::string scene = "WorldBegin Surface \"paint\" \"map\" \"ramp.exr\"" + kSheet + "WorldEnd";
  EXPECT_EQ(render("Option \"searchpath\" \"texture\" [\"" TEXTURE_FOLDER "\"]\n" + scene), "");
  EXPECT_NEAR(value(3, 3, 0), 0.5f, 1e-3f);
  EXPECT_NEAR(value(3, 3, 1), 0.375f, 1e-3f);
  EXPECT_THAT(render(scene), HasSubstr("texture \"ramp.exr\""));
  EXPECT_EQ(value(3, 3, 0), 0);
}

TEST_F(RendererTest, lookups_at_places_that_are_not_numbers_are_black) {
  shaders_["nowhere"] = "surface nowhere(string map = \"\"; float zero = 0) {"
                        "  vector R = (zero / zero, 1, 0); Oi = 1;"
                        "  Ci = color texture(map, xcomp(R), t, \"blur\", .1) + color environment(map, R, "
                        "\"blur\", .1) + .25; }";
  EXPECT_EQ(render("Option \"searchpath\" \"texture\" [\"" TEXTURE_FOLDER "\"]\n"
                   "WorldBegin Surface \"nowhere\" \"map\" \"ramp.exr\"" +
                   kSheet + "WorldEnd"),
            "");
  EXPECT_EQ(value(8, 8, 0), 0.25f);
}

TEST_F(RendererTest, what_changes_along_one_line_only_can_be_blurred) {
  shaders_["line"] = "surface line(string map = \"\";) {"
                     "  Ci = (color texture(map, s * t, s * t, \"blur\", .1) + color environment(map, "
                     "vector(s, .1, 1), \"blur\", .1)"
                     "     + color environment(map, vector(s - .5, t - .5, 0), \"blur\", .1)) / 3; Oi = 1; }";
  EXPECT_EQ(render("Option \"searchpath\" \"texture\" [\"" TEXTURE_FOLDER "\"]\n"
                   "WorldBegin Surface \"line\" \"map\" \"ramp.exr\"" +
                   kSheet + "WorldEnd"),
            "");
  EXPECT_GT(value(8, 8, 0), 0.1f);
}

TEST_F(RendererTest, shaders_know_time_and_motion) {
  shaders_["when"] = "surface when() { Ci = color(time, dtime, xcomp(dPdtime)); Oi = 1; }";
  EXPECT_EQ(
      render(
          "Shutter 1 1.5 Option \"shutter\" \"float offset\" 10 PixelSamples 4 4 WorldBegin Surface \"when\" "
          "MotionBegin [1 1.5] Translate 0 0 0 Translate .25 0 0 MotionEnd" +
          kSheet + "WorldEnd"),
      "");
  EXPECT_FLOAT_EQ(value(8, 8, 0), 11);
  EXPECT_FLOAT_EQ(value(8, 8, 1), 0.5f);
  EXPECT_NEAR(value(8, 8, 2), 0.5f, 1e-4f);
}

// A picture of depths is a shadow map: what the disk hid from its camera is in shadow, seen from anywhere.
TEST_F(RendererTest, depth_pictures_are_shadow_maps) {
  std::string map = path("depth.exr");
  EXPECT_EQ(render("Display \"" + map +
                   "\" \"openexr\" \"z\" PixelSamples 1 1\nWorldBegin Translate 0 0 2 "
                   "Disk 0 0.5 360 WorldEnd"),
            "");
  shaders_["dark"] = "surface dark(string map = \"\") { Ci = 1 - shadow(map, P, \"width\", 0); Oi = 1; }";
  EXPECT_EQ(render("WorldBegin Surface \"dark\" \"map\" \"" + map + "\"" + kSheet + "WorldEnd"), "");
  EXPECT_EQ(value(8, 8, 0), 0);
  EXPECT_EQ(value(1, 8, 0), 1);
  EXPECT_EQ(value(8, 14, 0), 1);
  EXPECT_EQ(value(9, 6, 0), 0); // within 4 pixels of the middle
}

} // namespace
} // namespace render
