// Whole frames with known answers: areas, depths, watertight surfaces, clipping, crop windows, threads.
#include "tests/render/render_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

const std::string kPlain = "PixelFilter \"box\" 1 1 PixelSamples 8 8 ";

TEST(Frame, a_disk_covers_its_area) {
  // Orthographic, 64 pixels for 2 units: radius 0.75 is 24 pixels.
  Rendered r = render_text("Format 64 64 1 " + kPlain + "WorldBegin Translate 0 0 5 Disk 0 .75 360 WorldEnd");
  EXPECT_NEAR(r.covered(), M_PI * 24 * 24, 0.003 * M_PI * 24 * 24);
  EXPECT_EQ(r.alpha(32, 32), 1);
  EXPECT_EQ(r.alpha(2, 2), 0);
  EXPECT_FLOAT_EQ(r.z(32, 32), 5);
  EXPECT_EQ(r.z(1, 1), Image::kEmptyDepth);
}

TEST(Frame, a_sphere_in_perspective_covers_its_silhouette) {
  // Distance 4, radius 1: the silhouette's radius on the plane z = 1 is tan(asin(1/4)) = 1 / sqrt(15).
  Rendered r = render_text("Format 80 80 1 Projection \"perspective\" \"fov\" 60 " + kPlain +
                           "Translate 0 0 4 WorldBegin Sphere 1 -1 1 360 WorldEnd");
  double radius = 40 / std::sqrt(15.0) / std::tan(M_PI / 6);
  EXPECT_NEAR(r.covered(), M_PI * radius * radius, 0.006 * M_PI * radius * radius);
  EXPECT_NEAR(r.z(40, 40), 3, 0.002f);
}

TEST(Frame, every_quadric_and_patch_is_watertight) {
  // Each fills the middle of the image; a crack between grids would let a sample through.
  const char* kShapes[] = {
      "Sphere 1 -1 1 360",
      "Rotate 33 1 1 0 Torus 1 1.2 0 360 360",
      "Rotate 90 1 0 0 Cylinder 1 -2 2 360",
      "Rotate 70 1 0 0 Translate 0 0 -1.5 Paraboloid 1.5 0 3 360",
      "Polygon \"P\" [-2 -2 -1  -2 3 .5  2 3 .5  3 0 0  2 -2 -1]",
      "Patch \"bicubic\" \"P\" [-3 -3 0 -1 -3 2 1 -3 -2 3 -3 0  -3 -1 2 -1 -1 3 1 -1 0 3 -1 2 "
      " -3 1 0 -1 1 -3 1 1 3 3 1 0  -3 3 0 -1 3 2 1 3 -2 3 3 0]",
      "Patch \"bilinear\" \"P\" [-2 -2 0 2 -2 1 -2 2 -1 2 2 2]",
  };
  for (const char* shape : kShapes) {
    SCOPED_TRACE(shape);
    Rendered r =
        render_text("Format 120 120 1 PixelSamples 4 4 PixelFilter \"box\" 1 1 Projection \"perspective\" "
                    "\"fov\" 16 Translate 0 0 6 Rotate 10 1 2 3 WorldBegin " +
                    std::string(shape) + " WorldEnd");
    int holes = 0;
    for (int y = 40; y < 80; ++y)
      for (int x = 40; x < 80; ++x)
        holes += r.alpha(x, y) < 1;
    EXPECT_EQ(holes, 0);
  }
}

TEST(Frame, half_transparent_surfaces_show_no_seams) {
  Rendered r =
      render_text("Format 120 120 1 PixelSamples 4 4 Projection \"perspective\" \"fov\" 20 Translate 0 0 6 "
                  "WorldBegin Opacity .5 .5 .5 Rotate 20 1 2 3 Rotate 90 1 0 0 Cylinder 1 -2 2 180 WorldEnd");
  for (int y = 50; y < 70; ++y)
    for (int x = 50; x < 70; ++x)
      EXPECT_NEAR(r.alpha(x, y), 0.5f, 1e-5f) << x << " " << y;
}

