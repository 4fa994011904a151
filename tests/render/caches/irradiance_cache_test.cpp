// What records of an irradiance cache come to between them, against functions that are known.
#include "render/caches/irradiance_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace render {
namespace {

using ::testing::HasSubstr;

IrradianceRecord record(Vec3 P, Vec3 N, float occlusion, float radius) {
  IrradianceRecord r;
  r.P = P;
  r.N = N;
  r.radius = radius;
  r.holds = kOcclusion;
  r.sample.value[0] = occlusion;
  return r;
}

/// n x n records in [0, 1]^2 of the plane z, with values f(x, y).
template <class F>
void add_plane(std::vector<IrradianceRecord>& to, int n, float z, Vec3 N, F&& f, float radius = -1) {
  const float step = 1 / static_cast<float>(n - 1);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float x = static_cast<float>(i) * step, y = static_cast<float>(j) * step;
      to.push_back(record({x, y, z}, N, f(x, y), radius < 0 ? 1.4143f * step : radius));
    }
}

float at(const IrradianceCache& cache, Vec3 P, Vec3 N, float otherwise = -1) {
  auto found = cache.find({P, N, kOcclusion, -1});
  return found ? found->value[0] : otherwise;
}

TEST(IrradianceCache, constants_stay_and_smooth_functions_nearly) {
  std::vector<IrradianceRecord> records;
  auto f = [](float x, float y) { return 0.5f + 0.3f * std::sin(3 * x) * std::cos(2 * y); };
  add_plane(records, 33, 0, {0, 0, 1}, f);
  const IrradianceCache cache(records);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(0.04f, 0.96f);
  for (int i = 0; i < 300; ++i) {
    const float x = place(random), y = place(random);
    EXPECT_NEAR(at(cache, {x, y, 0}, {0, 0, 1}), f(x, y), 4e-3f) << x << ' ' << y;
  }
  records.clear();
  add_plane(records, 9, 0, {0, 0, 1}, [](float, float) { return 0.37f; });
  const IrradianceCache constant(records);
  for (int i = 0; i < 100; ++i)
    EXPECT_NEAR(at(constant, {place(random), place(random), 0}, {0, 0, 1}), 0.37f, 1e-6f);
}

TEST(IrradianceCache, halving_the_distance_quarters_the_error) {
  // A smooth function, with noise of none: the order of the interpolation.
  auto f = [](float x, float y) { return x * x + y * y; };
  auto error = [&](int n) {
    std::vector<IrradianceRecord> records;
    add_plane(records, n, 0, {0, 0, 1}, f);
    const IrradianceCache cache(std::move(records));
    float worst = 0;
    for (float x = 0.3f; x < 0.7f; x += 0.0137f)
      worst = std::max(worst, std::abs(at(cache, {x, 0.5f, 0}, {0, 0, 1}) - f(x, 0.5f)));
    return worst;
  };
  EXPECT_LT(error(33), 0.35f * error(17));
}

TEST(IrradianceCache, what_changes_evenly_is_found_exactly) {
  // On places that are anywhere, not on a lattice.
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0, 1);
  std::vector<IrradianceRecord> records;
  for (int i = 0; i < 400; ++i) {
    const Vec3 P(place(random), place(random), 0);
    records.push_back(record(P, {0, 0, 1}, 0.2f + 0.5f * P.x + 0.3f * P.y, 0.15f));
  }
  const IrradianceCache cache(std::move(records));
  for (int i = 0; i < 100; ++i) {
    const float x = 0.15f + 0.7f * place(random), y = 0.15f + 0.7f * place(random);
    EXPECT_NEAR(at(cache, {x, y, 0}, {0, 0, 1}), 0.2f + 0.5f * x + 0.3f * y, 1e-5f);
  }
  // Outside, values stay among those there are.
  EXPECT_LE(at(cache, {1.05f, 0.9f, 0}, {0, 0, 1}), 1.0f);
}

