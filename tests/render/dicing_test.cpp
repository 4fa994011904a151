// What makes micropolygons coarser or finer besides ShadingRate: Attribute "dice", GeometricApproximation;
// and other attributes and hider parameters that change how surfaces are cut and hidden.
#include "tests/render/render_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

size_t micropolygons(const std::string& rib) {
  Rendered r = render_text(rib);
  EXPECT_EQ(r.messages, "");
  return r.report.micropolygons;
}

/// 64 pixels a unit in an orthographic camera.
std::string frame(const std::string& world, const std::string& options = "") {
  return "Format 128 128 1 PixelSamples 1 1 " + options + " WorldBegin Translate 0 0 5 " + world +
         " WorldEnd";
}

const std::string kSquare = " Patch \"bilinear\" \"P\" [-.5 -.5 0 .5 -.5 0 -.5 .5 0 .5 .5 0] ";

TEST(Dicing, without_raster_orientation_a_tilted_surface_is_as_fine_as_a_facing_one) {
  std::string tilted = "Rotate 80 0 1 0" + kSquare,
              not_oriented = "Attribute \"dice\" \"int rasterorient\" 0 ";
  double facing = 64 * 64;
  EXPECT_NEAR(static_cast<double>(micropolygons(frame(kSquare))), facing, 0.1 * facing);
  EXPECT_NEAR(static_cast<double>(micropolygons(frame(tilted))), facing * std::cos(80 * M_PI / 180),
              0.1 * facing);
  EXPECT_NEAR(static_cast<double>(micropolygons(frame(not_oriented + tilted))), facing, 0.1 * facing);
  // Nothing changes for what faces the eye, also in perspective.
  std::string camera = "Projection \"perspective\" \"fov\" 40 ";
  EXPECT_EQ(micropolygons(frame(not_oriented + kSquare, camera)), micropolygons(frame(kSquare, camera)));
}

TEST(Dicing, binary_grids_have_powers_of_two) {
  // 45 pixels wide: 16-gon grids of any number, or 2^n.
  std::string square = " Scale .7 .7 1" + kSquare;
  size_t plain = micropolygons(frame(square));
  size_t binary = micropolygons(frame("Attribute \"dice\" \"int binary\" 1" + square));
  EXPECT_NE(plain, binary);
  EXPECT_EQ(binary & (binary - 1), 0u) << binary; // all grids alike, and 2^n of them
}

TEST(Dicing, hair_is_one_micropolygon_wide) {
  std::string curve = " Curves \"cubic\" [4] \"nonperiodic\" \"P\" [-.5 -.5 0 -.2 0 0 .2 0 0 .5 .5 0] "
                      "\"constantwidth\" [.25] ";
  size_t plain = micropolygons(frame(curve));
  size_t hair = micropolygons(frame("Attribute \"dice\" \"int hair\" 1" + curve));
  EXPECT_EQ(plain, 16 * hair); // 16 pixels across
}

TEST(Dicing, micropolygons_have_a_least_side) {
  double n = static_cast<double>(micropolygons(frame("Attribute \"dice\" \"float minlength\" 4" + kSquare)));
  EXPECT_NEAR(n, 16 * 16, 40);
  EXPECT_EQ(micropolygons(frame("Attribute \"dice\" \"float minlength\" .5" + kSquare)),
            micropolygons(frame(kSquare)));
}

TEST(Dicing, what_moves_is_coarser) {
  auto moving = [](const std::string& by, const std::string& factor) {
    return micropolygons(
        frame(factor + " MotionBegin [0 1] Translate 0 0 0 Translate " + by + " 0 0 MotionEnd" + kSquare,
              "Shutter 0 1"));
  };
  double still = static_cast<double>(micropolygons(frame(kSquare)));
  EXPECT_EQ(moving(".4", ""), static_cast<size_t>(still)); // 26 pixels: not twice as coarse
  EXPECT_NEAR(static_cast<double>(moving("1.1", "")), still / 4, still / 16); // 70 pixels
  EXPECT_EQ(moving("1.1", "GeometricApproximation \"motionfactor\" 0"), static_cast<size_t>(still));
  EXPECT_NEAR(static_cast<double>(moving("1.1", "GeometricApproximation \"motionfactor\" 2")), still / 8,
              still / 32);
}

TEST(Dicing, what_is_out_of_focus_is_coarser) {
  auto blurred = [](const std::string& factor, const std::string& z) {
    return static_cast<double>(
        micropolygons("Format 128 128 1 PixelSamples 1 1 Projection \"perspective\" \"fov\" 90 "
                      "DepthOfField 1 2 2 WorldBegin " +
                      factor + " Translate 0 0 " + z + kSquare + " WorldEnd"));
  };
  // A lens of radius 1: at depth 1, a point moves 64 (1/2 - 1/1) = 32 pixels to each side, 64 in all.
  double sharp = blurred("GeometricApproximation \"focusfactor\" 0", "1");
  EXPECT_NEAR(blurred("", "1"), sharp / 4, sharp / 16);
  EXPECT_EQ(blurred("", "2"), blurred("GeometricApproximation \"focusfactor\" 0", "2")); // in focus
}

TEST(Dicing, grids_need_not_be_stitched) {
  std::string sphere = frame("Rotate 30 1 1 0 Sphere 1 -1 1 360");
  std::string loose = frame("Attribute \"stitch\" \"int enable\" 0 Rotate 30 1 1 0 Sphere 1 -1 1 360");
  EXPECT_NE(render_text(sphere).image.data, render_text(loose).image.data);
}

TEST(Dicing, one_sided_surfaces_may_face_away_a_little) {
  // A disk's outside faces away from the eye when it is turned by less than 90 degrees.
  auto covered = [](const std::string& tolerance) {
    return render_text(frame("Sides 1 " + tolerance + " Rotate 85 0 1 0 Disk 0 .9 360", "PixelSamples 4 4"))
        .covered();
  };
  EXPECT_EQ(covered(""), 0);
  EXPECT_EQ(covered("Attribute \"sides\" \"float backfacetolerance\" 4"), 0);
  double disk = M_PI * 57.6 * 57.6 * std::cos(85 * M_PI / 180);
  EXPECT_NEAR(covered("Attribute \"sides\" \"float backfacetolerance\" 6"), disk, 0.03 * disk);
}

TEST(Dicing, motion_that_is_not_sampled_is_still_known) {
  FrameSettings s;
  s.aovs = {{"dPdtime", 3, 0, AovChannel::Source::kVariable, {}, {1, 1}}};
  auto at = [&](const std::string& hider, int x) {
    Rendered r = render_text("Format 32 32 1 PixelFilter \"box\" 1 1 PixelSamples 4 4 Shutter 0 1 " + hider +
                                 "WorldBegin MotionBegin [0 1] Translate -1 0 5 Translate 0 0 5 MotionEnd "
                                 "Polygon \"P\" [0 -1 0 .5 -1 0 .5 1 0 0 1 0] WorldEnd",
                             s);
    EXPECT_EQ(r.messages, "");
    return std::pair(r.alpha(x, 16), r.image.at(Image::kAov, x, 16));
  };
  EXPECT_NEAR(at("", 4).first, 0.3, 0.1); // smeared
  auto [alpha, motion] = at("Hider \"hidden\" \"int samplemotion\" 0 ", 4);
  EXPECT_EQ(alpha, 1); // x from -1 to -.5 is pixels 0 to 8
  EXPECT_NEAR(motion, 1, 1e-4f);
  EXPECT_EQ(at("Hider \"hidden\" \"int samplemotion\" 0 ", 10).first, 0);
}

} // namespace
} // namespace render::testing