TEST(Frame, one_sided_surfaces_hide_their_back) {
  std::string frame = "Format 20 20 1 PixelFilter \"box\" 1 1 WorldBegin Sides 1 Translate 0 0 5 ";
  // A disk's outside faces +z, away from the eye.
  EXPECT_EQ(render_text(frame + "Disk 0 1 360 WorldEnd").covered(), 0);
  EXPECT_GT(render_text(frame + "ReverseOrientation Disk 0 1 360 WorldEnd").covered(), 100);
  EXPECT_GT(render_text(frame + "Rotate 180 0 1 0 Disk 0 1 360 WorldEnd").covered(), 100);
  EXPECT_EQ(render_text(frame + "Scale -1 1 1 Disk 0 1 360 WorldEnd").covered(), 0);
  // Of a sphere the front half is left: an open bowl seen from behind would show its inside.
  Rendered bowl = render_text(frame + "Sphere 1 -1 1 360 WorldEnd");
  EXPECT_NEAR(bowl.z(10, 10), 4, 0.01f);
}

TEST(Frame, near_clipping_opens_a_sphere) {
  Rendered r = render_text("Format 20 20 1 Clipping 5 100 PixelFilter \"box\" 1 1 WorldBegin Translate 0 0 5 "
                           "Sphere 1 -1 1 360 WorldEnd");
  EXPECT_NEAR(r.z(10, 10), 6, 0.01f); // the inside of its far half
}

TEST(Frame, clipping_planes_cut_through_surfaces) {
  std::string scene =
      " PixelSamples 8 8 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 40 Translate 0 0 5 "
      "ClippingPlane .25 0 0 1 0 0 ClippingPlane 0 0 0 0 0 -1 WorldBegin Sphere 1 -1 1 360 WorldEnd";
  Rendered r = render_text("Format 40 40 1" + scene);
  EXPECT_EQ(r.messages, "");
  // The near half is gone: the far inside is seen, up to x = .25 at its depth.
  EXPECT_NEAR(r.z(20, 20), 6, 0.02f);
  EXPECT_EQ(r.alpha(14, 20), 1);
  double edge = 20 + 20 * 0.25 / std::tan(20 * M_PI / 180) / (5 + std::sqrt(1 - 0.0625));
  int x = static_cast<int>(edge);
  EXPECT_EQ(r.alpha(x - 1, 20), 1);
  EXPECT_NEAR(r.alpha(x, 20), edge - x, 0.06);
  EXPECT_EQ(r.alpha(x + 1, 20), 0);
  EXPECT_NE(messages_of("ClippingPlane 0 0 0 0 0 0").find("ClippingPlane: the normal has no length"),
            std::string::npos);
}

TEST(Frame, a_floor_through_the_eye_reaches_the_picture_edges) {
  Rendered r =
      render_text("Format 60 60 1 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 60 WorldBegin "
                  "Polygon \"P\" [-50 -1 50  50 -1 50  50 -1 -50  -50 -1 -50] WorldEnd");
  for (int x = 0; x < 60; ++x)
    EXPECT_EQ(r.alpha(x, 59), 1) << x;
  for (int x = 0; x < 60; ++x)
    EXPECT_EQ(r.alpha(x, 20), 0) << x;
  // Depth of the floor seen through the centre of pixel (30, 49), from its similar triangles.
  double y = (49.5 - 30) / 30 * std::tan(M_PI / 6);
  EXPECT_NEAR(r.z(30, 49), 1 / y, 0.08);
}

TEST(Frame, displacement_within_its_bound_is_complete) {
  PlainShading shading;
  shading.displacement = 0.5f;
  Rendered r =
      render_text("Format 64 64 1 " + kPlain +
                      "WorldBegin Translate 0 0 5 Attribute \"displacementbound\" \"sphere\" .5 "
                      "\"coordinatesystem\" \"object\" ShadingRate .1 Sphere .25 -.25 .25 360 WorldEnd",
                  {}, shading);
  EXPECT_NEAR(r.covered(), M_PI * 24 * 24, 0.006 * M_PI * 24 * 24);
}

const char* kMixedScene =
    "Format 90 70 1 PixelSamples 3 3 Projection \"perspective\" \"fov\" 40 Translate 0 0 6 "
    "Option \"limits\" \"bucketsize\" [16 16] WorldBegin "
    "Color 1 .2 .1 Sphere 1 -1 1 360 Opacity .4 .5 .6 Color .2 1 .3 Translate .5 .5 -2 "
    "Sphere .7 -.7 .7 270 Rotate 40 1 1 0 Torus 1 .3 0 360 360 Opacity 1 1 1 Translate 0 0 5 "
    "Polygon \"P\" [-5 -5 0 5 -5 0 5 5 0 -5 5 0] \"Cs\" [1 0 0 0 1 0 0 0 1 1 1 1] WorldEnd";

