// Occlusion and indirect light against values known by integration.
#include "render/rays/hemisphere_pattern.h"
#include "tests/render/rays/ray_scene.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/temp_folder.h"

#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace render::testing {
namespace {

const std::string kSeen = "Attribute \"visibility\" \"trace\" 1 Attribute \"trace\" \"float bias\" .0005 ";

std::string world(const std::string& rib, int size = 100) {
  return "Format " + std::to_string(size) + " " + std::to_string(size) +
         " 1 Projection \"perspective\" \"fov\" 45 WorldBegin " + kSeen + rib + " WorldEnd";
}

/// A hemisphere query of points that are set by `place`.
struct Ask {
  explicit Ask(RayScene& s, int nu = 1, int nv = 1, int primitive = -1)
      : scene(s), grid(s.asking_grid(nu, nv, primitive)) {
    size_t n = grid.points();
    for (auto* planes : {position, normal, radiance, colour, direction})
      for (int c = 0; c < 3; ++c)
        planes[c].resize(n);
    occlusion.resize(n);
    query.points = n;
    query.rays.kind = slvm::RayKind::kDiffuse;
    query.samples = 256;
    query.max_error = 0;
    for (int c = 0; c < 3; ++c) {
      query.position[c] = position[c].data();
      query.normal[c] = normal[c].data();
      query.environment_colour[c] = colour[c].data();
      query.environment_direction[c] = direction[c].data();
    }
    query.occlusion = occlusion.data();
  }
  Ask& light() {
    for (int c = 0; c < 3; ++c)
      query.radiance[c] = radiance[c].data();
    query.rays.shades = true;
    return *this;
  }
  void place(size_t i, Vec3 p, Vec3 n) {
    for (int c = 0; c < 3; ++c) {
      position[c][i] = p[c];
      normal[c][i] = glm::normalize(n)[c];
    }
  }
  Ask& run() {
    problem = scene.tracer().hemisphere(scene.state(), query);
    return *this;
  }
  float at(Vec3 p, Vec3 n) {
    place(0, p, n);
    run();
    return occlusion[0];
  }
  Color radiance_at(Vec3 p, Vec3 n) {
    place(0, p, n);
    run();
    return {radiance[0][0], radiance[1][0], radiance[2][0]};
  }

