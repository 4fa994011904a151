// Estimates from photons whose density is known.
#include "render/photons/photon_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace render {
namespace {

using ::testing::HasSubstr;

/// n photons anywhere in [0, 1]^2 of the plane z = 0, that bring `power` together.
void add_plane(std::vector<Photon>& to, int n, Vec3 N, Color power, unsigned seed, float z = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(0, 1);
  for (int i = 0; i < n; ++i) {
    Photon p;
    p.P = {place(random), place(random), z};
    p.N = N;
    p.direction = -N;
    p.power = power / static_cast<float>(n);
    p.radiance = power;
    to.push_back(p);
  }
}

/// The mean estimate over many places.
double mean(const PhotonMap& map, PhotonMap::Place place) {
  double sum = 0;
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i) {
      place.P = {0.2f + 0.03f * static_cast<float>(i), 0.2f + 0.03f * static_cast<float>(j), 0};
      sum += static_cast<double>(map.irradiance(place).x) / 400;
    }
  return sum;
}

TEST(PhotonMap, estimates_have_the_right_mean_however_many_photons) {
  std::vector<Photon> photons;
  add_plane(photons, 40000, {0, 0, 1}, Color(3), 1);
  const PhotonMap map(std::move(photons));
  for (size_t count : {5, 50, 500})
    EXPECT_NEAR(mean(map, {{}, {0, 0, 1}, count, kInfinity, 0}), 3, 0.09) << count;
}

TEST(PhotonMap, more_photons_make_less_noise) {
  std::vector<Photon> photons;
  add_plane(photons, 40000, {0, 0, 1}, Color(1), 2);
  const PhotonMap map(std::move(photons));
  auto deviation = [&](size_t count) {
    double sum = 0;
    for (int i = 0; i < 200; ++i) {
      const float x = 0.2f + 0.003f * static_cast<float>(i);
      sum += std::pow(
          static_cast<double>(map.irradiance({{x, 0.5f, 0}, {0, 0, 1}, count, kInfinity, 0}).x) - 1, 2);
    }
    return std::sqrt(sum / 200);
  };
  // 1 / sqrt(n), about.
  EXPECT_NEAR(deviation(50), 0.14, 0.05);
  EXPECT_LT(deviation(500), 0.09);
}

TEST(PhotonMap, sides_are_apart) {
  std::vector<Photon> photons;
  add_plane(photons, 20000, {0, 0, 1}, Color(1), 3);
  add_plane(photons, 20000, {0, 0, -1}, Color(5), 4);
  const PhotonMap map(std::move(photons));
  EXPECT_NEAR(mean(map, {{}, {0, 0, 1}, 400, kInfinity, 0}), 1, 0.05);
  EXPECT_NEAR(mean(map, {{}, {0, 0, -1}, 400, kInfinity, 0}), 5, 0.2);
  EXPECT_NEAR(mean(map, {{}, Vec3(0.0f), 400, kInfinity, 0}), 6, 0.2);
  EXPECT_EQ(map.radiance({0.5f, 0.5f, 0}, {0, 0, 1}), Color(1));
  EXPECT_EQ(map.radiance({0.5f, 0.5f, 0}, {0, 0, -1}), Color(5));
  EXPECT_EQ(map.radiance({0.5f, 0.5f, 0}, {1, 0, 0}), Color(0));
}

TEST(PhotonMap, a_distance_may_limit_the_circle) {
  std::vector<Photon> photons;
  add_plane(photons, 40000, {0, 0, 1}, Color(1), 5);
  const PhotonMap map(std::move(photons));
  EXPECT_NEAR(mean(map, {{}, {0, 0, 1}, 1000, 0.03f, 0}), 1, 0.05);
  EXPECT_EQ(map.irradiance({{0.5f, 0.5f, 1}, {0, 0, 1}, 50, 0.1f, 0}), Color(0));
  EXPECT_EQ(PhotonMap({}).irradiance({{0, 0, 0}, {0, 0, 1}, 50, kInfinity, 0}), Color(0));
}

TEST(PhotonMap, depth_leaves_photons_out) {
  std::vector<Photon> photons;
  add_plane(photons, 20000, {0, 0, 1}, Color(1), 6);
  for (size_t i = 0; i < photons.size(); ++i)
    photons[i].depth = static_cast<float>(i % 4);
  const PhotonMap map(std::move(photons));
  EXPECT_NEAR(mean(map, {{}, {0, 0, 1}, 400, kInfinity, 3}), 0.25, 0.03);
}

TEST(Photons, come_back_from_tables) {
  Photon p;
  p.P = {1, 2, 3};
  p.N = {0, 1, 0};
  p.direction = {0, -1, 0};
  p.power = {4, 5, 6};
  p.radiance = {7, 8, 9};
  p.depth = 2;
  PointTable table = table_of(std::vector{p});
  auto back = photons_of(table, "x.gpm");
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ((*back)[0].P, p.P);
  EXPECT_EQ((*back)[0].direction, p.direction);
  EXPECT_EQ((*back)[0].power, p.power);
  EXPECT_EQ((*back)[0].radiance, p.radiance);
  EXPECT_EQ((*back)[0].depth, 2);
  table.columns[1].values[1] = 3;
  EXPECT_EQ(photons_of(table, "x.gpm").error(), "x.gpm: photon 0 cannot be");
  table.columns[1].name = "M";
  EXPECT_THAT(photons_of(table, "x.gpm").error(), HasSubstr("x.gpm: the photon map needs columns P, N"));
  table.kind = "irradiance cache";
  EXPECT_EQ(photons_of(table, "x.gpm").error(), "x.gpm: this is an irradiance cache, not a photon map");
}

} // namespace
} // namespace render
