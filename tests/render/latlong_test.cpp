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
      // The extent of the region moves its middle by as much at most.
      const double part = std::hypot(d.along_u[0][i], d.along_u[1][i], d.along_u[2][i]) /
                          std::hypot(d.centre[0][i], d.centre[1][i], d.centre[2][i]) / kPi;
      EXPECT_NEAR(static_cast<double>(out.t[i]), t, 3e-7 + part * part / 24 / std::min(t, 1 - t));
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
    EXPECT_NEAR(out.t[i], ways[i][4], 0.015f) << i;
    EXPECT_TRUE(std::isfinite(out.s_u[i]) && std::isfinite(out.t_u[i])) << i;
  }
}

/// Regions of a sphere, and what of the map they are: their middle and their spread are those of many points.
TEST(LatLong, regions_near_a_pole) {
  constexpr double kSide = 0.2; // of a square on the sphere
  Directions d;
  TextureRegions out;
  const double from_pole[] = {0.001, 0.05, 0.1, 0.2, 0.4, 0.8, 1.5, 1.7, 2.6, 3.0, 3.1, 3.141};
  for (size_t i = 0; i < std::size(from_pole); ++i) {
    const double c = from_pole[i];
    const float centre[] = {0, static_cast<float>(std::sin(c)), static_cast<float>(std::cos(c))},
                down[] = {0, static_cast<float>(kSide * std::cos(c)),
                          static_cast<float>(-kSide * std::sin(c))};
    for (int k = 0; k < 3; ++k) {
      d.centre[k][i] = centre[k];
      d.along_v[k][i] = down[k];
    }
    d.along_u[0][i] = static_cast<float>(-kSide);
  }
  find_latlong(d, out);
  for (size_t i = 0; i < std::size(from_pole); ++i) {
    SCOPED_TRACE(from_pole[i]);
    double mean = 0, square = 0, around = 0;
    constexpr int kPoints = 40;
    for (int a = 0; a < kPoints; ++a)
      for (int b = 0; b < kPoints; ++b) {
        double p[3];
        for (int k = 0; k < 3; ++k)
          p[k] = static_cast<double>(d.centre[k][i]) +
                 ((a + 0.5) / kPoints - 0.5) * static_cast<double>(d.along_u[k][i]) +
                 ((b + 0.5) / kPoints - 0.5) * static_cast<double>(d.along_v[k][i]);
        const double t = std::atan2(std::hypot(p[0], p[1]), p[2]) / kPi,
                     s = std::atan2(p[1], p[0]) / (2 * kPi) - 0.25, near = s - std::floor(s + 0.5);
        mean += t / (kPoints * kPoints);
        square += t * t / (kPoints * kPoints);
        around += near * near / (kPoints * kPoints);
      }
    const double spread = std::sqrt(square - mean * mean);
    EXPECT_NEAR(static_cast<double>(out.t[i]), mean, 0.7 * spread);
    EXPECT_NEAR(static_cast<double>(std::hypot(out.t_u[i], out.t_v[i])) / std::sqrt(12), spread,
                1.1 * spread);
    const double across = std::sqrt(around);
    EXPECT_NEAR(static_cast<double>(std::hypot(out.s_u[i], out.s_v[i])) / std::sqrt(12), across,
                0.35 * across);
    // In degrees the region is a square everywhere.
    const double flat = std::sin(from_pole[i]);
    EXPECT_NEAR(static_cast<double>(out.stretch[i]) * flat, 1, 0.001);
  }
}

TEST(LatLong, blur_is_the_same_angle_everywhere) {
  Directions d;
  TextureRegions out;
  for (size_t i = 0; i < TextureRegions::kBlock; ++i) {
    const double latitude = static_cast<double>(i) * 0.1 + 0.05;
    d.centre[0][i] = static_cast<float>(std::cos(latitude));
    d.centre[2][i] = static_cast<float>(i % 2 == 0 ? std::sin(latitude) : -std::sin(latitude));
    out.sblur[i] = i == 3 ? 0 : i == 4 ? 2.5f : 0.1f;
    out.tblur[i] = 0.2f;
  }
  d.centre[0][15] = 0;
  d.centre[0][14] = d.centre[2][14] = 0;
  find_latlong(d, out);
  for (size_t i = 0; i < 14; ++i) {
    const double expected = i == 3   ? 0
                            : i == 4 ? 2.5
                                     : std::min(0.1 / std::cos(static_cast<double>(i) * 0.1 + 0.05), 1.0);
    EXPECT_NEAR(static_cast<double>(out.sblur[i]), expected, 1e-5) << i;
    EXPECT_EQ(out.tblur[i], 0.2f);
  }
  EXPECT_EQ(out.sblur[14], 0.1f); // of no direction
  EXPECT_EQ(out.sblur[15], 1.0f); // at a pole
}

} // namespace
} // namespace render::testing
