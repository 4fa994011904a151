// ctransform: known colours, round trips, names.
#include "tests/unit/kernels/harness.h"

#include <gtest/gtest.h>

namespace slvm::test {
namespace {

using Rgb = std::array<float, 3>;

Rgb convert(std::string_view from, std::string_view to, Rgb c) {
  StringPool strings;
  std::mt19937 random(1);
  ShadeopId row = row_of("ctransform", "color(uniform string from, uniform string to, color c)");
  Arguments arguments = make_arguments(row, kMaxLanes, Values::kModerate, random, strings);
  for (size_t lane = 0; lane < kMaxLanes; ++lane) {
    arguments.values[0].bits[lane][0] = strings.intern(from);
    arguments.values[1].bits[lane][0] = strings.intern(to);
    for (size_t i = 0; i < 3; ++i)
      arguments.values[2].set(lane, i, c[i]);
  }
  Value v = call(kernel_table(), row, arguments, strings)[0];
  return {v.at(3, 0), v.at(3, 1), v.at(3, 2)};
}
void expect_near(Rgb got, Rgb expected, float tolerance = 2e-6f) {
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(got[i], expected[i], tolerance) << "component " << i;
}

TEST(Color, HueSaturationValueOfKnownColors) {
  expect_near(convert("rgb", "hsv", {1, 0, 0}), {0, 1, 1});
  expect_near(convert("rgb", "hsv", {0, 1, 0}), {1 / 3.0f, 1, 1});
  expect_near(convert("rgb", "hsv", {0, 0, 0.5f}), {2 / 3.0f, 1, 0.5f});
  expect_near(convert("rgb", "hsv", {1, 0, 0.5f}), {11 / 12.0f, 1, 1});
  expect_near(convert("rgb", "hsv", {0.25f, 0.25f, 0.25f}), {0, 0, 0.25f});
  expect_near(convert("rgb", "hsv", {0, 0, 0}), {0, 0, 0});
  expect_near(convert("hsv", "rgb", {0.5f, 1, 1}), {0, 1, 1});
  expect_near(convert("hsv", "rgb", {1, 1, 1}), {1, 0, 0}); // hue turns once round
}
TEST(Color, HueSaturationLightnessOfKnownColors) {
  expect_near(convert("rgb", "hsl", {1, 0, 0}), {0, 1, 0.5f});
  expect_near(convert("rgb", "hsl", {1, 1, 1}), {0, 0, 1});
  expect_near(convert("rgb", "hsl", {0.5f, 1, 0.5f}), {1 / 3.0f, 1, 0.75f});
  expect_near(convert("hsl", "rgb", {1 / 6.0f, 1, 0.25f}), {0.5f, 0.5f, 0});
}
TEST(Color, LinearSpacesOfKnownColors) {
  expect_near(convert("rgb", "YIQ", {1, 1, 1}), {1, 0, 0});
  expect_near(convert("rgb", "YIQ", {1, 0, 0}), {0.299f, 0.596f, 0.212f});
  expect_near(convert("rgb", "xyz", {1, 1, 1}), {0.95046f, 1, 1.08906f}, 1e-4f); // D65
  expect_near(convert("rgb", "xyY", {1, 1, 1}), {0.3127f, 0.3290f, 1}, 1e-4f);
  expect_near(convert("rgb", "xyY", {1, 0, 0}), {0.64f, 0.33f, 0.2126f}, 1e-4f); // BT.709 red
  expect_near(convert("rgb", "xyY", {0, 0, 0}), {0, 0, 0});
}
TEST(Color, EverySpaceGoesThereAndBack) {
  for (std::string_view space : {"hsv", "hsl", "YIQ", "xyz", "xyY", "XYZ", "yiq", "rgb"})
    for (Rgb c : {Rgb{0.2f, 0.5f, 0.9f}, Rgb{0.9f, 0.1f, 0.4f}, Rgb{0.3f, 0.8f, 0.05f}, Rgb{1, 1, 0},
                  Rgb{0.5f, 0.5f, 0.5f}}) {
      expect_near(convert(space, "rgb", convert("rgb", space, c)), c, 1e-5f);
      if (c[0] == c[1] && c[1] == c[2]) continue; // a grey has no hue that rounding would keep
      expect_near(convert(space, "hsv", convert("hsl", space, convert("rgb", "hsl", c))),
                  convert("rgb", "hsv", c), 1e-4f);
    }
}
TEST(Color, UnknownSpacesChangeNothing) {
  expect_near(convert("rgb", "lab", {0.1f, 0.2f, 0.3f}), {0.1f, 0.2f, 0.3f}, 0);
  expect_near(convert("hsv", "hsv", {0.1f, 0.2f, 0.3f}), {0.1f, 0.2f, 0.3f}, 0);
}

} // namespace
} // namespace slvm::test
