// The sample buffer by itself: coverage of micropolygons, shared edges, compositing with known answers.
#include "render/hider/sample_buffer.h"
#include "tests/render/render_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace render {
namespace {

SamplingSettings settings(int samples = 8) {
  SamplingSettings s;
  s.size = {samples, samples, true};
  s.reconstruction.filter = {FilterKind::kBox, 1, 1};
  return s;
}

/// One micropolygon from four raster points (u fastest).
ShadedGrid quad(const std::array<Vec3, 4>& p, Color Ci, Color Oi) {
  ShadedGrid g;
  g.nu = g.nv = 2;
  g.position = Vec3Planes(4);
  for (size_t k = 0; k < 4; ++k)
    g.position.set(k, p[k]);
  g.Ci = Vec3Planes(4, Ci);
  g.Oi = Vec3Planes(4, Oi);
  g.hidden = {0};
  return g;
}

/// A rectangle that covers the test image at depth z.
ShadedGrid sheet(float z, Color Ci, Color Oi) {
  return quad({Vec3(-9, -9, z), Vec3(99, -9, z), Vec3(-9, 99, z), Vec3(99, 99, z)}, Ci, Oi);
}

Image drawn(const std::vector<ShadedGrid>& grids, const SamplingSettings& s = settings(), int size = 4) {
  Image image({0, 0, size, size}, static_cast<int>(s.aov_floats()));
  SampleBuffer buffer(s);
  buffer.begin(image.rect);
  for (const ShadedGrid& g : grids)
    buffer.draw(g);
  buffer.finish(image);
  return image;
}

const Color kWhite(1.0f), kBlack(0.0f);

TEST(Hider, half_plane_covers_its_area) {
  // The edge runs through the pixel (1,1) from (1, 1.25) to (2, 1.75): half of it.
  Image i = drawn(
      {quad({Vec3(-9, -3.75f, 1), Vec3(11, 6.25f, 1), Vec3(-9, 50, 1), Vec3(11, 60, 1)}, kWhite, kWhite)},
      settings(16));
  EXPECT_NEAR(i.at(Image::kAlpha, 1, 1), 0.5f, 0.01f);
  EXPECT_EQ(i.at(Image::kAlpha, 1, 0), 0);
  EXPECT_EQ(i.at(Image::kAlpha, 1, 3), 1);
}

TEST(Hider, neighbours_share_edges_without_gap_or_overlap) {
  // Half-transparent fans around a centre: a sample hit twice would be 0.75 opaque, one missed 0.
  std::vector<ShadedGrid> grids;
  Vec3 centre(2.013f, 1.987f, 1), ring[9];
  for (int k = 0; k <= 8; ++k) {
    float a = 0.3f + static_cast<float>(k % 8) * kPi / 4;
    ring[k] = {2 + 9 * std::cos(a), 2 + 9 * std::sin(a), 1};
  }
  for (int k = 0; k < 8; k += 2)
    grids.push_back(quad({centre, ring[k], ring[k + 2], ring[k + 1]}, kWhite * 0.5f, kWhite * 0.5f));
  SamplingSettings s = settings(16);
  for (bool jitter : {true, false}) {
    s.size.jitter = jitter;
    Image i = drawn(grids, s);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        EXPECT_FLOAT_EQ(i.at(Image::kAlpha, x, y), 0.5f);
  }
}

TEST(Hider, samples_on_an_edge_belong_to_one_side) {
  // Without jitter the samples of odd counts lie exactly on x = 1.5 and y = 1.5.
  SamplingSettings s = settings(1);
  s.size.jitter = false;
  auto half = [&](float x0, float x1) {
    return quad({Vec3(x0, -1, 1), Vec3(x1, -1, 1), Vec3(x0, 9, 1), Vec3(x1, 9, 1)}, kWhite * 0.5f,
                kWhite * 0.5f);
  };
  Image i = drawn({half(-1, 1.5f), half(1.5f, 9)}, s);
  EXPECT_FLOAT_EQ(i.at(Image::kAlpha, 1, 1), 0.5f);
}

TEST(Hider, nearest_opaque_surface_wins_in_any_order) {
  ShadedGrid red = sheet(2, {1, 0, 0}, kWhite), green = sheet(1, {0, 1, 0}, kWhite);
  for (const auto& order : {std::vector{red, green}, std::vector{green, red}}) {
    Image i = drawn(order);
    EXPECT_EQ(i.at(0, 1, 1), 0);
    EXPECT_EQ(i.at(1, 1, 1), 1);
    EXPECT_EQ(i.at(Image::kZ, 1, 1), 1);
  }
}

TEST(Hider, transparent_surfaces_composite_front_to_back) {
  // Ci is premultiplied: 0.5 red over 0.25 green over opaque blue.
  ShadedGrid a = sheet(1, {0.5f, 0, 0}, Color(0.5f)), b = sheet(2, {0, 0.25f, 0}, Color(0.25f)),
             c = sheet(3, {0, 0, 1}, kWhite);
  for (const auto& order : {std::vector{a, b, c}, std::vector{c, b, a}, std::vector{b, c, a}}) {
    Image i = drawn(order);
    EXPECT_FLOAT_EQ(i.at(0, 2, 2), 0.5f);
    EXPECT_FLOAT_EQ(i.at(1, 2, 2), 0.5f * 0.25f);
    EXPECT_FLOAT_EQ(i.at(2, 2, 2), 0.5f * 0.75f);
    EXPECT_FLOAT_EQ(i.at(Image::kAlpha, 2, 2), 1);
  }
  Image i = drawn({b, a});
  EXPECT_FLOAT_EQ(i.at(Image::kAlpha, 0, 0), 1 - 0.5f * 0.75f);
}

TEST(Hider, many_layers_composite_in_the_order_of_their_depths) {
  // Few and many take different ways to their order. Two at each depth: the one drawn first is in front.
  for (int count : {7, 90}) {
    std::vector<ShadedGrid> grids;
    std::vector<std::pair<float, Color>> layers;
    for (int k = 0; k < count; ++k) {
      const float z = 1 + static_cast<float>((k * 37 % count) / 2), x = static_cast<float>(k);
      layers.emplace_back(z, 0.05f * Color(x / 90, std::fmod(x, 2.0f), std::fmod(x, 3.0f)));
      grids.push_back(sheet(z, layers.back().second, Color(0.05f)));
      grids.back().smooth = k % 2 == 0;
    }
    std::stable_sort(layers.begin(), layers.end(), [](auto& a, auto& b) { return a.first < b.first; });
    Color expected(0.0f);
    float through = 1;
    for (const auto& [z, Ci] : layers) {
      expected += through * Ci;
      through *= 0.95f;
    }
    const Image i = drawn(grids);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(i.at(c, 1, 2), expected[c], 1e-6f) << count;
    EXPECT_NEAR(i.at(Image::kAlpha, 1, 2), 1 - through, 1e-5f) << count;
  }
}

TEST(Hider, coloured_opacity_filters_each_component) {
  Image i = drawn({sheet(1, kBlack, {1, 0, 0.5f}), sheet(2, kWhite, kWhite)});
  EXPECT_FLOAT_EQ(i.at(0, 0, 0), 0);
  EXPECT_FLOAT_EQ(i.at(1, 0, 0), 1);
  EXPECT_FLOAT_EQ(i.at(2, 0, 0), 0.5f);
}

TEST(Hider, light_without_opacity_adds) {
  Image i = drawn({sheet(1, {0.25f, 0.25f, 0.25f}, kBlack), sheet(2, {0.5f, 0.5f, 0.5f}, kWhite)});
  EXPECT_FLOAT_EQ(i.at(0, 0, 0), 0.75f);
}

TEST(Hider, matte_cuts_a_hole) {
  ShadedGrid hole = sheet(1, kWhite, kWhite);
  hole.matte = true;
  Image i = drawn({hole, sheet(2, kWhite, kWhite)});
  EXPECT_EQ(i.at(0, 0, 0), 0);
  EXPECT_EQ(i.at(Image::kAlpha, 0, 0), 0);
  ShadedGrid half = sheet(1, kWhite, kWhite * 0.5f);
  half.matte = true;
  i = drawn({half, sheet(2, kWhite, kWhite)});
  EXPECT_FLOAT_EQ(i.at(Image::kAlpha, 0, 0), 0.5f);
}

TEST(Hider, smooth_and_constant_shading) {
  ShadedGrid g = sheet(1, kWhite, kWhite);
  g.Ci.set(0, kBlack);
  g.Ci.set(2, kBlack);
  EXPECT_EQ(drawn({g}).at(0, 2, 2), 0);
  g.smooth = true;
  EXPECT_NEAR(drawn({g}, settings(16)).at(0, 2, 2), (2.5f + 9) / 108, 1e-3f);
}

TEST(Hider, clipping_planes_cut_within_a_micropolygon) {
  SamplingSettings s = settings(16);
  s.near_plane = 2;
  // z runs from 0 at x = 0 to 4 at x = 4: the left half is too near.
  Image i = drawn({quad({Vec3(0, -1, 0), Vec3(4, -1, 4), Vec3(0, 9, 0), Vec3(4, 9, 4)}, kWhite, kWhite)}, s);
  EXPECT_EQ(i.at(Image::kAlpha, 1, 1), 0);
  EXPECT_EQ(i.at(Image::kAlpha, 2, 1), 1);
}

TEST(Hider, painted_grids_look_as_those_drawn_hit_by_hit) {
  // Folded, thin and large micropolygons over each other, smooth and not; opaque, half-transparent, partly
  // both and not there at all.
  std::mt19937 random(5);
  std::uniform_real_distribution<float> at(-2, 18), depth(1, 9), shade(0, 1);
  SamplingSettings s = settings(3);
  s.reconstruction.filter = {FilterKind::kGaussian, 2, 2};
  s.reconstruction.aovs = {{"heat", 2, 0, AovChannel::Source::kVariable, {}}};
  s.near_plane = 2;
  s.far_plane = 8.5f;
  std::vector<ShadedGrid> grids;
  for (int n = 0; n < 60; ++n) {
    ShadedGrid& g = grids.emplace_back();
    g.nu = 4;
    g.nv = 3;
    g.smooth = n % 2 == 0;
    g.aov_floats = 2;
    g.opaque = true;
    g.hidden.assign(6, ShadedGrid::kDrawn);
    g.hidden[static_cast<size_t>(n % 6)] = ShadedGrid::kNotDrawn;
    g.position = g.Ci = Vec3Planes(12);
    g.Oi = Vec3Planes(12, kWhite);
    Vec3 corner(at(random), at(random), depth(random));
    for (size_t k = 0; k < 12; ++k) {
      g.position.set(k, corner + Vec3(k % 4, k / 4, 0) + Vec3(at(random), at(random), depth(random)) * 0.1f);
      g.Ci.set(k, {shade(random), shade(random), shade(random)});
      g.aov.insert(g.aov.end(), {shade(random), shade(random)});
    }
  }
  // A clipping plane makes the hider look at each hit, even if it is behind the eye.
  SamplingSettings slow = s;
  Camera camera{Options()};
  slow.camera = &camera;
  slow.clipping_planes = {{Vec3(0, 0, -1), Vec3(0, 0, -1)}};
  testing::expect_alike(drawn(grids, s, 16), drawn(grids, slow, 16));
  for (size_t n = 0; n < grids.size(); ++n) {
    ShadedGrid& g = grids[n];
    g.opaque = n % 3 == 0;
    for (size_t k = 0; k < 12 && n % 3 > 0; ++k) {
      if ((k + n) % 4 == 0) g.Oi.set(k, Color(shade(random), 1, shade(random)));
      if (n % 7 != 0 && k > 4) continue;
      g.Oi.set(k, kBlack);
      if (n % 2 == 1) g.Ci.set(k, kBlack);
    }
  }
  testing::expect_alike(drawn(grids, s, 16), drawn(grids, slow, 16));
}

TEST(Hider, what_is_painted_over_a_hole_is_seen) {
  ShadedGrid hole = sheet(2, kWhite, kWhite), front = sheet(1, {1, 0.5f, 0}, kWhite);
  hole.matte = true;
  front.opaque = true;
  for (const auto& order : {std::vector{hole, front}, std::vector{front, hole}}) {
    Image i = drawn(order);
    EXPECT_EQ(i.at(1, 1, 1), 0.5f);
    EXPECT_EQ(i.at(Image::kAlpha, 1, 1), 1);
  }
}

TEST(Hider, what_is_behind_all_is_hidden_once_all_samples_are_closed) {
  SampleBuffer b(settings());
  b.begin({0, 0, 4, 4});
  EXPECT_FALSE(b.hides(1e9f));
  b.draw(sheet(5, kWhite, kWhite * 0.5f));
  EXPECT_FALSE(b.hides(1e9f));
  b.draw(sheet(3, kWhite, kWhite));
  for (int twice = 0; twice < 2; ++twice) {
    EXPECT_FALSE(b.hides(3));
    EXPECT_TRUE(b.hides(3.01f));
  }
  b.draw(quad({Vec3(0, 0, 2), Vec3(4, 0, 2), Vec3(0, 3, 2), Vec3(4, 3, 2)}, kWhite, kWhite));
  EXPECT_FALSE(b.hides(2.5f));
  b.draw(sheet(2, kWhite, kWhite));
  EXPECT_TRUE(b.hides(2.5f));
  EXPECT_FALSE(b.hides(2));
  b.begin({4, 0, 8, 4});
  EXPECT_FALSE(b.hides(2.5f));
}

TEST(Hider, what_is_behind_is_hidden_only_where_something_is_in_front) {
  SampleBuffer b(settings());
  b.begin({8, 0, 12, 4});
  EXPECT_FALSE(b.hides({8, 0}, {9, 1}, 1e9f));
  // The left half of the bucket, at depths from 2 to 4.
  b.draw(quad({Vec3(0, -9, 2), Vec3(10, -9, 2), Vec3(0, 99, 4), Vec3(10, 99, 4)}, kWhite, kWhite));
  EXPECT_TRUE(b.hides({8, 0}, {9.9f, 4}, 4.1f));
  EXPECT_FALSE(b.hides({8, 0}, {9.9f, 4}, 2.05f));
  EXPECT_FALSE(b.hides({8, 0}, {10.2f, 4}, 4.1f));
  EXPECT_FALSE(b.hides({11, 2}, {11, 2}, 4.1f));
  EXPECT_TRUE(b.hides({-99, -99}, {9.9f, 99}, 4.1f)); // of other buckets nothing is known here
  EXPECT_TRUE(b.hides({13, 0}, {14, 4}, 1));
  b.draw(sheet(3, kWhite * 0.5f, kWhite * 0.5f));
  EXPECT_FALSE(b.hides({8, 0}, {12, 4}, 4.1f));
  b.draw(sheet(3, kWhite, kWhite));
  EXPECT_TRUE(b.hides({8, 0}, {12, 4}, 3.1f));
}

TEST(SamplePattern, times_belong_to_their_strata) {
  // Of so many samples some come so near to the end of their stratum that sums are rounded to it.
  constexpr int kSide = 256;
  SamplePattern pattern({8, 8, true}, true, false);
  pattern.cover({0, 0, kSide, kSide});
  const auto n = static_cast<float>(pattern.strata());
  size_t outside = 0;
  for (int s = 0; s < pattern.strata(); ++s)
    for (size_t pixel = 0; pixel < size_t{kSide} * kSide; ++pixel) {
      const float time = pattern.time(pattern.of_stratum(s)[pixel]);
      outside += time < static_cast<float>(s) / n || time >= static_cast<float>(s + 1) / n;
    }
  EXPECT_EQ(outside, 0u);
}

TEST(SamplePattern, knows_small_places_without_samples) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-70, 70), length(0, 0.8f);
  for (const SampleGridSize& size :
       {SampleGridSize{2, 3}, SampleGridSize{1, 1}, SampleGridSize{4, 4, false}}) {
    SamplePattern pattern(size, false, false), near(size, false, false);
    int empty = 0;
    for (int round = 0; round < 2000; ++round) {
      const Vec2 low(place(random), place(random)), high = low + Vec2(length(random), length(random));
      const int x = static_cast<int>(std::floor(low.x)), y = static_cast<int>(std::floor(low.y));
      near.cover({x, y, x + 2, y + 2});
      bool has = false;
      for (size_t k = 0; k < near.count(); ++k)
        has = has || (near.at(k).x >= low.x && near.at(k).x <= high.x && near.at(k).y >= low.y &&
                      near.at(k).y <= high.y);
      if (has) {
        EXPECT_TRUE(pattern.may_have(low, high));
      }
      empty += !pattern.may_have(low, high);
      // It may be wrong by a thousandth of a pixel.
      if (!has && pattern.may_have(low, high)) {
        EXPECT_TRUE(high.x - low.x > 0.5f || high.y - low.y > 0.5f ||
                    !pattern.may_have(low + 2e-3f, high - 2e-3f));
      }
    }
    EXPECT_GT(empty, 200);
  }
  const SamplePattern pattern({1, 1}, false, false);
  EXPECT_TRUE(pattern.may_have({-1e9f, 0}, {1e9f, 0}));
  for (float far : {1e9f, -1e9f, 3e10f, -3e10f, 1e38f, -1e38f, std::nanf("")})
    for (float near : {0.0f, far}) {
      EXPECT_TRUE(pattern.may_have({far, near}, {far, near}));
      EXPECT_TRUE(pattern.may_have({near, far}, {near, far}));
    }
}

TEST(Hider, an_aov_shows_the_nearest_surface) {
  SamplingSettings s = settings();
  s.reconstruction.aovs = {{"heat", 1, 0, AovChannel::Source::kVariable, {}}};
  ShadedGrid a = sheet(1, kWhite * 0.5f, kWhite * 0.5f), b = sheet(2, kWhite, kWhite);
  a.aov_floats = b.aov_floats = 1;
  a.aov.assign(4, 7.0f);
  b.aov.assign(4, 9.0f);
  EXPECT_FLOAT_EQ(drawn({a, b}, s).at(Image::kAov, 0, 0), 7);
  EXPECT_FLOAT_EQ(drawn({b}, s).at(Image::kAov, 0, 0), 9);
}

} // namespace
} // namespace render