TEST(IrradianceCache, there_is_nothing_where_there_is_nothing) {
  std::vector<IrradianceRecord> records;
  add_plane(records, 9, 0, {0, 0, 1}, [](float, float) { return 1.0f; });
  const IrradianceCache cache(std::move(records));
  EXPECT_EQ(at(cache, {1.3f, 0.5f, 0}, {0, 0, 1}), -1);
  EXPECT_EQ(at(cache, {0.5f, 0.5f, 0.2f}, {0, 0, 1}), -1);
  EXPECT_EQ(IrradianceCache({}).find({{0, 0, 0}, {0, 0, 1}, kOcclusion, -1}), std::nullopt);
}

TEST(IrradianceCache, the_two_sides_of_a_sheet_are_two) {
  std::vector<IrradianceRecord> records;
  add_plane(records, 9, 0, {0, 0, 1}, [](float, float) { return 0.2f; });
  add_plane(records, 9, 0, {0, 0, -1}, [](float, float) { return 0.9f; });
  const IrradianceCache cache(std::move(records));
  EXPECT_NEAR(at(cache, {0.4f, 0.6f, 0}, {0, 0, 1}), 0.2f, 1e-6f);
  EXPECT_NEAR(at(cache, {0.4f, 0.6f, 0}, {0, 0, -1}), 0.9f, 1e-6f);
  EXPECT_EQ(at(cache, {0.4f, 0.6f, 0}, {1, 0, 0}), -1); // neither
}

TEST(IrradianceCache, sheets_above_each_other_do_not_mix) {
  // Nearer to each other than the records of each.
  std::vector<IrradianceRecord> records;
  add_plane(records, 9, 0, {0, 0, 1}, [](float, float) { return 0.2f; });
  add_plane(records, 9, 0.07f, {0, 0, 1}, [](float, float) { return 0.9f; });
  const IrradianceCache cache(std::move(records));
  EXPECT_NEAR(at(cache, {0.4f, 0.6f, 0}, {0, 0, 1}), 0.2f, 1e-6f);
}

TEST(IrradianceCache, dense_records_count_more_than_sparse_ones) {
  std::vector<IrradianceRecord> records;
  add_plane(records, 3, 0, {0, 0, 1}, [](float, float) { return 0.0f; });  // 0.5 apart
  add_plane(records, 33, 0, {0, 0, 1}, [](float, float) { return 0.8f; }); // 1/32 apart
  const IrradianceCache cache(std::move(records));
  EXPECT_GT(at(cache, {0.52f, 0.52f, 0}, {0, 0, 1}), 0.78f);
}

TEST(IrradianceCache, few_records_are_enough) {
  // One, two, three on a line: no plane goes through them.
  std::vector<IrradianceRecord> records;
  for (float x : {0.0f, 0.5f, 1.0f}) {
    records.push_back(record({x, 0, 0}, {0, 0, 1}, 0.6f, 2));
    const IrradianceCache cache(records);
    for (float y : {-0.3f, 0.0f, 0.3f})
      EXPECT_NEAR(at(cache, {0.2f, y, 0}, {0, 0, 1}), 0.6f, 1e-6f) << x << ' ' << y;
  }
}

TEST(IrradianceCache, gradients_are_followed) {
  IrradianceRecord r = record({0, 0, 0}, {0, 0, 1}, 0.5f, 1);
  r.holds |= kSurroundings;
  r.sample.distance = 4;
  r.sample.move[0] = {0.1f, 0.2f, 0};
  r.sample.turn[0] = {0, 0.3f, 0};
  const IrradianceCache cache({r});
  EXPECT_NEAR(at(cache, {0.3f, -0.2f, 0}, {0, 0, 1}), 0.5f + 0.03f - 0.04f, 1e-6f);
  const Vec3 turned = glm::normalize(Vec3(0.1f, 0, 1)); // about y, right-handed
  EXPECT_NEAR(at(cache, {0, 0, 0}, turned), 0.5f + 0.3f * turned.x, 1e-5f);
}

