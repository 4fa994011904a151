// Dilation of depth masks against a search of all pixels.
#include "render/texture/dilate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace render::testing {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

TEST(Dilate, a_disc_grows_around_a_pixel) {
  std::vector<float> d(21 * 15, kNone);
  d[7 * 21 + 10] = 3;
  dilate_depths(21, 15, 4.5f, d);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 21; ++x)
      EXPECT_EQ(d[static_cast<size_t>(y * 21 + x)], std::hypot(x - 10, y - 7) <= 4.5 ? 3 : kNone)
          << x << ' ' << y;
}

TEST(Dilate, each_pixel_takes_its_nearest_depth) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    int w = 1 + static_cast<int>(random() % 40), h = 1 + static_cast<int>(random() % 40);
    std::vector<float> d(static_cast<size_t>(w * h), kNone);
    for (float& z : d)
      if (random() % 60 == 0) z = static_cast<float>(random() % 1000);
    std::vector<float> before = d;
    float radius = static_cast<float>(random() % 12) + 0.25f;
    dilate_depths(w, h, radius, d);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        double best = 1e30;
        for (int j = 0; j < h; ++j)
          for (int i = 0; i < w; ++i)
            if (std::isfinite(before[static_cast<size_t>(j * w + i)]))
              best = std::min(best, std::hypot(i - x, j - y));
        float got = d[static_cast<size_t>(y * w + x)];
        if (best > radius) {
          EXPECT_EQ(got, kNone);
          continue;
        }
        bool is_nearest = false; // several may be as near
        for (int j = 0; j < h; ++j)
          for (int i = 0; i < w; ++i)
            is_nearest |=
                before[static_cast<size_t>(j * w + i)] == got && std::hypot(i - x, j - y) <= best + 1e-9;
        EXPECT_TRUE(is_nearest) << x << ' ' << y;
      }
  }
}

TEST(Dilate, without_depths_there_is_nothing_to_grow) {
  std::vector<float> d(12, kNone);
  dilate_depths(4, 3, 100, d);
  EXPECT_EQ(d, std::vector<float>(12, kNone));
  std::vector<float> full(12, 2.0f);
  dilate_depths(4, 3, 100, full);
  EXPECT_EQ(full, std::vector<float>(12, 2.0f));
}

} // namespace
} // namespace render::testing