TEST(Frame, pixels_do_not_depend_on_threads_or_buckets) {
  FrameSettings one, many;
  one.threads = 1;
  many.threads = 7;
  Rendered a = render_text(kMixedScene, one, true), b = render_text(kMixedScene, many, true);
  EXPECT_EQ(a.image.data, b.image.data);
  std::string other = kMixedScene;
  other.replace(other.find("[16 16]"), 7, "[23 64]");
  EXPECT_EQ(a.image.data, render_text(other, many, true).image.data);
}

TEST(Frame, a_crop_window_is_a_piece_of_the_whole) {
  Rendered whole = render_text(kMixedScene, {}, true);
  Rendered part = render_text("CropWindow .3 .8 .2 .6 " + std::string(kMixedScene), {}, true);
  EXPECT_EQ(part.image.rect.x0, 27);
  EXPECT_EQ(part.image.rect.y0, 14);
  EXPECT_EQ(part.image.rect.width(), 45);
  for (int y = part.image.rect.y0; y < part.image.rect.y1; ++y)
    for (int x = part.image.rect.x0; x < part.image.rect.x1; ++x)
      for (int c = 0; c < Image::kAov; ++c)
        ASSERT_EQ(part.image.at(c, x, y), whole.image.at(c, x, y)) << x << " " << y << " " << c;
}

constexpr const char* kEveryFilter[] = {"\"box\" 1 1",
                                        "\"triangle\" 2 2",
                                        "\"gaussian\" 2 2",
                                        "\"catmull-rom\" 4 4",
                                        "\"b-spline\" 4 4",
                                        "\"sinc\" 6 6",
                                        "\"mitchell\" 4 4",
                                        "\"disk\" 2 2",
                                        "\"lanczos\" 4 4",
                                        "\"bessel\" 6.5 6.5",
                                        "\"blackman-harris\" 4 4",
                                        "\"box\" 3 2",
                                        "\"separable-catmull-rom\" 4 4"};

TEST(Frame, filters_keep_a_constant_field_and_the_light_of_a_spot) {
  for (const char* filter : kEveryFilter) {
    SCOPED_TRACE(filter);
    std::string head =
        "Format 40 40 1 PixelSamples 8 8 Option \"limits\" \"bucketsize\" [10 10] PixelFilter " +
        std::string(filter) + " WorldBegin Translate 0 0 5 ";
    Rendered field = render_text(head + "Color .25 .5 1 Disk 0 9 360 WorldEnd");
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x)
        ASSERT_NEAR(field.Ci(x, y).y, 0.5f, 1e-5f) << x << " " << y;
    // Two pixels wide, its corner on that of four buckets.
    Rendered spot = render_text(head + "Polygon \"P\" [0 0 0 .1 0 0 .1 .1 0 0 .1 0] WorldEnd");
    EXPECT_NEAR(spot.covered(), 4, 0.12);
  }
}

TEST(Frame, filters_reach_across_bucket_borders) {
  for (const char* filter : kEveryFilter) {
    SCOPED_TRACE(filter);
    auto rendered = [&](const char* buckets) {
      return render_text("Format 24 24 1 Option \"limits\" \"bucketsize\" " + std::string(buckets) +
                         " PixelFilter " + filter +
                         " WorldBegin Translate 0 0 5 Rotate 20 0 0 1 Scale .3 .5 1 Disk 0 1 360 WorldEnd");
    };
    EXPECT_EQ(rendered("[5 7]").image.data, rendered("[64 64]").image.data);
  }
}

TEST(Frame, exposure_and_imager) {
  std::string frame = "Format 4 4 1 PixelFilter \"box\" 1 1 Exposure 2 2 ";
  std::string world = "WorldBegin Color .5 .125 .02 Translate 0 0 5 Disk 0 9 360 WorldEnd";
  Rendered r = render_text(frame + world);
  EXPECT_FLOAT_EQ(r.Ci(1, 1).x, 1);
  EXPECT_FLOAT_EQ(r.Ci(1, 1).y, 0.5f);
  EXPECT_FLOAT_EQ(r.Ci(1, 1).z, 0.2f);
  Rendered swapped = render_text(frame + "Imager \"swap\" " + world);
  EXPECT_FLOAT_EQ(swapped.Ci(1, 1).x, 0.2f);
  EXPECT_FLOAT_EQ(swapped.Ci(1, 1).z, 1);
}