TEST(IrradianceCache, with_gradients_a_parabola_is_found_exactly) {
  std::vector<IrradianceRecord> records;
  auto f = [](float x, float y) { return 0.3f + 0.2f * x * x + 0.1f * x * y + 0.3f * y * y; };
  add_plane(records, 9, 0, {0, 0, 1}, f);
  for (IrradianceRecord& r : records) {
    r.holds |= kSurroundings;
    r.sample.distance = 4;
    r.sample.move[0] = {0.4f * r.P.x + 0.1f * r.P.y, 0.1f * r.P.x + 0.6f * r.P.y, 0};
  }
  const IrradianceCache cache(std::move(records));
  for (float x = 0.2f; x < 0.8f; x += 0.0371f)
    for (float y = 0.2f; y < 0.8f; y += 0.0413f)
      EXPECT_NEAR(at(cache, {x, y, 0}, {0, 0, 1}), f(x, y), 1e-5f);
}

TEST(IrradianceCache, an_error_that_is_allowed_leaves_records_out) {
  IrradianceRecord r = record({0, 0, 0}, {0, 0, 1}, 0.5f, 1);
  r.holds |= kSurroundings;
  r.sample.distance = 1;
  const IrradianceCache cache({r});
  EXPECT_TRUE(cache.find({{0.3f, 0, 0}, {0, 0, 1}, kOcclusion, 0.5f}));
  EXPECT_FALSE(cache.find({{0.3f, 0, 0}, {0, 0, 1}, kOcclusion, 0.2f}));
  EXPECT_TRUE(cache.find({{0.3f, 0, 0}, {0, 0, 1}, kOcclusion, -1}));
}

TEST(IrradianceCache, records_count_for_what_they_hold) {
  IrradianceRecord with = record({0, 0, 0}, {0, 0, 1}, 0.5f, 1), without = with;
  with.holds |= kIrradiance;
  with.sample.value[2] = 7;
  without.sample.value[0] = 0;
  const IrradianceCache cache({with, without});
  EXPECT_EQ(cache.find({{0, 0, 0}, {0, 0, 1}, kOcclusion | kIrradiance, -1})->value[0], 0.5f);
  EXPECT_EQ(cache.find({{0, 0, 0}, {0, 0, 1}, kIrradiance, -1})->value[2], 7);
  EXPECT_EQ(cache.find({{0, 0, 0}, {0, 0, 1}, kOcclusion, -1})->value[0], 0.25f);
  EXPECT_FALSE(cache.find({{0, 0, 0}, {0, 0, 1}, kEnvironmentColour, -1}));
  EXPECT_EQ(cache.holds(), kOcclusion | kIrradiance);
}

TEST(IrradianceCache, radii_that_are_not_known_are_found) {
  std::vector<IrradianceRecord> records;
  add_plane(
      records, 17, 0, {0, 0, 1}, [](float x, float) { return x; }, 0);
  const IrradianceCache cache(std::move(records));
  EXPECT_NEAR(at(cache, {0.53f, 0.47f, 0}, {0, 0, 1}), 0.53f, 5e-3f);
  EXPECT_EQ(at(cache, {1.5f, 0.5f, 0}, {0, 0, 1}), -1);
}

TEST(IrradianceRecords, merging_does_not_depend_on_the_order) {
  std::mt19937 random(3);
  std::vector<IrradianceRecord> records;
  for (int i = 0; i < 60; ++i) {
    const auto x = static_cast<float>(i % 20);
    records.push_back(record({x, 0, 0}, {0, 0, 1}, std::sqrt(static_cast<float>(i)) / 8, 1));
    if (i % 7 == 0) records.back().holds |= kIrradiance, records.back().sample.value[1] = x;
  }
  const auto first = format_point_table(table_of(merged(records)));
  for (int k = 0; k < 5; ++k) {
    std::shuffle(records.begin(), records.end(), random);
    EXPECT_EQ(format_point_table(table_of(merged(records))), first);
  }
  const auto out = merged(records);
  ASSERT_EQ(out.size(), 20u);
  EXPECT_NEAR(out[1].sample.value[0], (1 + std::sqrt(21.0f) + std::sqrt(41.0f)) / 24, 1e-6f);
  EXPECT_EQ(out[1].holds, kOcclusion | kIrradiance); // of 21
  EXPECT_EQ(out[1].sample.value[1], 1);
}

