// Levels of mip-maps.
#include "render/texture/shrink.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace render::testing {
namespace {

constexpr FilterKind kAll[] = {FilterKind::kBox,        FilterKind::kTriangle, FilterKind::kGaussian,
                               FilterKind::kCatmullRom, FilterKind::kBSpline,  FilterKind::kSinc,
                               FilterKind::kMitchell,   FilterKind::kDisk,     FilterKind::kBlackmanHarris};

TEST(Shrink, sizes) {
  EXPECT_EQ(half_of(ImageSize{7, 1}), (ImageSize{3, 1}));
  EXPECT_EQ(half_of(ImageSize{2, 5}), (ImageSize{1, 2}));
}

TEST(Shrink, what_is_even_stays_so_under_all_filters) {
  for (const FilterKind kind : kAll)
    for (const auto wrap : {TextureWrap::kBlack, TextureWrap::kPeriodic, TextureWrap::kClamp})
      for (const bool sphere : {false, true}) {
        FloatImage image(13, 10, 2);
        for (size_t i = 0; i < image.numbers.size(); ++i)
          image.numbers[i] = i % 2 == 0 ? 0.25f : 3.0f;
        const FloatImage half = half_of(image, {kind, wrap, wrap, sphere});
        ASSERT_EQ(half.width * half.height, 6 * 5);
        for (size_t i = 0; i < half.numbers.size(); ++i)
          EXPECT_NEAR(half.numbers[i], i % 2 == 0 ? 0.25f : 3.0f, 1e-5f);
      }
}

TEST(Shrink, a_box_is_the_mean_of_the_area) {
  FloatImage image(5, 2, 1);
  image.numbers = {1, 2, 3, 4, 5, 11, 12, 13, 14, 15};
  const FloatImage half = half_of(image, {});
  ASSERT_EQ(half.numbers.size(), 2u);
  EXPECT_FLOAT_EQ(half.numbers[0], 5 + (1 + 2 + 1.5f) / 2.5f);
  EXPECT_FLOAT_EQ(half.numbers[1], 5 + (1.5f + 4 + 5) / 2.5f);
}

// A pixel at the left end has a part in the right one only if the image goes round.
TEST(Shrink, sides) {
  FloatImage image(16, 2, 1);
  image.numbers[0] = image.numbers[16] = 1;
  for (const FilterKind kind : {FilterKind::kTriangle, FilterKind::kGaussian, FilterKind::kBSpline}) {
    EXPECT_GT(half_of(image, {kind, TextureWrap::kPeriodic, TextureWrap::kClamp}).numbers[7], 0.05f);
    EXPECT_EQ(half_of(image, {kind, TextureWrap::kClamp, TextureWrap::kClamp}).numbers[7], 0);
    // Black sides do not darken.
    EXPECT_EQ(half_of(image, {kind}).numbers, half_of(image, {kind, TextureWrap::kBlack}).numbers);
  }
}

// Light from all directions is the same in every level.
TEST(Shrink, rows_of_a_sphere_count_by_their_length) {
  auto light = [](const FloatImage& image) {
    double sum = 0, all = 0;
    for (int y = 0; y < image.height; ++y) {
      const double weight = std::sin((y + 0.5) / image.height * std::numbers::pi);
      for (int x = 0; x < image.width; ++x) {
        sum += weight * static_cast<double>(image.row(y)[x]);
        all += weight;
      }
    }
    return sum / all;
  };
  FloatImage image(64, 32, 1);
  for (int x = 0; x < 64; ++x)
    image.row(0)[x] = 10; // at the pole
  const double before = light(image);
  EXPECT_NEAR(light(half_of(image, {.sphere = true})), before, 0.06 * before);
  EXPECT_GT(light(half_of(image, {})), 1.5 * before);
}

} // namespace
} // namespace render::testing
