// Samples in other spaces: gradients still foretell the same values.
#include "render/caches/cache_space.h"

#include <gtest/gtest.h>

#include <cmath>

namespace render {
namespace {

/// Turned about x by 0.4, scaled by `scale` (x by `scale * mirror`), then moved.
Matrix4 placed(float scale, float mirror = 1) {
  Matrix4 m;
  const float c = std::cos(0.4f), s = std::sin(0.4f);
  m(0, 0) = scale * mirror;
  m(1, 1) = m(2, 2) = scale * c;
  m(1, 2) = scale * s;
  m(2, 1) = -scale * s;
  m(3, 0) = 5;
  m(3, 1) = -2;
  return m;
}

HemisphereSample sample() {
  HemisphereSample s;
  s.value = {0.5f, 1, 2, 3, 0, 0, 0, 0, 0.6f, 0.8f};
  s.move[0] = {0.1f, -0.2f, 0.3f};
  s.turn[0] = {-0.05f, 0.15f, 0.02f};
  s.distance = 2;
  return s;
}

TEST(CacheSpace, moves_foretell_the_same) {
  const CacheSpace space(placed(3));
  const HemisphereSample s = sample(), there = space.sample_to(s);
  const Vec3 from(1, 2, 3), to(1.2f, 1.9f, 3.3f);
  EXPECT_NEAR(glm::dot(there.move[0], space.point_to(to) - space.point_to(from)),
              glm::dot(s.move[0], to - from), 1e-5f);
  EXPECT_NEAR(there.distance, 6, 1e-5f);
  EXPECT_NEAR(space.length_to(1.5f), 4.5f, 1e-5f);
}

TEST(CacheSpace, turns_foretell_the_same_in_mirrors_too) {
  for (float mirror : {1.0f, -1.0f}) {
    const CacheSpace space(placed(3, mirror));
    const HemisphereSample s = sample(), there = space.sample_to(s);
    const Vec3 n(0, 0, 1), turned = glm::normalize(Vec3(0.05f, -0.03f, 1));
    EXPECT_NEAR(glm::dot(there.turn[0], glm::cross(space.normal_to(n), space.normal_to(turned))),
                glm::dot(s.turn[0], glm::cross(n, turned)), 1e-5f)
        << mirror;
  }
}

TEST(CacheSpace, there_and_back) {
  const CacheSpace space(placed(0.25f, -1));
  const HemisphereSample s = sample(), back = space.sample_from(space.sample_to(s));
  for (size_t c = 0; c < HemisphereSample::kValues; ++c)
    EXPECT_NEAR(back.value[c], s.value[c], 1e-5f);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(back.move[0][c], s.move[0][c], 1e-5f);
    EXPECT_NEAR(back.turn[0][c], s.turn[0][c], 1e-5f);
  }
  EXPECT_NEAR(back.distance, s.distance, 1e-5f);
}

TEST(CacheSpace, normals_stay_across_surfaces_of_flattened_spaces) {
  Matrix4 flat;
  flat(1, 1) = 0.2f;
  const CacheSpace space(flat);
  const Vec3 n = space.normal_to(glm::normalize(Vec3(1, 1, 0))),
             along = transform_vector(flat, Vec3(1, -1, 0));
  EXPECT_NEAR(glm::dot(n, along), 0, 1e-6f);
  EXPECT_NEAR(glm::length(n), 1, 1e-6f);
}

} // namespace
} // namespace render