  RayScene& scene;
  slvm::Grid& grid;
  slvm::HemisphereQuery query;
  std::vector<float> position[3], normal[3], radiance[3], colour[3], direction[3], occlusion;
  std::string problem;
};

TEST(HemispherePattern, as_many_cells_as_samples) {
  for (int n : {1, 2, 4, 16, 32, 64, 100, 256, 1000, 1024}) {
    HemispherePattern p = make_pattern(static_cast<float>(n), 0);
    EXPECT_EQ(p.cells(), n);
    EXPECT_EQ(p.blocks(), n);
  }
  HemispherePattern p = make_pattern(256, 64);
  EXPECT_EQ(p.cells(), 256);
  EXPECT_EQ(p.blocks(), 64);
  EXPECT_GE(make_pattern(97, 0).cells(), 97);
  EXPECT_LE(make_pattern(97, 0).cells(), 110);
  EXPECT_EQ(make_pattern(-3, 0).cells(), 1);
}

TEST(HemispherePattern, directions_are_as_dense_as_they_should_be) {
  // Mean cosine: 2/3 by cosine, 1/2 evenly; in a cone of 60 degrees 7/9 and 3/4; all round 0.
  auto mean = [&](float cone, bool cosine, auto&& f) {
    double sum = 0;
    for (int j = 0; j < 64; ++j)
      sum += f(CosineOfRadius(cone, cosine)((static_cast<float>(j) + 0.5f) / 64));
    return sum / 64;
  };
  auto same = [](float c) { return c; };
  EXPECT_NEAR(mean(kPi / 2, true, same), 2.0 / 3, 2e-3);
  EXPECT_NEAR(mean(kPi / 2, false, same), 0.5, 1e-3);
  EXPECT_NEAR(mean(kPi / 3, true, same), 7.0 / 9, 2e-3);
  EXPECT_NEAR(mean(kPi / 3, false, same), 0.75, 1e-3);
  EXPECT_NEAR(mean(kPi, true, same), 0, 1e-2);
  EXPECT_NEAR(mean(kPi, true, [](float c) { return std::abs(c); }), 2.0 / 3, 1e-2);
  EXPECT_NEAR(mean(kPi, false, same), 0, 1e-3);
}

TEST(Hemisphere, occlusion_under_a_disk) {
  // A disk of radius R at height h over the point hides R^2 / (R^2 + h^2) by cosine.
  RayScene s(world("Rotate 90 1 0 0 Translate 0 0 0 Disk 1 1 360 "));
  // The disk is at y = -1 or y = 1, whichever way the rotation goes.
  Ask ask(s);
  ask.query.samples = 1024;
  Vec3 up = s.distance({{0.1f, 0, 0.1f}, {0, 1, 0}}) < 10 ? Vec3(0, 1, 0) : Vec3(0, -1, 0);
  for (float h : {0.5f, 1.0f, 2.0f}) {
    Vec3 p = up * (1 - h);
    EXPECT_NEAR(ask.at(p, up), 1 / (1 + h * h), 0.015f) << h;
    EXPECT_EQ(ask.at(p, -up), 0);
  }
  // Evenly: the part of the solid angle, 1 - h / sqrt(h^2 + R^2).
  ask.query.cosine = false;
  EXPECT_NEAR(ask.at(Vec3(0.0f), up), 1 - std::sqrt(0.5f), 0.015f);
  ask.query.cosine = true;
  float cone = kPi / 6, half = 0.5f, far = 0.9f;
  ask.query.cone_angle = &cone;
  EXPECT_EQ(ask.at(Vec3(0.0f), up), 1) << "all of a narrow cone";
  ask.query.cone_angle = nullptr;
  ask.query.max_distance = &far;
  EXPECT_EQ(ask.at(Vec3(0.0f), up), 0) << "too far";
  ask.query.max_distance = nullptr;
  // exp(-falloff d): integrate over the disk seen from below.
  ask.query.falloff = half;
  double expected = 0;
  for (int i = 0; i < 10000; ++i) {
    double sin2 = (i + 0.5) / 10000; // by cosine
    double d = 1 / std::sqrt(1 - sin2);
    if (std::tan(std::asin(std::sqrt(sin2))) < 1) expected += std::exp(-0.5 * d) / 10000;
  }
  EXPECT_NEAR(ask.at(Vec3(0.0f), up), expected, 0.01);
}

TEST(Hemisphere, corners_of_planes) {
  // Walls of infinite height, nearly: half of the sky behind one of them, three quarters behind two.
  const char* kFloor = "Polygon \"P\" [-1e4 0 -1e4 1e4 0 -1e4 1e4 0 1e4 -1e4 0 1e4] ";
  const char* kWallX = "Polygon \"P\" [0 -1e4 -1e4 0 1e4 -1e4 0 1e4 1e4 0 -1e4 1e4] ";
  const char* kWallZ = "Polygon \"P\" [-1e4 -1e4 0 1e4 -1e4 0 1e4 1e4 0 -1e4 1e4 0] ";
  RayScene one(world(kFloor)), two(world(std::string(kFloor) + kWallX)),
      three(world(std::string(kFloor) + kWallX + kWallZ));
  Vec3 p(0.3f, 0, 0.2f), up(0, 1, 0);
  auto at = [&](RayScene& s) {
    Ask ask(s);
    ask.query.samples = 1024;
    return ask.at(p, up);
  };
  EXPECT_EQ(at(one), 0);
  EXPECT_NEAR(at(two), 0.5f, 0.01f);
  EXPECT_NEAR(at(three), 0.75f, 0.01f);
}

TEST(Hemisphere, a_sphere_resting_on_a_plane) {
  // R^2 h / (rho^2 + h^2)^1.5 at a distance rho from where it touches, R = h = 0.5.
  RayScene s(world("Translate 0 .5 6 Sphere .5 -.5 .5 360"));
  for (auto [rho, value] : {std::pair(0.25f, 0.7155f), {0.5f, 0.3536f}, {1.0f, 0.0894f}, {2.0f, 0.0143f}}) {
    Ask ask(s);
    ask.query.samples = 4096;
    EXPECT_NEAR(ask.at({rho, 0, 6}, {0, 1, 0}), value, 0.008f) << rho;
  }
}

TEST(Hemisphere, adaptive_sampling_saves_rays) {
  RayScene s(world("Translate 0 .5 6 Sphere .5 -.5 .5 360"));
  auto at = [&](float samples, float fewest, size_t& rays) {
    Ask ask(s);
    ask.query.samples = samples;
    ask.query.min_samples = fewest;
    double sum = 0;
    size_t before = s.tracer().usage().hemisphere_rays;
    for (int i = 0; i < 40; ++i)
      sum += ask.at({0.5f * std::cos(0.16f * static_cast<float>(i)), 0,
                     6 + 0.5f * std::sin(0.16f * static_cast<float>(i))},
                    {0, 1, 0});
    rays = s.tracer().usage().hemisphere_rays - before;
    return sum / 40;
  };
  size_t all, some;
  EXPECT_NEAR(at(256, 0, all), 0.3536, 0.006);
  EXPECT_NEAR(at(256, 64, some), 0.3536, 0.01);
  EXPECT_EQ(all, 40u * 256);
  EXPECT_LT(some, all * 2 / 3);
  EXPECT_GE(some, 40u * 64);
}

TEST(Hemisphere, light_in_a_white_furnace) {
  // A closed room whose walls give 1 everywhere; a ball in it.
  RayScene s(world("Surface \"glow\" Translate 0 0 5 Sphere 3 -3 3 360 Sphere .5 -.5 .5 360"),
             {{"glow", "surface glow() { Ci = color(1, .5, .25); Oi = 1; }"}});
  Ask ask(s);
  ask.light();
  Color c = ask.radiance_at({0, 0.5f, 5}, {0, 1, 0});
  EXPECT_EQ(c.x, 1);
  EXPECT_EQ(c.y, 0.5f);
  EXPECT_EQ(c.z, 0.25f);
  EXPECT_EQ(ask.occlusion[0], 1);
}

TEST(Hemisphere, occlusion_runs_no_shaders_and_light_does) {
  RayScene s(world("Surface \"says\" Translate 0 0 5 Sphere 3 -3 3 360"),
             {{"says", "surface says() { printf(\".\"); Ci = 1; Oi = 1; }"}});
  for (float max_error : {0.0f, 0.5f}) {
    Ask ask(s);
    ask.query.max_error = max_error;
    EXPECT_EQ(ask.at({0, 0.5f, 5}, {0, 1, 0}), 1);
    EXPECT_EQ(s.printed(), "");
    ask.light();
    EXPECT_EQ(ask.radiance_at({0, 0.5f, 5}, {0, 1, 0}).x, 1);
    EXPECT_NE(s.printed(), "");
  }
}

TEST(Hemisphere, colour_bleeding_by_form_factors) {
  // A square of side 2 facing the point at distance 1, above its middle: by the formula of a parallel
  // rectangle seen from below a corner, four times: F = 4 / (2 PI) (2 a / sqrt(1 + a^2) atan(a / sqrt(1 +
  // a^2))), a = 1.
  RayScene s(world("Surface \"red\" Polygon \"P\" [-1 1 -1 1 1 -1 1 1 1 -1 1 1] Surface \"blue\" "
                   "Polygon \"P\" [-9 -1 -9 9 -1 -9 9 -1 9 -9 -1 9]"),
             {{"red", "surface red() { Ci = color(.8, 0, 0); Oi = 1; }"},
              {"blue", "surface blue() { Ci = color(0, 0, 1); Oi = 1; }"}});
  double a = 1 / std::sqrt(2.0), factor = 4 / (2 * M_PI) * 2 * a * std::atan(a);
  Ask ask(s);
  ask.light().query.samples = 4096;
  Color c = ask.radiance_at({0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(c.x, 0.8 * factor, 0.006);
  EXPECT_EQ(c.z, 0);
  // Perpendicular: the square's edge-on half space of a wall's point, x = 1, looking along -x at height 0:
  // only rays up meet it. The blue floor fills the other half but for what lies behind.
  Color side = ask.radiance_at({1, 0, 0}, {-1, 0, 0});
  EXPECT_GT(side.x, 0.05f);
  EXPECT_NEAR(side.z, 0.5f, 0.08f);
}

TEST(Hemisphere, an_environment_map_lights_what_is_open) {
  anemone::test::TempFolder folder;
  auto out = OIIO::ImageOutput::create("map.exr");
  std::vector<float> pixels(32 * 16 * 3);
  for (size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = i % 3 == 0 ? 0.5f : i % 3 == 1 ? 1.0f : 2.0f;
  ASSERT_TRUE(out->open((folder / "map.exr").string(), OIIO::ImageSpec(32, 16, 3, OIIO::TypeDesc::FLOAT)));
  out->write_image(OIIO::TypeDesc::FLOAT, pixels.data());
  out->close();
  RayScene s(world("Surface \"dark\" Polygon \"P\" [0 -1e4 -1e4 0 1e4 -1e4 0 1e4 1e4 0 -1e4 1e4]"),
             {{"dark", "surface dark() { Ci = .1; Oi = 1; }"}}, {folder.string()});
  Ask ask(s);
  ask.light().query.environment_map = "map.exr";
  Color c = ask.radiance_at({-1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(ask.problem, "");
  EXPECT_NEAR(ask.occlusion[0], 0.5f, 0.01f);
  EXPECT_NEAR(c.x, 0.5f * 0.5f + 0.5f * 0.1f, 0.01f);
  EXPECT_NEAR(c.z, 0.5f * 2.0f + 0.5f * 0.1f, 0.02f);
  EXPECT_NEAR(ask.colour[2][0], 0.5f * 2.0f, 0.02f) << "hits count as black";
  // The mean open direction: of a quarter space (-4/(3 PI), 2/3, 0) before normalisation... as an angle 45
  // degrees.
  EXPECT_LT(ask.direction[0][0], -0.4f);
  EXPECT_NEAR(glm::length(Vec3(ask.direction[0][0], ask.direction[1][0], ask.direction[2][0])), 1, 1e-5f);
  ask.query.environment_map = "missing.exr";
  ask.radiance_at({-1, 0, 0}, {0, 1, 0});
  EXPECT_NE(ask.problem, "");
  // The map's light by importance: even here.
  slvm::EnvironmentSamples e;
  float random[2] = {0.3f, 0.6f}, direction[3], colour[3], density;
  e.map = "map.exr";
  e.count = 1;
  for (int i = 0; i < 2; ++i)
    e.random[i] = &random[i];
  for (int c2 = 0; c2 < 3; ++c2) {
    e.direction[c2] = &direction[c2];
    e.colour[c2] = &colour[c2];
  }
  e.density = &density;
  EXPECT_EQ(s.tracer().sample_environment(s.state(), e), "");
  EXPECT_NEAR(density, 1 / (4 * M_PI), 0.003);
  EXPECT_NEAR(colour[0], 0.5f, 1e-3f);
}

/// A lattice of 17 x 17 points on the plane y = 0, from -1 to 1 about (0, 0, 6).
void floor_lattice(Ask& ask) {
  for (int j = 0; j < 17; ++j)
    for (int i = 0; i < 17; ++i)
      ask.place(static_cast<size_t>(j * 17 + i),
                {-1 + 0.125f * static_cast<float>(i), 0, 5 + 0.125f * static_cast<float>(j)}, {0, 1, 0});
}

TEST(Hemisphere, interpolation_keeps_near_the_exact_values) {
  RayScene s(world("Translate 0 1.1 6 Sphere .5 -.5 .5 360"));
  auto exact = [](float x, float z) {
    double h = 1.1, rho2 = x * x + (z - 6) * (z - 6);
    return 0.25 * h / std::pow(rho2 + h * h, 1.5);
  };
  for (float max_error : {0.2f, 0.5f}) {
    Ask ask(s, 17, 17);
    ask.query.samples = 1024;
    ask.query.max_error = max_error;
    floor_lattice(ask);
    ask.query.rays.seed =
        static_cast<uint32_t>(100 * max_error); // or the second one would find samples of the first
    size_t before = s.tracer().usage().hemispheres;
    ask.run();
    size_t taken = s.tracer().usage().hemispheres - before;
    EXPECT_LT(taken, max_error > 0.3f ? 28u : 120u) << max_error;
    EXPECT_GE(taken, 4u);
    double worst = 0, squares = 0;
    for (size_t k = 0; k < 289; ++k) {
      double error = ask.occlusion[k] - exact(ask.position[0][k], ask.position[2][k]);
      worst = std::max(worst, std::abs(error));
      squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / 289), max_error > 0.3f ? 0.012 : 0.008) << max_error;
    EXPECT_LT(worst, 0.04);
  }
}

TEST(Hemisphere, gradients_are_those_of_the_values) {
  // Occlusion by the sphere of before, at a point beside it, differentiated by hand; and turned towards it.
  RayScene s(world("Translate 0 1.1 6 Sphere .5 -.5 .5 360"));
  // Two points so far apart that the middle is interpolated by their slopes only: a line of 3.
  constexpr int kRows = 22; // as many as make a lattice
  Ask ask(s, 3, kRows);
  ask.query.samples = 16384;
  ask.query.max_error = 10;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < 3; ++i)
      ask.place(static_cast<size_t>(3 * j + i),
                {0.2f + 0.2f * static_cast<float>(i), 0, 6 + 0.002f * static_cast<float>(j)}, {0, 1, 0});
  ask.run();
  auto exact = [](double x) { return 0.25 * 1.1 / std::pow(x * x + 1.21, 1.5); };
  EXPECT_NEAR(ask.occlusion[1], exact(0.4), 0.002);
  // Turned: the point stays, the normal goes from -30 to 30 degrees about z; the middle looks straight up.
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < 3; ++i) {
      float a = 0.5f * static_cast<float>(i - 1);
      ask.place(static_cast<size_t>(3 * j + i), {0.4f, 0, 6 + 0.0001f * static_cast<float>(j)},
                {std::sin(a), std::cos(a), 0});
    }
  ask.run();
  // Seen whole, a sphere blocks R^2 / d^2 times the cosine to its middle.
  auto turned = [](double a) {
    return 0.25 / (0.16 + 1.21) * (-0.4 * std::sin(a) + 1.1 * std::cos(a)) / std::sqrt(0.16 + 1.21);
  };
  EXPECT_NEAR(ask.occlusion[0], turned(-0.5), 0.003);
  EXPECT_NEAR(ask.occlusion[2], turned(0.5), 0.003);
  EXPECT_NEAR(ask.occlusion[1], turned(0), 0.01)
      << "by slopes; the mean of both ends is " << (turned(-.5) + turned(.5)) / 2;
}

TEST(Hemisphere, grids_agree_on_the_edge_they_share_in_any_order) {
  auto run = [&](bool other_first, std::vector<float>& left, std::vector<float>& right) {
    RayScene s(world("Translate 0.3 .55 6 Sphere .5 -.5 .5 360"));
    for (int turn = 0; turn < 2; ++turn) {
      bool is_right = (turn == 0) == other_first;
      Ask ask(s, 17, 17);
      ask.query.samples = 64;
      ask.query.max_error = 0.3f;
      for (int j = 0; j < 17; ++j)
        for (int i = 0; i < 17; ++i)
          ask.place(static_cast<size_t>(j * 17 + i),
                    {(is_right ? 0.0f : -1.0f) + 0.0625f * static_cast<float>(i), 0,
                     5.5f + 0.0625f * static_cast<float>(j)},
                    {0, 1, 0});
      ask.run();
      (is_right ? right : left) = ask.occlusion;
    }
  };
  std::vector<float> left, right, left2, right2;
  run(false, left, right);
  run(true, left2, right2);
  EXPECT_EQ(left, left2);
  EXPECT_EQ(right, right2);
  for (size_t j = 0; j < 17; ++j)
    EXPECT_EQ(left[j * 17 + 16], right[j * 17]) << "no seam";
}

/// A plane with a sphere of radius 0.5 resting on it, as facets of 2 x 2 points that are asked for in this
/// order: occlusion by number of the facet, and how many samples that took.
std::vector<float> facets_by(const std::vector<int>& order, int across, size_t& samples) {
  RayScene s(world("Translate 0 .5 6 Sphere .5 -.5 .5 360", 400)); // pixels smaller than facets
  std::vector<float> out(order.size() * 4);
  for (int facet : order) {
    Ask ask(s, 2, 2);
    ask.query.max_error = 0.3f;
    const std::vector<float> base(4, 1.0f); // as shaders have it: origins spread over the element
    ask.query.sample_base = base.data();
    for (size_t k = 0; k < 4; ++k) {
      const int i = 2 * (facet % across) + static_cast<int>(k % 2),
                j = 2 * (facet / across) + static_cast<int>(k / 2);
      ask.place(k,
                {-1 + (static_cast<float>(i) + 0.5f) / static_cast<float>(across), 0,
                 5 + (static_cast<float>(j) + 0.5f) / static_cast<float>(across)},
                {0, 1, 0});
    }
    ask.run();
    std::copy_n(ask.occlusion.begin(), 4, out.begin() + 4 * facet);
  }
  samples = s.tracer().usage().hemispheres;
  return out;
}

TEST(Hemisphere, facets_share_samples_whatever_their_order) {
  constexpr int kAcross = 32, kFacets = kAcross * kAcross;
  std::vector<int> order(kFacets);
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::vector<float>> results;
  for (int turn = 0; turn < 3; ++turn) {
    if (turn == 1) std::reverse(order.begin(), order.end());
    if (turn == 2) std::shuffle(order.begin(), order.end(), std::mt19937(5));
    size_t samples = 0;
    results.push_back(facets_by(order, kAcross, samples));
    EXPECT_LT(samples, 4u * kFacets / 5) << turn;
    double squares = 0, worst = 0;
    for (int facet = 0; facet < kFacets; ++facet) {
      double x = -1 + (2 * (facet % kAcross) + 0.5) / kAcross,
             z = 5 + (2 * (facet / kAcross) + 0.5) / kAcross;
      double rho2 = x * x + (z - 6) * (z - 6), exact = 0.125 / std::pow(rho2 + 0.25, 1.5);
      double error = results.back()[static_cast<size_t>(4 * facet)] - exact;
      squares += error * error;
      worst = std::max(worst, std::abs(error));
    }
    EXPECT_LT(std::sqrt(squares / kFacets), 0.02) << turn;
    EXPECT_LT(worst, 0.12) << turn;
  }
  for (size_t k = 0; k < results[0].size(); ++k)
    for (int turn : {1, 2})
      ASSERT_NEAR(results[0][k], results[static_cast<size_t>(turn)][k], 0.15) << k;
}

TEST(Hemisphere, hits_of_rays_share_samples) {
  RayScene s(world("Translate 0 .5 6 Sphere .5 -.5 .5 360"));
  Ask ask(s, 256, 1);
  ask.grid.lattice = slvm::Lattice::kHits;
  ask.query.max_error = 0.3f;
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (size_t k = 0; k < 256; ++k)
    ask.place(k, {unit(random), 0, 6 + unit(random)}, {0, 1, 0});
  ask.run();
  EXPECT_LT(s.tracer().usage().hemispheres, 220u);
  for (size_t k = 0; k < 256; ++k) {
    double x = ask.position[0][k], z = ask.position[2][k] - 6;
    EXPECT_NEAR(ask.occlusion[k], 0.125 / std::pow(x * x + z * z + 0.25, 1.5), 0.12) << x << ' ' << z;
  }
}

TEST(Hemisphere, origins_are_spread_over_the_element) {
  // An element of side 2 about the origin, of which x < 0 lies under a plane as good as without end.
  RayScene s(world("Polygon \"P\" [-999 .02 -999 0 .02 -999 0 .02 999 -999 .02 999]"));
  std::vector<float> along_u[3], along_v[3], base{0};
  Ask ask(s);
  ask.query.samples = 1024;
  for (int c = 0; c < 3; ++c) {
    along_u[c] = {c == 0 ? 2.0f : 0.0f};
    along_v[c] = {c == 2 ? 2.0f : 0.0f};
    ask.query.along_u[c] = along_u[c].data();
    ask.query.along_v[c] = along_v[c].data();
  }
  ask.query.sample_base = base.data();
  EXPECT_NEAR(ask.at({-0.5f, 0, 0}, {0, 1, 0}), 1, 1e-2f);
  EXPECT_NEAR(ask.at({0.5f, 0, 0}, {0, 1, 0}), 0, 2e-2f);
  base = {1};
  EXPECT_NEAR(ask.at({0.5f, 0, 0}, {0, 1, 0}), 0.25f, 0.03f);
  EXPECT_NEAR(ask.at({-0.5f, 0, 0}, {0, 1, 0}), 0.75f, 0.03f);
  base = {0.5f};
  EXPECT_NEAR(ask.at({0.25f, 0, 0}, {0, 1, 0}), 0.25f, 0.03f);
}

TEST(Hemisphere, the_space_samples_are_kept_in_must_exist) {
  RayScene s(world("CoordinateSystem \"here\" Sphere 1 -1 1 360"));
  for (const char* space : {"", "here", "world", "object", "current"}) {
    Ask ask(s);
    ask.query.cache_space = space;
    ask.place(0, {0, 0, 5}, {0, 0, -1});
    EXPECT_EQ(ask.run().problem, "") << space;
  }
  Ask ask(s);
  ask.query.cache_space = "nowhere";
  ask.place(0, {0, 0, 5}, {0, 0, -1});
  EXPECT_EQ(ask.run().problem, "there is no coordinate system \"nowhere\"");
  EXPECT_GT(ask.occlusion[0], 0) << "the result is there all the same";
}

TEST(Hemisphere, points_that_are_off_or_broken) {
  RayScene s(world("Translate 0 1.1 6 Sphere .5 -.5 .5 360"));
  for (float max_error : {0.0f, 0.5f}) {
    Ask ask(s, 17, 17);
    ask.query.samples = 16;
    ask.query.max_error = max_error;
    floor_lattice(ask);
    std::vector<uint64_t> mask(5, 0x5555555555555555u);
    ask.query.mask = mask.data();
    std::fill(ask.occlusion.begin(), ask.occlusion.end(), -5.0f);
    ask.position[0][4] = std::nanf("");
    ask.run();
    EXPECT_EQ(ask.occlusion[1], -5);
    EXPECT_EQ(ask.occlusion[4], 0) << "nowhere";
    EXPECT_GE(ask.occlusion[6], 0);
  }
}

} // namespace
} // namespace render::testing
