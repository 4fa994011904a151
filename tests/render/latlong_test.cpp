// Directions as places of latitude-longitude maps, beside the formulas in double precision.
#include "render/texture/latlong.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace render::testing {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(LatLong, places_and_changes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> side(-2, 2), small(-1e-2f, 1e-2f);
  for (int round = 0; round < 100; ++round) {
    Directions d;
    for (size_t i = 0; i < TextureRegions::kBlock; ++i)
      for (int c = 0; c < 3; ++c) {
        d.centre[c][i] = side(random);
        d.along_u[c][i] = small(random);
      }
    TextureRegions out;
    find_latlong(d, out);
    for (size_t i = 0; i < TextureRegions::kBlock; ++i) {
      auto place = [&](double step) {
        double v[3];
        for (int c = 0; c < 3; ++c)
          v[c] = static_cast<double>(d.centre[c][i]) + step * static_cast<double>(d.along_u[c][i]);
        return std::pair(std::atan2(v[1], v[0]) / (2 * kPi),
                         0.5 - std::atan2(v[2], std::hypot(v[0], v[1])) / kPi);
      };
      const auto [s, t] = place(0);
      EXPECT_NEAR(static_cast<double>(out.s[i]), s < 0 ? s + 1 : s, 2e-7);
      EXPECT_NEAR(static_cast<double>(out.t[i]), t, 2e-7);
      const auto [s1, t1] = place(1e-4);
      if (std::hypot(d.centre[0][i], d.centre[1][i]) < 0.1f || std::abs(s1 - s) > 0.5) continue;
      EXPECT_NEAR(static_cast<double>(out.s_u[i]), (s1 - s) * 1e4, 1e-4);
      EXPECT_NEAR(static_cast<double>(out.t_u[i]), (t1 - t) * 1e4, 1e-4);
    }
  }
}

TEST(LatLong, axes_and_nothing) {
  const float ways[][5] = {{1, 0, 0, 0, 0.5f},      {0, 1, 0, 0.25f, 0.5f}, {-1, 0, 0, 0.5f, 0.5f},
                           {0, -1, 0, 0.75f, 0.5f}, {0, 0, 1, 0, 0},        {0, 0, -2, 0, 1},
                           {0, 0, 0, 0, 0.5f}};
  Directions d;
  for (size_t i = 0; i < std::size(ways); ++i)
    for (int c = 0; c < 3; ++c) {
      d.centre[c][i] = ways[i][c];
      d.along_u[c][i] = 0.1f;
    }
  for (size_t i = 0; i < 3; ++i)
    d.centre[i][10 + i] = std::nanf("");
  TextureRegions out;
  find_latlong(d, out);
  for (size_t i = 10; i < 13; ++i)
    EXPECT_TRUE(std::isnan(out.s[i])) << i;
  for (size_t i = 0; i < std::size(ways); ++i) {
    EXPECT_NEAR(out.s[i], ways[i][3], 1e-7f) << i;
    EXPECT_NEAR(out.t[i], ways[i][4], 1e-7f) << i;
    EXPECT_TRUE(std::isfinite(out.s_u[i]) && std::isfinite(out.t_u[i])) << i;
  }
}

} // namespace
} // namespace render::testing
