// sldilate on a mask that slrender made.
#include "tests/render/run_slrender.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace anemone::test {
namespace {

using ::testing::HasSubstr;

class Sldilate : public SlrenderTest {
protected:
  Outcome dilate(const std::string& arguments) {
    return run_command(fmt::format("'{}' {}", SLDILATE_PROGRAM, arguments));
  }
};

TEST_F(Sldilate, a_mask_grows_by_a_part_of_its_width) {
  file(
      "mask.rib",
      "Format 100 50 1 Hider \"hidden\" \"subpixel\" [1] PixelSamples 1 1 Display \"mask.z\" \"zfile\" \"z\" "
      "ScreenWindow -2 2 -1 1 WorldBegin Translate 0 0 3 Disk 0 0.4 360 WorldEnd");
  ASSERT_EQ(run("mask.rib").status, 0);
  Outcome o = dilate("-r 0.1 mask.z big.z");
  EXPECT_EQ(o.status, 0) << o.text;
  std::vector<float> before = pixels("mask.z"), after = pixels("big.z");
  ASSERT_EQ(before.size(), 5000u);
  ASSERT_EQ(after.size(), 5000u);
  // A disc of radius 10 pixels becomes one of radius 20, as far as the picture goes.
  auto covered = [](const std::vector<float>& z) {
    return std::count_if(z.begin(), z.end(), [](float d) { return d < 1e29f; });
  };
  EXPECT_NEAR(static_cast<double>(covered(before)), 314, 25);
  EXPECT_NEAR(static_cast<double>(covered(after)), 1257, 70);
  EXPECT_TRUE(std::all_of(after.begin(), after.end(), [](float d) { return d > 1e29f || d == 3; }));
  // The mask still knows its camera: another dilation of nothing, in place.
  EXPECT_EQ(dilate("-r 0 big.z big.z").status, 0);
  EXPECT_EQ(pixels("big.z"), after);
}

TEST_F(Sldilate, what_goes_wrong_is_told) {
  Outcome o = dilate("none.z out.z");
  EXPECT_EQ(o.status, 3);
  EXPECT_THAT(o.text, HasSubstr("sldilate: error: none.z: there is no such file"));
  file("text.z", "no picture");
  EXPECT_EQ(dilate("text.z out.z").status, 1);
  EXPECT_FALSE(exists("out.z"));
  EXPECT_EQ(dilate("-r 2 text.z out.z").status, 2);
  EXPECT_EQ(dilate("").status, 2);
}

} // namespace
} // namespace anemone::test
