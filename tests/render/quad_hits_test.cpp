// Samples in micropolygons, and filters from tables, against one sample at a time in double precision.
#include "render/hider/quad_hits.h"

#include "render/hider/sample_pattern.h"
#include "render/hider/strata_samples.h"
#include "render/hider/window_weights.h"

#include <gtest/gtest.h>

#include <random>

namespace render {
namespace {

constexpr SampleGridSize kSize{3, 3, true};
constexpr PixelRect kArea{0, 0, 5, 4};

SampleField field_of(const SamplePattern& pattern) {
  SampleField out{pattern.x(), pattern.y(), nullptr, static_cast<size_t>(pattern.width())};
  out.time = pattern.times();
  return out;
}

/// What the lens does to each sample, for a lens so large.
struct LensPlanes {
  std::vector<float> x, y;

  LensPlanes(const SamplePattern& pattern, float size)
      : x(pattern.count() + SampleField::kPadding), y(x.size()) {
    for (size_t k = 0; k < pattern.count(); ++k) {
      x[k] = pattern.lens(k).x * size;
      y[k] = pattern.lens(k).y * size;
    }
  }
};

/// Twice the signed area of a triangle.
double area(Vec2 a, Vec2 b, Vec2 c) {
  return (static_cast<double>(b.x) - static_cast<double>(a.x)) *
             (static_cast<double>(c.y) - static_cast<double>(a.y)) -
         (static_cast<double>(b.y) - static_cast<double>(a.y)) *
             (static_cast<double>(c.x) - static_cast<double>(a.x));
}

/// Whether p is inside the triangle, or too near to an edge to tell.
enum class Where { kInside, kOutside, kEdge };
Where locate(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  double s[3] = {area(a, b, p), area(b, c, p), area(c, a, p)};
  for (double x : s)
    if (std::abs(x) < 1e-4) return Where::kEdge;
  bool positive = s[0] > 0;
  return (s[1] > 0) == positive && (s[2] > 0) == positive ? Where::kInside : Where::kOutside;
}

struct Found {
  std::vector<QuadHit> hits;
  const QuadHit* of(size_t sample, QuadPart part) const {
    for (const QuadHit& h : hits)
      if (h.sample == sample && h.part == part) return &h;
    return nullptr;
  }
};

void expect_hit(const Found& found, size_t sample, QuadPart part, Vec2 at, const Vec3& a, const Vec3& b,
                const Vec3& c) {
  const QuadHit* hit = found.of(sample, part);
  switch (locate(at, Vec2(a), Vec2(b), Vec2(c))) {
  case Where::kOutside: EXPECT_FALSE(hit); return;
  case Where::kEdge: return;
  case Where::kInside: break;
  }
  ASSERT_TRUE(hit) << sample;
  double total = area(Vec2(a), Vec2(b), Vec2(c));
  double w[3] = {area(Vec2(b), Vec2(c), at) / total, area(Vec2(c), Vec2(a), at) / total,
                 area(Vec2(a), Vec2(b), at) / total};
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(hit->weights[i], w[i], 2e-3);
  EXPECT_NEAR(hit->z,
              w[0] * static_cast<double>(a.z) + w[1] * static_cast<double>(b.z) +
                  w[2] * static_cast<double>(c.z),
              0.02);
}

TEST(QuadHits, random_quads_agree_with_one_sample_at_a_time) {
  SamplePattern pattern(kSize, false, false);
  pattern.cover(kArea);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> x(-1, 6), y(-1, 5), z(1, 3);
  SampleWindow all{0, static_cast<size_t>(pattern.width()), 0, static_cast<size_t>(pattern.height())};
  std::vector<QuadHit> room(2 * all.count() + SampleField::kPadding);
  for (int round = 0; round < 300; ++round) {
    Vec3 p[4];
    for (Vec3& corner : p)
      corner = {x(random), y(random), z(random)};
    Found both{{room.begin(), room.begin() + static_cast<std::ptrdiff_t>(
                                                 quad_hits(p, true, field_of(pattern), all, room.data()))}};
    for (size_t k = 0; k < pattern.count(); ++k) {
      expect_hit(both, k, QuadPart::kFirst, pattern.at(k), p[0], p[1], p[3]);
      expect_hit(both, k, QuadPart::kSecond, pattern.at(k), p[0], p[3], p[2]);
    }
    Found one{{room.begin(), room.begin() + static_cast<std::ptrdiff_t>(
                                                quad_hits(p, false, field_of(pattern), all, room.data()))}};
    for (size_t k = 0; k < pattern.count(); ++k) {
      EXPECT_EQ(one.of(k, QuadPart::kFirst) != nullptr, both.of(k, QuadPart::kFirst) != nullptr);
      EXPECT_EQ(one.of(k, QuadPart::kSecond) != nullptr,
                both.of(k, QuadPart::kSecond) && !both.of(k, QuadPart::kFirst));
    }
  }
}

TEST(QuadHits, what_is_not_nearer_than_the_limit_is_none) {
  SamplePattern pattern(kSize, false, false);
  pattern.cover(kArea);
  std::vector<float> limit(pattern.count() + SampleField::kPadding, 2.0f);
  limit[17] = 3;
  SampleField field = field_of(pattern);
  field.limit = limit.data();
  Vec3 p[4] = {{-1, -1, 2}, {9, -1, 2}, {-1, 9, 2}, {9, 9, 2}};
  SampleWindow all{0, static_cast<size_t>(pattern.width()), 0, static_cast<size_t>(pattern.height())};
  std::vector<QuadHit> room(2 * all.count() + SampleField::kPadding);
  ASSERT_EQ(quad_hits(p, false, field, all, room.data()), 1u);
  EXPECT_EQ(room[0].sample, 17u);
}

TEST(QuadHits, moving_quads_are_where_they_are_at_each_samples_time) {
  SamplePattern pattern(kSize, true, true);
  pattern.cover(kArea);
  SampleField field = field_of(pattern);
  const LensPlanes lens(pattern, 0.5f);
  field.lens_x = lens.x.data();
  field.lens_y = lens.y.data();
  field.focus = 0.5f;
  StrataSamples strata;
  strata.sort(pattern, field);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> x(-1, 6), y(-1, 5), z(1, 3);
  SampleWindow pixels{0, 5, 0, 4};
  std::vector<QuadHit> room(2 * pixels.count() + SampleField::kPadding);
  for (int round = 0; round < 50; ++round) {
    MovingQuad quad;
    // Not all of a stratum: samples before t0 and after t1 are other segments'.
    quad.t0 = 0.3f;
    quad.t1 = 0.8f;
    quad.low = Vec2(-99);
    quad.high = Vec2(99);
    for (size_t c = 0; c < 4; ++c) {
      quad.from[c] = {x(random), y(random), z(random)};
      quad.to[c] = round % 3 == 0 ? quad.from[c] : Vec3(x(random), y(random), z(random));
    }
    for (int s = 0; s < pattern.strata(); ++s) {
      StratumField stratum = strata.of(s);
      stratum.focus = field.focus;
      size_t count = moving_hits(quad, true, stratum, pixels, room.data());
      Found found{{room.begin(), room.begin() + static_cast<std::ptrdiff_t>(count)}};
      for (size_t pixel = 0; pixel < pixels.count(); ++pixel) {
        size_t k = pattern.of_stratum(s)[pixel];
        float t = pattern.time(k);
        if (t < quad.t0 || t >= quad.t1) {
          EXPECT_FALSE(found.of(k, QuadPart::kFirst) || found.of(k, QuadPart::kSecond));
          continue;
        }
        Vec3 p[4];
        for (size_t c = 0; c < 4; ++c) {
          p[c] = glm::mix(quad.from[c], quad.to[c], (t - quad.t0) / (quad.t1 - quad.t0));
          p[c] += Vec3(Vec2(lens.x[k], lens.y[k]) * (field.focus - 1 / p[c].z), 0);
        }
        expect_hit(found, k, QuadPart::kFirst, pattern.at(k), p[0], p[1], p[3]);
        expect_hit(found, k, QuadPart::kSecond, pattern.at(k), p[0], p[3], p[2]);
      }
    }
  }
}

TEST(QuadHits, slow_ones_are_those_of_all_strata) {
  SamplePattern pattern(kSize, true, true);
  pattern.cover(kArea);
  const LensPlanes lens(pattern, 2.0f);
  std::mt19937 random(12);
  std::uniform_real_distribution<float> x(-1, 6), y(-1, 5), z(1, 3), step(-1, 1);
  for (int round = 0; round < 50; ++round) {
    SampleField field{pattern.x(), pattern.y(), nullptr, static_cast<size_t>(pattern.width())};
    field.time = pattern.times();
    if (round % 2 == 0) {
      field.lens_x = lens.x.data();
      field.lens_y = lens.y.data();
    }
    field.focus = 0.6f;
    StrataSamples strata;
    strata.sort(pattern, field);
    MovingQuad quad;
    quad.t0 = round % 3 == 0 ? 0.25f : 0;
    quad.t1 = round % 3 == 1 ? 0.75f : 1;
    quad.low = Vec2(-99);
    quad.high = Vec2(99);
    for (size_t c = 0; c < 4; ++c) {
      quad.from[c] = {x(random), y(random), z(random)};
      quad.to[c] = quad.from[c];
      if (round % 5 > 0) quad.to[c] += Vec3(step(random), step(random), 0.3f * step(random));
    }
    const SampleWindow all{0, static_cast<size_t>(pattern.width()), 0, static_cast<size_t>(pattern.height())};
    std::vector<QuadHit> slow(2 * all.count() + SampleField::kPadding), listed;
    slow.resize(slow_hits(quad, true, field, all, slow.data()));
    std::vector<QuadHit> room(2 * pattern.count() + SampleField::kPadding);
    const SampleWindow pixels{0, static_cast<size_t>(kArea.width()), 0, static_cast<size_t>(kArea.height())};
    for (int s = 0; s < pattern.strata(); ++s) {
      StratumField stratum = strata.of(s);
      stratum.focus = field.focus;
      size_t count = moving_hits(quad, true, stratum, pixels, room.data());
      listed.insert(listed.end(), room.begin(), room.begin() + static_cast<std::ptrdiff_t>(count));
    }
    auto order = [](const QuadHit& a, const QuadHit& b) {
      return std::pair(a.sample, a.part) < std::pair(b.sample, b.part);
    };
    std::sort(slow.begin(), slow.end(), order);
    std::sort(listed.begin(), listed.end(), order);
    ASSERT_EQ(slow.size(), listed.size()) << round;
    for (size_t k = 0; k < slow.size(); ++k) {
      EXPECT_EQ(slow[k].sample, listed[k].sample);
      EXPECT_EQ(slow[k].part, listed[k].part);
      EXPECT_EQ(slow[k].z, listed[k].z);
      EXPECT_EQ(slow[k].weights[1], listed[k].weights[1]);
    }
  }
}

TEST(WindowWeights, are_those_of_the_filter) {
  SamplePattern pattern(kSize, false, false);
  pattern.cover(kArea);
  for (FilterKind kind : {FilterKind::kBox, FilterKind::kTriangle, FilterKind::kGaussian, FilterKind::kSinc,
                          FilterKind::kCatmullRom, FilterKind::kMitchell, FilterKind::kBlackmanHarris,
                          FilterKind::kDisk, FilterKind::kLanczos})
    for (float width : {1.0f, 2.5f, 4.0f}) {
      PixelFilter filter{kind, width, width + 1};
      WindowWeights weights(filter, kSize);
      const FilterWindow& window = weights.window();
      for (int x : {2, 66}) { // of two tiles
        const int y = 1;
        pattern.cover({x - 4, y - 4, x + 5, y + 5});
        Vec2 centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        // Of a block, of which the third pixel is looked at.
        const float* got = weights.at(SampleColumns::block_of(x), y, pattern) + 2;
        float sum = 0;
        for (int j = window.j0; j < window.j1; ++j)
          for (int i = window.i0; i < window.i1; ++i, got += WindowWeights::kBlock) {
            Vec2 at = pattern.at(static_cast<size_t>((12 + j) * pattern.width() + 12 + i)) - centre;
            EXPECT_NEAR(*got, filter_weight(filter, at.x, at.y), 2e-5f)
                << static_cast<int>(kind) << ' ' << width;
            sum += *got;
          }
        EXPECT_NEAR(*got, sum, 1e-6f * std::max(1.0f, sum));
      }
    }
}

TEST(WindowWeights, are_those_of_a_mean_where_the_filter_misses_all_samples) {
  SamplePattern pattern(kSize, false, false);
  WindowWeights weights({FilterKind::kBox, 1e-3f, 1e-3f}, kSize);
  const FilterWindow& window = weights.window();
  ASSERT_EQ(window.count(), 9u);
  const float* got = weights.at(0, 0, pattern);
  for (size_t k = 0; k < 9; ++k)
    EXPECT_EQ(got[k * WindowWeights::kBlock + 5], 1);
  EXPECT_EQ(got[9 * WindowWeights::kBlock + 5], 9);
}

TEST(WindowWeights, means_are_those_of_the_samples_in_the_window) {
  const PixelRect area{-3, 0, 30, 9};
  SamplePattern pattern(kSize, false, false);
  pattern.cover(area);
  const auto row = static_cast<size_t>(pattern.width());
  for (float width : {1.0f, 2.0f, 3.5f})
    for (int x : {0, 4, 15, 16, 26}) {
      PixelFilter filter{FilterKind::kGaussian, width, width};
      WindowWeights weights(filter, kSize);
      const FilterWindow& window = weights.window();
      SampleColumns columns(kSize);
      columns.begin(area);
      std::vector<std::ptrdiff_t> offsets;
      // What lies beside the window does not count, whatever it is.
      std::vector<float> ramp(pattern.count(), NAN), ones(pattern.count(), 1.0f);
      double sum = 0, total = 0;
      for (int j = window.j0; j < window.j1; ++j)
        for (int i = window.i0; i < window.i1; ++i) {
          offsets.push_back(columns.offset(i, j));
          size_t k = static_cast<size_t>(12 + j) * row + static_cast<size_t>((x - area.x0) * 3 + i);
          Vec2 at = pattern.at(k) - Vec2(static_cast<float>(x) + 0.5f, 4.5f);
          double w = static_cast<double>(filter_weight(filter, at.x, at.y));
          ramp[k] = pattern.at(k).x + 2 * pattern.at(k).y;
          total += w;
          sum += w * static_cast<double>(ramp[k]);
        }
      const int block = SampleColumns::block_of(x);
      const float* planes[4];
      for (size_t p = 0; p < 4; ++p)
        planes[p] = columns.sorted(p % 2 == 0 ? ones.data() : ramp.data()) + columns.place(block, 4);
      float means[4][WindowWeights::kBlock];
      weights.means(planes, offsets, weights.at(block, 4, pattern), means[0]);
      const int lane = x - block;
      EXPECT_EQ(means[0][lane], 1);
      EXPECT_EQ(means[2][lane], 1);
      EXPECT_NEAR(means[1][lane], sum / total, 1e-4);
      EXPECT_EQ(means[3][lane], means[1][lane]);
    }
}

} // namespace
} // namespace render