TEST(Frame, shader_variables_as_channels) {
  FrameSettings s;
  s.aovs = {{"N", 3, 0, AovChannel::Source::kVariable, {}, {1, 1}},
            {"heat", 1, 3, AovChannel::Source::kVariable, {}, {1, 1}}};
  Rendered r = render_text("Format 8 8 1 PixelFilter \"box\" 1 1 WorldBegin Translate 0 0 5 Disk 0 9 360 "
                           "\"constant float heat\" [42] WorldEnd",
                           s);
  EXPECT_NEAR(r.image.at(Image::kAov + 2, 4, 4), 1, 1e-5f);
  EXPECT_FLOAT_EQ(r.image.at(Image::kAov + 3, 4, 4), 42);
}

/// The coverage of each pixel of the middle row.
std::vector<float> middle_row(const Rendered& r) {
  std::vector<float> out;
  for (int x = r.image.rect.x0; x < r.image.rect.x1; ++x)
    out.push_back(r.alpha(x, (r.image.rect.y0 + r.image.rect.y1) / 2));
  return out;
}

constexpr const char* kMoving =
    "Format 48 24 1 ScreenWindow -24 24 -12 12 PixelSamples 16 16 PixelFilter \"box\" 1 1 "
    "Option \"limits\" \"bucketsize\" [16 16] Shutter 0 1 WorldBegin Translate 0 0 5 ";

TEST(Frame, motion_in_a_straight_line_has_a_trapezoid_profile) {
  // A square of 8 pixels goes 16 to the right: coverage rises over 8 pixels, stays at 8/16, falls over 8.
  for (const char* motion : {"MotionBegin [0 1] Translate -12 0 0 Translate 4 0 0 MotionEnd Polygon \"P\" [0 "
                             "-9 0 8 -9 0 8 9 0 0 9 0]",
                             "MotionBegin [0 1] Polygon \"P\" [-12 -9 0 -4 -9 0 -4 9 0 -12 9 0] Polygon "
                             "\"P\" [4 -9 0 12 -9 0 12 9 0 4 9 0] "
                             "MotionEnd",
                             "MotionBegin [-1 3] Translate -28 0 0 Translate 36 0 0 MotionEnd Polygon \"P\" "
                             "[0 -9 0 8 -9 0 8 9 0 0 9 0]"}) {
    SCOPED_TRACE(motion);
    std::vector<float> row = middle_row(render_text(std::string(kMoving) + motion + " WorldEnd"));
    for (size_t x = 0; x < row.size(); ++x) {
      double at = static_cast<double>(x) + 0.5 - 12; // the square's left side starts at pixel 12
      double expected = std::max(0.0, std::min({at / 16, 0.5, (24 - at) / 16}));
      EXPECT_NEAR(row[x], expected, 0.03) << x;
    }
  }
}

TEST(Frame, motion_follows_all_keys) {
  // To the right in the first half, back in the second: the turning point is covered twice as long.
  std::vector<float> row = middle_row(
      render_text(std::string(kMoving) +
                  "MotionBegin [0 .5 1] Translate -12 0 0 Translate 4 0 0 Translate -12 0 0 MotionEnd "
                  "Polygon \"P\" [0 -9 0 8 -9 0 8 9 0 0 9 0] WorldEnd"));
  EXPECT_NEAR(row[20], 0.5, 0.03);
  EXPECT_NEAR(row[30], (24 - 18.5) / 16, 0.03);
  EXPECT_EQ(row[8], 0);
}

