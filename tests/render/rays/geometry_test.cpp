// What rays hit, and when it is made: instances, motion, displacement, curves and points, memory, scenes gone
// wrong.
#include "tests/render/rays/ray_scene.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>

namespace render::testing {
namespace {

using slvm::Type;

const std::string kSeen = "Attribute \"visibility\" \"trace\" 1 \"transmission\" \"opaque\" ";
const std::string kCamera = "Format 200 200 1 Projection \"perspective\" \"fov\" 45 ";

TEST(RayGeometry, nothing_is_made_before_a_ray_comes_near) {
  RayScene s(kCamera + "WorldBegin " + kSeen +
             "Translate -4 0 9 Sphere 1 -1 1 360 Translate 8 0 0 "
             "Attribute \"visibility\" \"int diffuse\" 0 Sphere 1 -1 1 360 WorldEnd");
  EXPECT_EQ(s.tracer().usage().geometry.made, 0u);
  EXPECT_EQ(s.distance({{0, 5, 0}}), kInfinity);
  EXPECT_EQ(s.tracer().usage().geometry.made, 0u);
  EXPECT_NEAR(s.distance({{-4, 0, 0}}), 8, 1e-2f);
  EXPECT_EQ(s.tracer().usage().geometry.made, 1u);
  EXPECT_NEAR(s.distance({{4, 0, 0}}), 8, 1e-2f);
  EXPECT_EQ(s.tracer().usage().geometry.made, 2u);
}

TEST(RayGeometry, what_no_ray_sees_is_not_kept) {
  RayScene s(
      "WorldBegin Sphere 1 -1 1 360 Attribute \"visibility\" \"int camera\" 1 Sphere 1 -1 1 360 WorldEnd");
  EXPECT_EQ(s.distance({{0, 0, -5}}), kInfinity);
  EXPECT_EQ(s.tracer().usage().geometry.faces, 0u);
}

TEST(RayGeometry, faces_are_nearer_to_the_surface_than_the_bias) {
  // Rays that start on the surface and leave it must not hit its faces.
  RayScene s(kCamera + "WorldBegin " + kSeen +
             "Attribute \"trace\" \"float bias\" .01 Translate 0 0 5 Sphere 1 -1 1 360 WorldEnd");
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    float a = 2.39996f * static_cast<float>(i), z = 1 - 2 * (static_cast<float>(i) + 0.5f) / 2000;
    float r = std::sqrt(1 - z * z);
    Vec3 n(r * std::cos(a), r * std::sin(a), z);
    hits += s.distance(
                {Vec3(0, 0, 5) + n, n + glm::normalize(glm::cross(n, Vec3(0.3f, 0.2f, 0.9f))) * 3.0f}) < 100;
  }
  EXPECT_EQ(hits, 0);
}

TEST(RayGeometry, instances_share_their_faces) {
  std::string object = "ObjectBegin 1 Sphere 1 -1 1 360 Torus 2 .2 0 360 360 ObjectEnd ";
  auto instances = [&](const char* first) {
    return kCamera + "WorldBegin " + kSeen + object + first +
           "TransformBegin Translate -5 0 12 ObjectInstance 1 TransformEnd "
           "TransformBegin Translate 5 0 12 Rotate 40 0 1 0 Scale 1 1.5 1 ObjectInstance 1 TransformEnd "
           "TransformBegin Translate 0 0 30 Scale -1 1 1 ObjectInstance 1 TransformEnd WorldEnd";
  };
  RayScene s(instances(""));
  EXPECT_EQ(s.messages(), "");
  EXPECT_NEAR(s.distance({{-5, 0, 0}}), 11, 5e-3f);
  EXPECT_NEAR(s.distance({{0, 0, 0}}), 29, 5e-3f);
  EXPECT_NEAR(s.distance({{5, 0, 0}}), 11, 5e-3f);
  EXPECT_EQ(s.tracer().usage().geometry.made, 1u) << "for all three";
  // The second is stretched in y.
  EXPECT_LT(s.distance({{5, 1.3f, 0}}), 100);
  EXPECT_EQ(s.distance({{-5, 1.3f, 0}}), kInfinity);
  auto P = s.value({{5.3f, 1.2f, 0}}, "primitive:P", Type::kPoint);
  ASSERT_EQ(P.size(), 3u);
  EXPECT_NEAR(P[0], 5.3f, 3e-3f);
  EXPECT_NEAR(P[1], 1.2f, 3e-3f);
  // Sides follow the mirrored one.
  slvm::RayOptions front;
  front.sides = slvm::HitSides::kFront;
  for (float x : {-5.0f, 0.0f, 5.0f}) {
    auto N = s.value({{x, 0, 0}}, "primitive:N", Type::kNormal);
    EXPECT_EQ(s.distance({{x, 0, 0}}, front) < (x == 0 ? 29.5f : 11.5f), N[2] < 0) << x;
  }
}

TEST(RayGeometry, objects_that_differ_are_not_shared) {
  // Ribbons turn towards the eye: each instance is another surface.
  RayScene s(kCamera + "WorldBegin " + kSeen +
             "ObjectBegin 1 Curves \"cubic\" [4] \"nonperiodic\" \"P\" [-2 0 0 -1 0 0 1 0 0 2 0 0] "
             "\"constantwidth\" .5 ObjectEnd "
             "TransformBegin Translate 0 0 6 ObjectInstance 1 TransformEnd "
             "TransformBegin Translate 0 9 6 ObjectInstance 1 TransformEnd WorldEnd");
  for (float y : {0.0f, 9.0f})
    for (float dy : {-0.1f, 0.1f}) {
      Vec3 to(0.1f, y + dy, 6);
      EXPECT_NEAR(s.distance({{}, to}), glm::length(to), 0.2f) << y;
    }
}

TEST(RayGeometry, patches_have_rates_of_their_own_and_no_cracks) {
  // A subdivided cube of 6 x 6 x 6 faces, one of whose vertices is pulled out: few of its patches bend much.
  std::string counts, corners, points;
  std::map<std::array<int, 3>, int> numbers;
  auto vertex = [&](int x, int y, int z) {
    auto [it, is_new] = numbers.try_emplace({x, y, z}, static_cast<int>(numbers.size()));
    if (is_new) {
      const bool out = x == 3 && y == 3 && z == 0;
      for (int c : {x, y, z})
        points += std::to_string((c - 3) / 3.0) + " ";
      if (out) points.replace(points.rfind("-1."), 9, "-1.6");
    }
    corners += std::to_string(it->second) + " ";
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int end : {0, 6})
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
          counts += "4 ";
          for (auto [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
            int p[3];
            p[axis] = end;
            p[(axis + 1) % 3] = end ? i + a : j + b;
            p[(axis + 2) % 3] = end ? j + b : i + a;
            vertex(p[0], p[1], p[2]);
          }
        }
  RayScene s(kCamera + "WorldBegin " + kSeen + "Translate 0 0 4 SubdivisionMesh \"catmull-clark\" [" +
             counts + "] [" + corners + "] [] [] [] [] \"P\" [" + points + "] WorldEnd");
  EXPECT_EQ(s.messages(), "");
  int escaped = 0;
  for (int i = 0; i < 40000; ++i) {
    const float a = 2.39996f * static_cast<float>(i), z = 1 - 2 * (static_cast<float>(i) + 0.5f) / 40000,
                r = std::sqrt(1 - z * z);
    escaped += s.distance({{0, 0, 4}, {r * std::cos(a), r * std::sin(a), z}}) == kInfinity;
  }
  EXPECT_EQ(escaped, 0);
  const size_t faces = s.tracer().usage().geometry.faces;
  size_t finest = 0;
  const Camera camera(s.scene().options);
  for (const Primitive& p : s.scene().primitives) {
    const FaceRate rate = measure_rate(p, camera, false, false);
    finest = std::max({finest, static_cast<size_t>(rate.u), static_cast<size_t>(rate.v)});
    EXPECT_LE(std::max(rate.sides[0], rate.sides[1]), rate.u);
    EXPECT_LE(std::max(rate.sides[2], rate.sides[3]), rate.v);
  }
  EXPECT_LT(faces, s.scene().primitives.size() * finest * finest / 4) << "all as fine as the finest";
}

TEST(RayGeometry, requests_have_a_limit_of_faces) {
  std::vector<FaceRate> rates(100, FaceRate{512, 512, {512, 256, 1, 512}});
  limit_faces(rates);
  EXPECT_LE(100 * rates[0].faces(), size_t{1} << 22);
  EXPECT_EQ(rates[0].u, 128);
  EXPECT_THAT(rates[0].sides, ::testing::ElementsAre(128, 64, 1, 128));
}

TEST(RayGeometry, many_small_primitives_share_items) {
  std::string rib = kCamera + "WorldBegin " + kSeen + "Translate 0 0 9 ";
  for (int i = 0; i < 300; ++i)
    rib += "TransformBegin Translate " + std::to_string(i % 20 * 0.3 - 3) + " " +
           std::to_string(i / 20 * 0.3 - 2) +
           " 0 Polygon \"P\" [-.1 -.1 0 .1 -.1 0 .1 .1 0 -.1 .1 0] TransformEnd ";
  RayScene s(rib + "WorldEnd");
  int hits = 0;
  for (int i = 0; i < 300; ++i)
    hits += s.distance({{static_cast<float>(i % 20) * 0.3f - 3 + 0.05f,
                         static_cast<float>(i / 20) * 0.3f - 2 + 0.05f, 0}}) < 10;
  EXPECT_EQ(hits, 300);
  EXPECT_EQ(s.tracer().usage().geometry.made, 1u);
}

TEST(RayGeometry, surfaces_that_lie_in_one_place) {
  // One is as good as the other, but it must be that one alone: not its face as one of the other's.
  std::string small,
      large = "Attribute \"visibility\" \"int diffuse\" 0 Color 1 0 0 "
              "Polygon \"P\" [-9 -9 5 9 -9 5 9 9 5 -9 9 5] Attribute \"visibility\" \"int diffuse\" 1 ";
  for (int i = 0; i < 100; ++i) {
    const float x = static_cast<float>(i % 10) - 5, y = static_cast<float>(i / 10) - 5;
    small += fmt::format("Color 0 {} 1 Polygon \"P\" [{} {} 5 {} {} 5 {} {} 5 {} {} 5] ", i / 100.0, x, y,
                         x + 1, y, x + 1, y + 1, x, y + 1);
  }
  for (bool small_first : {true, false}) {
    RayScene s(kCamera + "WorldBegin " + kSeen + "Surface \"plain\" " +
                   (small_first ? small + large : large + small) + "WorldEnd",
               {{"plain", "surface plain() { Oi = 1; Ci = Cs; }"}});
    for (int i = 0; i < 100; ++i) {
      const Vec3 at(static_cast<float>(i % 10) - 4.5f, static_cast<float>(i / 10) - 4.5f, 0);
      const auto colour = s.value({at}, "surface:Ci", Type::kColor);
      ASSERT_EQ(colour.size(), 3u);
      const float own = static_cast<float>(i / 100.0);
      EXPECT_FLOAT_EQ(colour[1], colour[0] == 1 ? 0 : own) << i;
    }
  }
}

TEST(RayGeometry, displaced_surfaces) {
  std::map<std::string, std::string> shaders = {
      {"bump", "displacement bump() { P += vector(0, 0, -.5) * (1 - smoothstep(.1, .3, length(P - "
               "point(0,0,4)))); N = calculatenormal(P); }"}};
  auto scene = [&](const char* attribute) {
    return kCamera + "WorldBegin " + kSeen + attribute +
           " Attribute \"displacementbound\" \"float sphere\" .6 Displacement \"bump\" Translate 0 0 4 "
           "Polygon \"P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] WorldEnd";
  };
  RayScene moved(scene("Attribute \"trace\" \"int displacements\" 1"), shaders), still(scene(""), shaders);
  EXPECT_NEAR(moved.distance({{0, 0, 0}}), 3.5f, 1e-3f);
  EXPECT_NEAR(moved.distance({{0.8f, 0, 0}}), 4, 1e-3f);
  EXPECT_NEAR(still.distance({{0, 0, 0}}), 4, 1e-3f);
  // Hits are displaced as the faces are, and have the normals of the displaced surface.
  TestRay ray{{0.2f, 0, 0}};
  float height = 0.5f * (1 - 0.5f); // half way up the smoothstep
  auto P = moved.value(ray, "displacement:P", Type::kPoint);
  ASSERT_EQ(P.size(), 3u);
  EXPECT_NEAR(P[0], 0.2f, 5e-3f);
  EXPECT_NEAR(P[2], 4 - height, 1e-2f);
  EXPECT_NEAR(moved.distance(ray), 4 - height, 1e-2f);
  // Slope: 0.5 * smoothstep'(.2) = 0.5 * 1.5 / 0.2.
  for (RayScene* s : {&moved, &still}) {
    auto N = s->value(ray, "surface:N", Type::kNormal);
    ASSERT_EQ(N.size(), 3u);
    EXPECT_NEAR(std::abs(N[0] / N[2]), 3.75f, 0.06f) << "also where the shader only bends normals";
  }
  auto unmoved = still.value(ray, "displacement:P", Type::kPoint);
  EXPECT_NEAR(unmoved[2], 4, 1e-5f);
}

TEST(RayGeometry, motion_where_rays_sample_it) {
  // A card moves from x = 0 to x = 4 while the shutter is open, another one grows.
  auto scene = [&](const char* attribute) {
    return kCamera + "Shutter 0 1 WorldBegin " + kSeen + attribute +
           " AttributeBegin Translate 0 0 4 MotionBegin [0 1] Translate 0 0 0 Translate 4 0 0 MotionEnd "
           "Polygon \"P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] AttributeEnd Translate 0 50 4 MotionBegin [0 1] "
           "Polygon \"P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] Polygon \"P\" [-2 -2 0 2 -2 0 2 2 0 -2 2 0] "
           "MotionEnd WorldEnd";
  };
  RayScene still(scene("")), moving(scene("Attribute \"trace\" \"int samplemotion\" 1"));
  auto part = [](RayScene& s, float x, float y) {
    s.asking_grid(1, 1, 0);
    std::vector<TestRay> rays(4000, TestRay{{x, y, 0}});
    int hits = 0;
    for (const TestHit& hit : s.trace(rays))
      hits += hit.distance < 100;
    return hits / 4000.0;
  };
  EXPECT_EQ(part(still, 0.5f, 0), 1);
  EXPECT_EQ(part(still, 2, 0), 0);
  // Over x the card is from t = (x - 1) / 4 to (x + 1) / 4.
  EXPECT_NEAR(part(moving, 0.5f, 0), 1.5 / 4, 0.03);
  EXPECT_NEAR(part(moving, 2, 0), 0.5, 0.03);
  EXPECT_NEAR(part(moving, 4.5f, 0), 0.5 / 4, 0.03);
  // Its edge passes 1.5 half way.
  EXPECT_NEAR(part(moving, 1.5f, 50), 0.5, 0.03);
  EXPECT_EQ(part(moving, 0.5f, 50), 1);
  // Where a moving card is hit, its own x is known.
  moving.asking_grid(1, 1, 0);
  std::vector<TestRay> rays(50, TestRay{{2, 0.5f, 0}});
  for (const TestHit& hit :
       moving.trace(rays, {RayScene::output(slvm::RayOutput::From::kPrimitive, "P", Type::kPoint)}))
    if (hit.distance < 100) {
      EXPECT_NEAR(hit.values[0][0], 2, 1e-3f);
    }
}

TEST(RayGeometry, curves_and_points) {
  RayScene s(
      kCamera + "WorldBegin " + kSeen +
      "Translate 0 0 5 Curves \"linear\" [2] \"nonperiodic\" \"P\" [-1 0 0 1 0 0] \"constantwidth\" .4 "
      "Points \"P\" [0 3 0] \"constantwidth\" 1 WorldEnd");
  EXPECT_NEAR(s.distance({{0.5f, 0.15f, 0}}), 5, 1e-2f);
  EXPECT_EQ(s.distance({{0.5f, 0.25f, 0}}), kInfinity);
  EXPECT_LT(s.distance({{}, {0.1f, 3.3f, 5}}), 7);
  EXPECT_EQ(s.distance({{}, {0.1f, 3.7f, 5}}), kInfinity);
}

TEST(RayGeometry, memory_has_a_limit) {
  std::string rib = kCamera + "Option \"limits\" \"int geocachememory\" 400 WorldBegin " + kSeen;
  for (int i = 0; i < 12; ++i) // apart by group, so that they are items of their own
    rib += "Attribute \"grouping\" \"string membership\" \"g" + std::to_string(i) +
           "\" TransformBegin Translate " + std::to_string(3 * i) +
           " 0 40 Torus 1 .3 0 360 360 Sphere .5 -.5 .5 360 TransformEnd ";
  RayScene s(rib + "WorldEnd"),
      unlimited(rib.substr(0, kCamera.size()) + rib.substr(rib.find("WorldBegin")) + "WorldEnd");
  size_t most = 0;
  for (int round = 0; round < 3; ++round)
    for (int i = 0; i < 12; ++i) {
      TestRay ray{{3.0f * static_cast<float>(i) + 0.1f, 0.05f, 0}};
      EXPECT_EQ(s.distance(ray), unlimited.distance(ray)) << "the same faces, whenever they are made";
      most = std::max(most, s.tracer().usage().geometry.bytes);
    }
  EXPECT_GT(s.tracer().usage().geometry.dropped, 0u);
  EXPECT_LT(most, unlimited.tracer().usage().geometry.bytes / 2);
}

TEST(RayGeometry, threads_may_ask_at_the_same_time) {
  std::string rib = kCamera + "Option \"limits\" \"int geocachememory\" 200 WorldBegin " + kSeen;
  for (int i = 0; i < 8; ++i)
    rib += "Attribute \"grouping\" \"string membership\" \"g" + std::to_string(i) +
           "\" TransformBegin Translate " + std::to_string(3 * i) +
           " 0 40 Torus 1 .3 0 360 360 TransformEnd ";
  RayScene s(rib + "WorldEnd");
  slvm::ShadingState state = s.state();
  std::vector<float> x[4];
  auto ask = [&](std::vector<float>& out) {
    for (int round = 0; round < 40; ++round)
      for (int i = 0; i < 8; ++i) {
        float origin[3] = {3.0f * static_cast<float>((i + round) % 8) + 0.9f, 0.1f, 0},
              direction[3] = {0, 0, 1}, d = 0;
        uint32_t zero = 0;
        slvm::RayBatch batch;
        batch.count = 1;
        for (int c = 0; c < 3; ++c) {
          batch.origin[c] = &origin[c];
          batch.direction[c] = &direction[c];
        }
        batch.point = batch.sample = &zero;
        s.tracer().trace(state, {}, batch, {}, &d, nullptr);
        out.push_back(d);
      }
  };
  std::vector<std::thread> threads;
  for (auto& out : x)
    threads.emplace_back([&] { ask(out); });
  for (auto& t : threads)
    t.join();
  for (int i = 1; i < 4; ++i)
    EXPECT_EQ(x[i], x[0]);
  EXPECT_LT(x[0][0], 41);
}

TEST(RayGeometry, scenes_gone_wrong) {
  // Huge and tiny things, singular transformations, surfaces that are points: rays go on.
  RayScene s(kCamera + "WorldBegin " + kSeen +
             "TransformBegin Scale 0 1 1 Sphere 1 -1 1 360 TransformEnd "
             "TransformBegin Scale 1e30 1e30 1e30 Sphere 1e8 -1e8 1e8 360 TransformEnd "
             "TransformBegin Scale 1e-30 1e-30 1e-30 Sphere 1 -1 1 360 TransformEnd "
             "Polygon \"P\" [0 0 5 0 0 5 0 0 5] Polygon \"P\" [-1e12 -1e12 20 1e12 -1e12 20 1e12 1e12 20 "
             "-1e12 1e12 20] "
             "Patch \"bicubic\" \"P\" [0 0 9 0 0 9 0 0 9 0 0 9 0 0 9 0 0 9 0 0 9 0 0 9 0 0 9 0 0 9 0 0 9 0 0 "
             "9 0 0 9 0 0 9 "
             "0 0 9 0 0 9] WorldEnd");
  EXPECT_NEAR(s.distance({{3, 4, 0}}), 20, 1e-3f);
  float nan = std::nanf("");
  for (TestRay ray : {TestRay{{nan, 0, 0}}, TestRay{{0, 0, 0}, {0, 0, 1}, -5}, TestRay{{kInfinity, 0, 0}},
                      TestRay{{0, 0, 0}, {0, 0, 1}, nan}})
    EXPECT_EQ(s.distance(ray), kInfinity);
  EXPECT_EQ(s.transmission({1, 1, 1}, {1, 1, 1}), Color(1.0f)) << "no way at all";
  auto hit =
      s.trace({{{3, 4, 0}}}, {RayScene::output(slvm::RayOutput::From::kSurface, "Ci", Type::kColor)})[0];
  EXPECT_TRUE(std::isfinite(hit.values[0][0]));
}

} // namespace
} // namespace render::testing
