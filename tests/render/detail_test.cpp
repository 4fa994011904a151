// Levels of detail: sizes, ranges, and how one level goes over into the next.
#include "tests/render/render_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace render::testing {
namespace {

using ::testing::HasSubstr;

/// 32 pixels a unit. A bound of one unit's side covers 1024 pixels.
const std::string kHead = "Format 64 64 1 PixelFilter \"box\" 1 1 PixelSamples 4 4 ";
const std::string kSheet = " Disk 0 9 360 ";

/// The colour of the pixel in the middle, with a unit cube as bound at z = 5 unless `bound` says otherwise.
Color colour(const std::string& ranges, const std::string& bound = "Detail [-.5 .5 -.5 .5 -.5 .5]",
             const std::string& options = "") {
  Rendered r = render_text(kHead + options + " WorldBegin Translate 0 0 5 " + bound + ranges + " WorldEnd");
  EXPECT_EQ(r.messages, "");
  return r.Ci(32, 32);
}

std::string level(const std::string& color, const std::string& range) {
  return " Color " + color + " DetailRange " + range + kSheet;
}

TEST(Detail, the_size_of_the_bound_chooses_among_versions) {
  std::string three = level("1 0 0", "[0 0 1000 1000]") + level("0 1 0", "[1000 1000 2000 2000]") +
                      level("0 0 1", "[2000 2000 1e38 1e38]");
  EXPECT_EQ(colour(three), Color(0, 1, 0)); // 1024
  EXPECT_EQ(colour(three, "Detail [-.48 .48 -.5 .5 0 0]"), Color(1, 0, 0));
  EXPECT_EQ(colour(three, "Scale 2 1 1 Detail [-.5 .5 -.5 .5 0 0] Identity Translate 0 0 5"), Color(0, 0, 1));
  EXPECT_EQ(colour(three, "Translate 0 0 7 Detail [-.5 .5 -.5 .5 -.5 .5] Translate 0 0 -7"), Color(0, 1, 0));
  // Without a bound the size is infinite.
  EXPECT_EQ(colour(three, ""), Color(0, 0, 1));
  EXPECT_EQ(colour(three, "Detail [-1e38 1e38 -1 1 -1 1]"), Color(0, 0, 1));
}

TEST(Detail, relative_detail_scales_all_sizes) {
  std::string two = level("1 0 0", "0 0 1000 1000") + level("0 1 0", "1000 1000 1e38 1e38");
  EXPECT_EQ(colour(two, "Detail [-.5 .5 -.5 .5 0 0]", "RelativeDetail .5"), Color(1, 0, 0));
  EXPECT_EQ(colour(two, "Detail [-.5 .5 -.5 .5 0 0]", "RelativeDetail 1"), Color(0, 1, 0));
}

TEST(Detail, perspective_makes_what_is_far_small_and_what_reaches_the_eye_infinite) {
  // At distance 4 and 90 degrees a unit is 8 pixels: 64 pixels in all.
  auto at = [](const char* z) {
    return render_text(kHead + "Projection \"perspective\" \"fov\" 90 WorldBegin Translate 0 0 " + z +
                       " Detail [-.5 .5 -.5 .5 0 0]" + level("1 0 0", "0 0 63 63") +
                       level("0 1 0", "63 63 65 65") + level("0 0 1", "65 65 1e38 1e38") + "WorldEnd")
        .Ci(32, 32);
  };
  EXPECT_EQ(at("4"), Color(0, 1, 0));
  EXPECT_EQ(at("4.2"), Color(1, 0, 0));
  EXPECT_EQ(at("3.8"), Color(0, 0, 1));
  Rendered r = render_text(kHead +
                           "Projection \"perspective\" WorldBegin Translate 0 0 4 "
                           "Detail [-.5 .5 -.5 .5 -9 .5]" +
                           level("0 0 1", "1e20 1e20 1e38 1e38") + "WorldEnd");
  EXPECT_EQ(r.Ci(32, 32), Color(0, 0, 1));
}

/// In front of each other: the one that is farther away must not be seen through the nearer one's share.
TEST(Detail, levels_that_overlap_share_the_samples_and_leave_none) {
  for (float share : {0.1f, 0.375f, 0.8f}) {
    SCOPED_TRACE(share);
    // 1024 is `share` of the way through the transition, which is 100 wide.
    std::string from = fmt::format("{}", 1024 - 100 * share),
                to = fmt::format("{}", 1024 + 100 * (1 - share));
    Rendered r = render_text("Format 64 64 1 PixelFilter \"box\" 1 1 PixelSamples 4 4 WorldBegin "
                             "Translate 0 0 5 Detail [-.5 .5 -.5 .5 0 0]" +
                             level("1 0 0", "0 0 " + from + " " + to) + " Translate 0 0 1 " +
                             level("0 1 0", from + " " + to + " 1e38 1e38") + "WorldEnd");
    EXPECT_EQ(r.messages, "");
    double green = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        ASSERT_EQ(r.alpha(x, y), 1) << x << " " << y;
        ASSERT_EQ(r.Ci(x, y).x + r.Ci(x, y).y, 1);
        // Of the 16 samples of a pixel at most one is in doubt.
        ASSERT_NEAR(r.Ci(x, y).y, share, 1 / 16.0f + 1e-5f);
        green += static_cast<double>(r.Ci(x, y).y) / 4096;
      }
    EXPECT_NEAR(green, share, 0.002);
  }
}