TEST(Frame, moving_pictures_do_not_depend_on_threads_or_buckets) {
  auto rendered = [](int threads, const char* buckets) {
    FrameSettings s;
    s.threads = threads;
    return render_text(
        "Format 60 50 1 PixelSamples 3 2 Shutter 0 1 Projection \"perspective\" \"fov\" 50 "
        "DepthOfField 2 1 4 Option \"limits\" \"bucketsize\" " +
            std::string(buckets) +
            " Translate 0 0 5 WorldBegin MotionBegin [0 1] Rotate 0 0 1 0 Rotate 30 1 1 0 MotionEnd "
            "Torus 1 .4 0 360 360 Opacity .5 .5 .5 Translate 1 0 2 Sphere 1 -1 1 360 WorldEnd",
        s, true);
  };
  Rendered a = rendered(1, "[16 16]");
  EXPECT_EQ(a.image.data, rendered(5, "[16 16]").image.data);
  EXPECT_EQ(a.image.data, rendered(2, "[7 64]").image.data);
}

TEST(Frame, a_point_out_of_focus_becomes_a_disk_of_its_circle_of_confusion) {
  // fov 90, 64 pixels: 32 pixels per unit at depth 1. Lens 2 wide, focus at 4: at depth 2 the disk has radius
  // 1 * (1/2 - 1/4) * 32 = 8 pixels.
  auto rendered = [](const std::string& depth) {
    return render_text(
        "Format 64 64 1 PixelSamples 16 16 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 90 "
        "DepthOfField .5 1 4 WorldBegin Translate 0 0 " +
        depth + " Polygon \"P\" [-.0625 -.0625 0 .0625 -.0625 0 .0625 .0625 0 -.0625 .0625 0] WorldEnd");
  };
  Rendered near = rendered("2");
  double area = 4;                                // 0.125 units, 16 pixels each
  EXPECT_NEAR(near.covered(), area, 0.05 * area); // light is spread, not lost
  double inside = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      double r = std::hypot(x - 31.5, y - 31.5);
      if (r > 10) {
        EXPECT_EQ(near.alpha(x, y), 0);
      }
      if (r < 6) inside += near.alpha(x, y);
    }
  EXPECT_NEAR(inside / near.covered(), 36.0 / 64, 0.04);
  Rendered sharp = rendered("4");
  EXPECT_EQ(sharp.alpha(34, 32), 0);
  EXPECT_NEAR(sharp.covered(), 1, 0.05);
}

TEST(Frame, subpixel_gives_a_pixel_to_each_sample) {
  Rendered r = render_text(
      "Format 8 6 1 PixelSamples 4 2 Hider \"hidden\" \"int subpixel\" 1 \"int jitter\" 0 WorldBegin "
      "Translate 0 0 5 Disk 0 .75 360 WorldEnd");
  EXPECT_EQ(r.image.rect.width(), 32);
  EXPECT_EQ(r.image.rect.height(), 12);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 32; ++x) {
      double px = (x + 0.5) / 4 - 4, py = (y + 0.5) / 2 - 3;
      if (std::abs(std::hypot(px, py) - 2.25) < 0.05) continue;
      EXPECT_EQ(r.alpha(x, y), std::hypot(px, py) < 2.25 ? 1 : 0) << x << " " << y;
      EXPECT_EQ(r.z(x, y), std::hypot(px, py) < 2.25 ? 5 : Image::kEmptyDepth);
    }
}

TEST(Frame, depth_filters) {
  auto depth = [](const std::string& filter) {
    return render_text("Format 2 2 1 PixelSamples 4 4 Hider \"hidden\" \"int jitter\" 0 \"depthfilter\" \"" +
                       filter +
                       "\" WorldBegin Polygon \"P\" [-1 -1 2  .25 -1 2  .25 1 2  -1 1 2] "
                       "Polygon \"P\" [-1 -1 6  1 -1 6  1 1 6  -1 1 6] WorldEnd")
        .z(1, 0);
  };
  // The near square covers a quarter of the pixel.
  EXPECT_FLOAT_EQ(depth("min"), 2);
  EXPECT_FLOAT_EQ(depth("max"), 6);
  EXPECT_FLOAT_EQ(depth("average"), 5);
  EXPECT_FLOAT_EQ(depth("midpoint"), 4);
}

TEST(Frame, the_depth_threshold_decides_what_has_a_depth) {
  std::string world =
      " WorldBegin Opacity .5 .5 .5 Polygon \"P\" [-9 -9 2  9 -9 2  9 9 2  -9 9 2] Opacity 1 1 1 "
      "Polygon \"P\" [-9 -9 6  9 -9 6  9 9 6  -9 9 6] WorldEnd";
  EXPECT_FLOAT_EQ(render_text("Format 2 2 1" + world).z(1, 1), 6);
  EXPECT_FLOAT_EQ(
      render_text("Format 2 2 1 Option \"limits\" \"color zthreshold\" [.5 .5 .5]" + world).z(1, 1), 2);
}

