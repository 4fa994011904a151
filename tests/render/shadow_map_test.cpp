// Parts in shadow, beside a count of the points of the region one by one.
#include "render/texture/shadow_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace render::testing {
namespace {

constexpr size_t kBlock = ShadowRegions::kBlock;

/// 64 x 48 random depths from 0 to 2, seen by a camera at the origin that looks along z, 90 degrees wide.
ShadowMap random_map() {
  ShadowMap map;
  map.width = 64;
  map.height = 48;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> depth(0, 2);
  for (int i = 0; i < map.width * map.height; ++i)
    map.depth.push_back(depth(random));
  map.world_to_screen(2, 3) = 1; // w = z
  map.world_to_screen(3, 3) = 0;
  return map;
}

ShadowRegions regions_of(const ShadowMap& map) {
  ShadowRegions r;
  r.to_camera = map.world_to_camera;
  r.to_screen = map.world_to_screen;
  return r;
}

/// At a point of a region, by how far it is along the two sides.
bool hidden(const ShadowMap& map, const ShadowRegions& r, size_t i, float a, float b) {
  float p[3];
  for (int c = 0; c < 3; ++c)
    p[c] = r.centre[c][i] + a * r.along_u[c][i] + b * r.along_v[c][i];
  if (!(p[2] > 0)) return false;
  const float s = 0.5f + 0.5f * p[0] / p[2] + a * r.sblur[i], t = 0.5f - 0.5f * p[1] / p[2] + b * r.tblur[i];
  if (!(s >= 0 && s < 1 && t >= 0 && t < 1)) return false;
  const int x = static_cast<int>(s * static_cast<float>(map.width)),
            y = static_cast<int>(t * static_cast<float>(map.height));
  return p[2] > map.depth[static_cast<size_t>(y * map.width + x)] + r.bias[i];
}

TEST(ShadowMap, counts_the_points_that_are_behind) {
  const ShadowMap map = random_map();
  ShadowRegions r = regions_of(map);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-1.2f, 1.2f), side(-0.3f, 0.3f);
  for (size_t i = 0; i < kBlock; ++i) {
    for (int c = 0; c < 3; ++c) {
      r.centre[c][i] = place(random);
      r.along_u[c][i] = side(random);
      r.along_v[c][i] = side(random);
    }
    r.sblur[i] = std::abs(side(random));
    r.tblur[i] = std::abs(side(random));
    r.bias[i] = 0.01f;
    r.turn[i] = static_cast<uint32_t>(random());
  }
  r.samples = 1024;
  float out[kBlock];
  map.shadowed(r, out);
  for (size_t i = 0; i < kBlock; ++i) {
    constexpr int kSide = 300;
    int count = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        count += hidden(map, r, i, (static_cast<float>(x) + 0.5f) / kSide - 0.5f,
                        (static_cast<float>(y) + 0.5f) / kSide - 0.5f);
    EXPECT_NEAR(out[i], static_cast<float>(count) / (kSide * kSide), 0.02f) << i;
  }
}

TEST(ShadowMap, points_are_in_shadow_or_not) {
  const ShadowMap map = random_map();
  ShadowRegions r = regions_of(map);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-1.2f, 1.2f);
  for (int round = 0; round < 50; ++round) {
    for (size_t i = 0; i < kBlock; ++i) {
      for (int c = 0; c < 3; ++c)
        r.centre[c][i] = place(random) + (c == 2 ? 1.0f : 0.0f);
      r.turn[i] = static_cast<uint32_t>(random());
    }
    float out[kBlock];
    map.shadowed(r, out);
    for (size_t i = 0; i < kBlock; ++i)
      EXPECT_EQ(out[i], hidden(map, r, i, 0, 0) ? 1 : 0);
  }
}

// Also beside each other: one lane must not disturb another.
TEST(ShadowMap, what_is_no_place_has_no_shadow) {
  ShadowMap map = random_map();
  map.depth.assign(map.depth.size(), 0.0f);
  ShadowRegions r = regions_of(map);
  const float nan = std::nanf(""),
              strange[][3] = {{nan, 0, 1},   {0, nan, 1},      {0, 0, nan},      {0, 0, -1},
                              {0, 0, 0},     {INFINITY, 0, 1}, {0, 0, INFINITY}, {2, 0, 1},
                              {0, -1.1f, 1}, {1e30f, 1e30f, 1}};
  for (size_t i = 0; i < kBlock; ++i)
    for (int c = 0; c < 3; ++c) {
      r.centre[c][i] = i < std::size(strange) ? strange[i][c] : c == 2 ? 1.0f : 0.0f;
      r.along_u[c][i] = c == 0 ? 1e-3f : 0.0f;
    }
  float out[kBlock];
  map.shadowed(r, out);
  for (size_t i = 0; i < kBlock; ++i)
    EXPECT_EQ(out[i], i < std::size(strange) ? 0 : 1) << i;
}

} // namespace
} // namespace render::testing