TEST(Detail, transitions_do_not_depend_on_threads_buckets_or_crop_windows) {
  std::string scene = " WorldBegin Translate 0 0 5 Detail [-.5 .5 -.5 .5 0 0]" +
                      level("1 0 0", "0 0 1000 1100") + level("0 1 0", "1000 1100 1e38 1e38") + "WorldEnd";
  FrameSettings one, many;
  one.threads = 1;
  many.threads = 5;
  Rendered whole = render_text(kHead + scene, one);
  EXPECT_EQ(render_text(kHead + "Option \"limits\" \"bucketsize\" [13 7]" + scene, many).image.data,
            whole.image.data);
  Rendered part = render_text(kHead + "CropWindow .25 .75 .5 1" + scene);
  for (int y = 32; y < 64; ++y)
    for (int x = 16; x < 48; ++x)
      ASSERT_EQ(part.Ci(x, y), whole.Ci(x, y));
}

TEST(Detail, a_bound_given_before_the_world_is_measured_with_its_camera) {
  std::string two = level("1 0 0", "0 0 300 300") + level("0 1 0", "300 300 1e38 1e38");
  for (auto [format, expected] :
       {std::pair("Format 64 64 1", Color(0, 1, 0)), {"Format 32 32 1", Color(1, 0, 0)}}) {
    Rendered r = render_text(std::string("Detail [-.5 .5 -.5 .5 5 5] ") + format +
                             " WorldBegin Translate 0 0 5" + two + "WorldEnd");
    EXPECT_EQ(r.Ci(16, 16), expected);
  }
}

TEST(Detail, conditions_and_procedurals_know_it) {
  Rendered r = render_text(kHead +
                           "WorldBegin Translate 0 0 5 Detail [-.5 .5 -.5 .5 0 0] IfBegin "
                           "\"$Ri:Detail == 1024\" Color 0 1 0 IfEnd" +
                           kSheet + "WorldEnd");
  EXPECT_EQ(r.messages, "");
  EXPECT_EQ(r.Ci(32, 32), Color(0, 1, 0));
  // Outside its range a procedural is not even looked for.
  std::string procedural = " Procedural \"DelayedReadArchive\" [\"nowhere.rib\"] [-1 1 -1 1 -1 1] WorldEnd";
  auto messages_when_drawn = [](const std::string& rib) { return render_text(rib).messages; };
  EXPECT_EQ(
      messages_when_drawn(
          "WorldBegin Translate 0 0 5 Detail [-.1 .1 -.1 .1 0 0] DetailRange 1e6 1e6 1e7 1e7" + procedural),
      "");
  EXPECT_THAT(messages_when_drawn("WorldBegin Translate 0 0 5" + procedural), HasSubstr("nowhere.rib"));
}

TEST(Detail, mistakes) {
  EXPECT_THAT(messages_of("DetailRange 0 3 2 4"),
              HasSubstr("DetailRange: expected 0 <= offlow <= onlow <= onhigh <= offhigh, found 0 3 2 4"));
  EXPECT_THAT(messages_of("Detail [1 -1 0 0 0 0]"),
              HasSubstr("Detail: the bound is empty; expected xmin xmax ymin ymax zmin zmax"));
  EXPECT_THAT(messages_of("RelativeDetail -1"), HasSubstr("RelativeDetail: expected a factor of 0 or more"));
}

} // namespace
} // namespace render::testing
