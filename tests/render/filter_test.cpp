// Weights of the pixel filters.
#include "render/hider/filter.h"

#include "render/display/quantize.h"
#include "render/display/quantize_row.h"

#include <gtest/gtest.h>

#include <cmath>

namespace render {
namespace {

constexpr FilterKind kAll[] = {FilterKind::kBox,
                               FilterKind::kTriangle,
                               FilterKind::kGaussian,
                               FilterKind::kCatmullRom,
                               FilterKind::kBSpline,
                               FilterKind::kSinc,
                               FilterKind::kMitchell,
                               FilterKind::kDisk,
                               FilterKind::kSeparableCatmullRom,
                               FilterKind::kBlackmanHarris,
                               FilterKind::kLanczos,
                               FilterKind::kBessel};

TEST(Filter, known_weights) {
  EXPECT_EQ(filter_weight({FilterKind::kBox, 2, 2}, 0.9f, -1), 1);
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kTriangle, 2, 4}, 0.5f, 0.5f), 0.5f * 0.75f);
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kGaussian, 2, 2}, 1, 0), std::exp(-2.0f));
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kGaussian, 4, 4}, 1, 1), std::exp(-1.0f));
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kCatmullRom, 4, 4}, 0, 0), 1);
  EXPECT_NEAR(filter_weight({FilterKind::kCatmullRom, 4, 4}, 1, 0), 0, 1e-6f);
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kCatmullRom, 4, 4}, 1.5f, 0), -0.0625f);
  EXPECT_NEAR(filter_weight({FilterKind::kSinc, 8, 8}, kPi, 0), 0, 1e-6f);
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kBSpline, 4, 4}, 0, 0), 4 / 9.0f);
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kBSpline, 4, 4}, 1, 0), 1 / 9.0f);
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kMitchell, 4, 4}, 0, 0), 64 / 81.0f);
  EXPECT_NEAR(filter_weight({FilterKind::kMitchell, 4, 4}, 1, 0), 8 / 9.0f / 18, 1e-6f);
  EXPECT_EQ(filter_weight({FilterKind::kDisk, 2, 2}, 0.7f, 0.7f), 1);
  EXPECT_EQ(filter_weight({FilterKind::kDisk, 2, 2}, 0.8f, 0.7f), 0);
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kSeparableCatmullRom, 4, 4}, 1.5f, 0), -0.0625f);
  EXPECT_NEAR(filter_weight({FilterKind::kSeparableCatmullRom, 4, 4}, 1, 0.5f), 0, 1e-6f);
  EXPECT_FLOAT_EQ(filter_weight({FilterKind::kBlackmanHarris, 4, 4}, 0, 0), 1);
  EXPECT_NEAR(filter_weight({FilterKind::kBlackmanHarris, 4, 4}, 1, 0), 0.35875f - 0.14128f, 1e-6f);
  EXPECT_NEAR(filter_weight({FilterKind::kLanczos, 4, 4}, 1, 0.2f), 0, 1e-6f);
  EXPECT_NEAR(filter_weight({FilterKind::kLanczos, 4, 4}, 0.5f, 0), 2 / kPi * std::sqrt(8.0f) / kPi, 1e-5f);
  EXPECT_NEAR(filter_weight({FilterKind::kBessel, 6, 6}, 1.219670f, 0), 0, 1e-5f); // the first dark ring
}

TEST(Filter, zero_outside_and_even_in_x_and_y) {
  for (FilterKind kind : kAll) {
    PixelFilter f{kind, 3, 2};
    EXPECT_EQ(filter_weight(f, 1.51f, 0), 0);
    EXPECT_EQ(filter_weight(f, 0, -1.01f), 0);
    EXPECT_EQ(filter_weight(f, 0.7f, 0.3f), filter_weight(f, -0.7f, -0.3f));
    EXPECT_GT(filter_weight(f, 0, 0), 0.3f);
  }
}

TEST(Filter, b_spline_and_mitchell_sum_to_one_over_pixels) {
  for (FilterKind kind : {FilterKind::kBSpline, FilterKind::kMitchell})
    for (float x : {0.0f, 0.2f, 0.5f}) {
      float sum = 0;
      for (int i = -3; i <= 3; ++i)
        sum += filter_weight({kind, 4, 4}, x + static_cast<float>(i), 0);
      EXPECT_NEAR(sum,
                  filter_weight({kind, 4, 4}, 0, 0) / (kind == FilterKind::kBSpline ? 2 / 3.0f : 8 / 9.0f),
                  1e-5f);
    }
}

TEST(Quantize, rounds_and_clamps) {
  Quantization q{255, 0, 255, 0, true};
  EXPECT_EQ(quantize(0.5f, q, 0, 0, 0), 128);
  EXPECT_EQ(quantize(2, q, 0, 0, 0), 255);
  EXPECT_EQ(quantize(-1, q, 0, 0, 0), 0);
  EXPECT_EQ(quantize(std::nanf(""), q, 0, 0, 0), 0);
  EXPECT_EQ(quantize(1, {65535, 0, 65535, 0, true}, 0, 0, 0), 65535);
}

TEST(Quantize, dither_is_centred_and_repeatable) {
  Quantization q{255, 0, 255, 0.5f, true};
  double sum = 0;
  for (int i = 0; i < 20000; ++i)
    sum += quantize(100.3f / 255, q, i % 173, i / 173, 0);
  EXPECT_NEAR(sum / 20000, 100.3, 0.02);
  EXPECT_EQ(quantize(0.4f, q, 5, 6, 1), quantize(0.4f, q, 5, 6, 1));
}

TEST(Quantize, rows_are_as_their_pixels) {
  std::vector<float> values;
  for (int i = 0; i < 77; ++i)
    values.push_back(static_cast<float>(i % 19) / 14 - 0.1f);
  values[3] = std::nanf("");
  values[5] = kInfinity;
  const size_t n = values.size();
  std::vector<uint64_t> hashes(n);
  std::vector<int> row(n);
  for (const Quantization& q : {Quantization{255, 0, 255, 0.5f, true}, Quantization{65535, 0, 65535, 0, true},
                                Quantization{100, -20, 300, 2, true, 20}})
    for (int channel : {0, 2, 4, 9}) {
      hash_row(-30, 12, Quantizer::group_of(channel), hashes);
      quantize_row(q, channel, hashes, values.data(), row.data());
      for (size_t i = 0; i < n; ++i)
        EXPECT_EQ(row[i], quantize(values[i], q, static_cast<int>(i) - 30, 12, channel)) << i;
    }
}

} // namespace
} // namespace render