TEST(IrradianceRecords, newer_ones_take_the_place_of_older_ones) {
  std::vector<IrradianceRecord> records{record({0, 0, 0}, {0, 0, 1}, 0.1f, 1),
                                        record({1, 0, 0}, {0, 0, 1}, 0.2f, 1),
                                        record({0, 0, 0}, {0, 0, 1}, 0.9f, 1)};
  const auto out = merged(records, 2);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].sample.value[0], 0.9f);
  EXPECT_EQ(out[1].sample.value[0], 0.2f);
}

TEST(IrradianceRecords, come_back_from_tables) {
  IrradianceRecord full = record({1, 2, 3}, {0, 1, 0}, 0.25f, 0.5f);
  full.holds = kOcclusion | kIrradiance | kEnvironmentDirection | kSurroundings;
  for (size_t c = 0; c < HemisphereSample::kGradients; ++c) {
    full.sample.value[c] = static_cast<float>(c);
    full.sample.move[c] = Vec3(static_cast<float>(c), 1, 2);
    full.sample.turn[c] = Vec3(3, static_cast<float>(c), 4);
  }
  full.sample.value[8] = -1;
  full.sample.distance = 8;
  const IrradianceRecord plain = record({0, 0, 0}, {1, 0, 0}, 0.75f, 0);
  auto back = records_of(table_of(std::vector{full, plain}), "x");
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ((*back)[0].P, full.P);
  EXPECT_EQ((*back)[0].N, full.N);
  EXPECT_EQ((*back)[0].holds, full.holds);
  EXPECT_EQ((*back)[0].sample.distance, 8);
  for (size_t c : {0u, 1u, 2u, 3u, 8u})
    EXPECT_EQ((*back)[0].sample.value[c], full.sample.value[c]);
  for (size_t c : {0u, 1u, 3u}) {
    EXPECT_EQ((*back)[0].sample.move[c], full.sample.move[c]);
    EXPECT_EQ((*back)[0].sample.turn[c], full.sample.turn[c]);
  }
  EXPECT_EQ((*back)[1].holds, kOcclusion);
  EXPECT_EQ((*back)[1].sample.value[0], 0.75f);
}

TEST(IrradianceRecords, what_cannot_be_is_said) {
  PointTable t = table_of(std::vector{record({0, 0, 0}, {0, 0, 1}, 0.5f, 1)});
  auto error = [&](auto&& change) {
    PointTable other = t;
    change(other);
    auto records = records_of(other, "x.icf");
    return records ? "" : records.error();
  };
  EXPECT_EQ(error([](PointTable& x) { x.kind = "photon map"; }),
            "x.icf: this is a photon map, not an irradiance cache");
  EXPECT_EQ(error([](PointTable& x) { x.columns[0].name = "Q"; }),
            "x.icf: the irradiance cache has no places: it needs columns P, N, radius and holds");
  auto value = [&](size_t column, float to) {
    return error([&](PointTable& x) { x.columns[column].values[0] = to; });
  };
  EXPECT_EQ(value(1, 5), "x.icf: point 0 of the irradiance cache cannot be"); // the normal
  EXPECT_THAT(value(2, -1), HasSubstr("point 0"));                            // the radius
  EXPECT_THAT(value(3, 1.5f), HasSubstr("point 0"));                          // what it holds
  EXPECT_THAT(value(3, 64), HasSubstr("point 0"));
}

} // namespace
} // namespace render