TEST(Frame, a_depth_mask_leaves_out_one_side) {
  DepthMask mask{2, 1, {3, Image::kEmptyDepth}, false, 0.01f};
  FrameSettings s;
  s.mask = &mask;
  auto depths = [&](bool reverse) {
    mask.reverse = reverse;
    Rendered r = render_text("Format 4 2 1 WorldBegin Polygon \"P\" [-9 -9 2  9 -9 2  9 9 2  -9 9 2] "
                             "Polygon \"P\" [-9 -9 6  9 -9 6  9 9 6  -9 9 6] WorldEnd",
                             s);
    return std::pair(r.z(0, 0), r.z(3, 0));
  };
  EXPECT_EQ(depths(false), std::pair(6.0f, Image::kEmptyDepth));
  EXPECT_EQ(depths(true), std::pair(2.0f, 2.0f));
}

TEST(Frame, grids_that_a_depth_mask_leaves_out_are_not_shaded) {
  // Two balls, two buckets apart. The mask is at 5 in the left half, the right half of it is empty.
  DepthMask mask{2, 1, {5, Image::kEmptyDepth}, false, 0.01f};
  FrameSettings s;
  s.mask = &mask;
  auto shaded = [&](bool masked, bool reverse, float z, const std::string& attribute = "") {
    mask.reverse = reverse;
    s.mask = masked ? &mask : nullptr;
    std::string ball =
        fmt::format("Translate -1.3 0 {} Sphere .6 -.6 .6 360 Translate 2.6 0 0 Sphere .6 -.6 .6 360 ", z);
    Rendered r = render_text("Format 128 64 1 WorldBegin " + attribute + ball + "WorldEnd", s);
    EXPECT_EQ(r.messages, "");
    return r.report.shaded_grids;
  };
  const size_t both = shaded(false, false, 8);
  EXPECT_GT(both, 2u);
  EXPECT_EQ(shaded(true, false, 8), both / 2);
  EXPECT_EQ(shaded(true, false, 3), 0u);
  EXPECT_EQ(shaded(true, true, 8), both / 2);
  EXPECT_EQ(shaded(true, true, 3), shaded(false, true, 3));
  // Unless baking needs them.
  const std::string kept = "Attribute \"cull\" \"int hidden\" 0 ";
  EXPECT_EQ(shaded(true, false, 3, kept), shaded(false, false, 3, kept));
}

TEST(Frame, hidden_grids_are_not_shaded) {
  std::string frame = "Format 64 64 1 WorldBegin Translate 0 0 5 Disk 0 9 360 ";
  Rendered alone = render_text(frame + "WorldEnd");
  Rendered with_hidden = render_text(frame + "Translate 0 0 5 Sphere 1 -1 1 360 WorldEnd");
  EXPECT_GT(with_hidden.report.grids, alone.report.grids);
  EXPECT_EQ(with_hidden.report.shaded_grids, alone.report.shaded_grids);
  // Unless baking needs them.
  Rendered kept =
      render_text(frame + "Translate 0 0 5 Attribute \"cull\" \"int hidden\" 0 Sphere 1 -1 1 360 WorldEnd");
  EXPECT_EQ(kept.messages, "");
  EXPECT_EQ(kept.report.shaded_grids, kept.report.grids);
  EXPECT_EQ(kept.image.data, alone.image.data);
}

TEST(Frame, back_faces_are_shaded_for_baking) {
  std::string frame = "Format 64 64 1 WorldBegin Translate 0 0 5 Sides 1 ";
  EXPECT_EQ(render_text(frame + "Disk 0 1 360 WorldEnd").report.shaded_grids, 0u);
  Rendered kept = render_text(frame + "Attribute \"cull\" \"int backfacing\" 0 Disk 0 1 360 WorldEnd");
  EXPECT_EQ(kept.report.shaded_grids, kept.report.grids);
  EXPECT_EQ(kept.covered(), 0);
}

} // namespace
} // namespace render::testing
