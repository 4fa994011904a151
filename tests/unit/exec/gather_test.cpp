// gather and traverse: which rays are shot, which block runs for each, what the variables are, how loops are
// left.
#include "slvm/kernels/table.h"
#include "tests/unit/exec/ray_scene.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <optional>

namespace slvm {
namespace {

using namespace test;

/// Surfaces on the square at z = 1; the rays go to +z.
class Gather : public testing::Test {
protected:
  /// Runs the statements and returns what they leave in `result`, a float, at each point.
  std::vector<float> run(const std::string& statements, int nu = 3, int nv = 2) {
    surface_ = instantiate(*machine_, source(statements));
    return surface_ ? shade(nu, nv) : std::vector<float>();
  }
  static std::string source(const std::string& statements) {
    return "surface s(output varying float result = 0;) {\n" + statements + "\n}";
  }
  std::vector<float> shade(int nu, int nv) {
    Grid grid = square(nu, nv);
    grid.id = 11;
    ShadingContext context(*machine_, services_);
    context.shade({.surface = surface_.get()}, grid);
    const Planes* planes = context.output(*surface_, "result");
    std::vector<float> out;
    for (size_t i = 0; i < grid.points(); ++i)
      out.push_back(planes->get(0, i));
    return out;
  }
  static std::vector<float> all(float x, size_t points = 6) { return std::vector<float>(points, x); }

  std::optional<Machine> machine_{std::in_place};
  RayServicesScene services_;
  RayScene& scene_ = services_.scene;
  std::unique_ptr<Instance> surface_;
};

TEST_F(Gather, BodyRunsForHitsElseForMisses) {
  scene_.surfaces = {sphere_at({0.5, 0.5, 4}, 1)};
  const auto hits = run("gather(\"\", P, vector (0, 0, 1), PI / 4, 64) result += 1;");
  const auto misses = run("gather(\"\", P, vector (0, 0, 1), PI / 4, 64) ; else result += 1;");
  const auto both = run("gather(\"\", P, vector (0, 0, 1), PI / 4, 64) result += 1; else result += 1;");
  EXPECT_EQ(both, all(64));
  for (size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i] + misses[i], 64);
    EXPECT_GT(hits[i], 0);
    EXPECT_GT(misses[i], 0);
  }
}

TEST_F(Gather, AngleZeroIsExactlyTheDirection) {
  run("gather(\"\", P, 3 * vector (1, 2, 2), 0, 3, \"samplebase\", 0) result += 1; else result += 1;");
  ASSERT_EQ(scene_.rays.size(), 18u);
  for (const AskedRay& ray : scene_.rays) {
    EXPECT_EQ(ray.direction, (Vec{1.0f / 3, 2.0f / 3, 2.0f / 3}));
    EXPECT_EQ(ray.origin[2], 1);
    EXPECT_EQ(ray.origin[0], ray.point % 3 * 0.5);
  }
}

TEST_F(Gather, SetsVariablesBeforeTheBody) {
  TestSurface plane = plane_at(5, {0.5f, 0.25f, 0.125f});
  plane.variables["surface:mine"] = {Type::kFloat, 0, {7}, {}};
  plane.variables["surface:three"] = {Type::kFloat, 3, {1, 2, 4}, {}};
  plane.variables["attribute:user:depth"] = {Type::kFloat, 0, {9}, {}};
  scene_.surfaces = {plane};
  const auto values = run(R"(
    color c = 0; normal n = 0; point p = 0, o = 0; vector d = 0; float l = -1, m = 0, a = 0, t[3] = {0, 0, 0};
    gather("illuminance", P, vector (0, 0, 1), 0, 1, "surface:Ci", c, "primitive:N", n, "surface:P", p, "ray:origin", o,
           "ray:direction", d, "ray:length", l, "surface:mine", m, "surface:three", t, "attribute:user:depth", a) {
      result = comp(c, 0) + 10 * comp(c, 1) + 100 * comp(c, 2) + zcomp(n) * 1000 + zcomp(d) * 2000;
      if (distance(p, P + vector (0, 0, 4)) > 1e-5 || o != P) result = -1;
      result += l * 10000 + m + t[0] + t[1] + t[2] + a;
    })");
  EXPECT_EQ(values, all(0.5f + 2.5f + 12.5f + 1000 + 2000 + 40000 + 7 + 7 + 9));
  EXPECT_EQ(scene_.calls[0].outputs,
            (std::vector<std::string>{"surface:Ci", "primitive:N", "surface:P", "surface:mine",
                                      "surface:three", "attribute:user:depth"}));
}

TEST_F(Gather, WhatIsMissingKeepsItsValue) {
  scene_.surfaces = {plane_at(5)};
  EXPECT_EQ(run("float x = 3; color y = 5; gather(\"\", P, vector (0, 0, 1), 0, 1, \"surface:none\", x, "
                "\"primitive:N\", y) "
                "result = x + comp(y, 1);"),
            all(3))
      << "a normal as a colour has the planes of one, and is found";
  EXPECT_EQ(run("float x = 3, d = 8; gather(\"\", P, vector (0, 0, -1), 0, 1, \"ray:length\", d) "
                "result = 1; else result = x + d;"),
            all(11));
}

TEST_F(Gather, DistancesAreAskedForWhereTheyAreSeen) {
  scene_.surfaces = {plane_at(5)};
  const std::string rays = "P, vector (0, 0, 1), 0, 1";
  EXPECT_EQ(run("gather(\"\", " + rays + ") result = 1; else result = 2;"), all(1));
  EXPECT_EQ(run("vector d = 0; gather(\"occlusion\", " + rays + ", \"ray:direction\", d) result = zcomp(d);"),
            all(1));
  EXPECT_EQ(run("float d = 0; gather(\"\", " + rays + ", \"ray:length\", d) result = d;"), all(4));
  ASSERT_EQ(scene_.calls.size(), 3u);
  EXPECT_FALSE(scene_.calls[0].wants_distance);
  EXPECT_FALSE(scene_.calls[1].wants_distance);
  EXPECT_TRUE(scene_.calls[2].wants_distance);
}

TEST_F(Gather, DirectionAndOriginAreKnownForMissesToo) {
  EXPECT_EQ(run("vector d = 0; point o = 0; gather(\"\", P, vector (0, 3, 0), 0, 1, \"ray:direction\", d, "
                "\"ray:origin\", o) "
                "result = -1; else result = ycomp(d) + 10 * zcomp(o);"),
            all(11));
}

TEST_F(Gather, BreakLeavesNoRayUnseen) {
  scene_.surfaces = {plane_at(5)};
  // The course's adaptive loop: five rays where all agree.
  EXPECT_EQ(run(R"(float hits = 0, count = 0;
    gather("occlusion", P, vector (0, 0, 1), 0, 32) {
      if (count >= 4 && hits == count) break;
      hits += 1; count += 1;
    } else {
      if (count >= 4 && hits == 0) break;
      count += 1;
    }
    result = count;)"),
            all(4));
  EXPECT_EQ(scene_.rays.size(), 5u * 6);
  EXPECT_FALSE(scene_.calls[0].shades);
}

TEST_F(Gather, PointsLeaveOneByOne) {
  scene_.surfaces = {plane_at(5)};
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, 1), 0, 8) { result += 1; if (result > 2 * s) break; }", 4, 1),
            (std::vector<float>{1, 1, 2, 3}));
  EXPECT_EQ(scene_.rays.size(), 1u + 1 + 2 + 3);
}

TEST_F(Gather, WithoutBreakAllRaysGoInFewBatches) {
  scene_.surfaces = {plane_at(5)};
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, 1), 0.1, 100) { if (u > 2) continue; result += 1; }"),
            all(100));
  EXPECT_EQ(scene_.calls.size(), 1u);
  EXPECT_EQ(scene_.calls[0].rays, 600u);
}

TEST_F(Gather, BatchesAreBounded) {
  surface_ = instantiate(
      *machine_, source("gather(\"\", P, vector (0, 0, 1), 0.1, 100) result += 1; else result += 1;"));
  EXPECT_EQ(shade(40, 40), all(100, 1600));
  ASSERT_EQ(scene_.rays.size(), 160000u);
  EXPECT_EQ(scene_.calls.size(), 10u);
  for (const AskedCall& call : scene_.calls)
    EXPECT_LE(call.rays, 16384u);
}

TEST_F(Gather, OnlyActivePointsShoot) {
  scene_.surfaces = {plane_at(5)};
  EXPECT_EQ(
      run("if (u > 0.7) { gather(\"\", P, vector (0, 0, 1), 0, 4) result += 1; } else result = 9;", 4, 1),
      (std::vector<float>{9, 9, 9, 4}));
  ASSERT_EQ(scene_.rays.size(), 4u);
  for (const AskedRay& ray : scene_.rays)
    EXPECT_EQ(ray.point, 3u);
  scene_.forget();
  EXPECT_EQ(run("if (u > 2) gather(\"\", P, vector (0, 0, 1), 0, 4) result += 1;"), all(0));
  EXPECT_TRUE(scene_.rays.empty());
}

TEST_F(Gather, SamplesMayDifferFromPointToPoint) {
  scene_.surfaces = {plane_at(5)};
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, 1), 0, 1 + 3 * u) result += 1;", 4, 1),
            (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(scene_.rays.size(), 10u);
  scene_.forget();
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, 1), 0, 9, \"samplecount\", 2) result += 1;"), all(2));
}

TEST_F(Gather, WithoutSamplesTheLoopIsOver) {
  // As shaders have it that look at what kind of ray hit them: samples = type == "diffuse" ? 0 : 16.
  scene_.surfaces = {plane_at(5)};
  for (const char* angle : {"0", "PI / 2"}) {
    scene_.forget();
    EXPECT_EQ(
        run(fmt::format(
                "color c = 0; gather(\"\", P, vector (0, 0, 1), {}, 3 * u, \"surface:Ci\", c) result += "
                "1; else result += 10;",
                angle),
            4, 1)[0],
        0);
    EXPECT_EQ(scene_.rays.size(), 6u) << angle;
  }
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, 1), 0, 0) result += 1; else result += 10;"), all(0));
}

TEST_F(Gather, BreaksAndContinuesOfTwoLevels) {
  scene_.surfaces = {plane_at(5)};
  EXPECT_EQ(run(R"(float i;
    for (i = 0; i < 4; i += 1)
      gather("", P, vector (0, 0, 1), 0, 3) { result += 1; if (i == 2) break 2; }
    result += 100 * i;)"),
            all(207));
  EXPECT_EQ(run(R"(float i;
    for (i = 0; i < 4; i += 1) {
      gather("", P, vector (0, 0, 1), 0, 3) { result += 1; if (u > 0.3) continue 2; }
      result += 10;
    })"),
            (std::vector<float>{52, 4, 4, 52, 4, 4}));
  EXPECT_EQ(run(R"(
    gather("", P, vector (0, 0, 1), 0, 3) {
      gather("", P, vector (0, 0, -1), 0, 5) ; else { result += 1; if (result >= 7) break 2; }
      result += 100;
    })"),
            all(106));
}

TEST_F(Gather, InFunctionsAndLeftByReturn) {
  scene_.surfaces = {plane_at(5, {0.5f, 0, 0})};
  const std::string source = R"(
    float first(point p; vector d; float n) {
      color c = 0;
      gather("", p, d, 0, n, "surface:Ci", c) { return comp(c, 0); } else return -1;
      return -2;
    }
    surface s(output varying float result = 0;) { result = first(P, vector (0, 0, 1 - 2 * u), 4); })";
  surface_ = instantiate(*machine_, source);
  EXPECT_EQ(shade(2, 1), (std::vector<float>{0.5f, -1}));
  EXPECT_EQ(scene_.rays.size(), 2u);
}

TEST_F(Gather, NestedLoopsKeepTheirOwnRays) {
  scene_.surfaces = {plane_at(5, {0.5f, 0, 0}), plane_at(-3, {0.25f, 0, 0})};
  EXPECT_EQ(run(R"(color a = 0, b = 0;
    gather("", P, vector (0, 0, 1), 0, 2, "surface:Ci", a) {
      gather("", P, vector (0, 0, -1), 0, 3, "surface:Ci", b) result += comp(a, 0) + 10 * comp(b, 0);
      result += comp(a, 0) * 100;
    })"),
            all(2 * (3 * 3.0f + 50)));
}

TEST_F(Gather, InLightLoopsAndInLights) {
  scene_.surfaces = {plane_at(5)};
  auto light = instantiate(*machine_, R"(light l() {
    illuminate (point (0, 0, -2)) {
      float hits = 0;
      gather("", Ps, vector (0, 0, 1), 0, 2) hits += 1;
      Cl = hits;
    } })");
  services_.light_list = {light.get(), light.get()};
  EXPECT_EQ(run(R"(illuminance (P) {
      float hits = 0;
      gather("", P, vector (0, 0, 1), 0, 3) hits += 1;
      result += comp(Cl, 0) + 10 * hits;
    })"),
            all(64));
}

TEST_F(Gather, RaysThatAreNotShotRunNeitherBlock) {
  scene_.surfaces = {plane_at(5)};
  scene_.too_deep = {1, 2};
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, 1), 0, 4) result += 1; else result += 100;"), all(2));
  EXPECT_EQ(
      run("float n = 0; gather(\"\", P, vector (0, 0, 1), 0, 4) { result += 1; if (result == 2) break; }"),
      all(2));
}

TEST_F(Gather, WithoutDirectionNothingIsShot) {
  scene_.surfaces = {plane_at(5)};
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, u), 0, 2) result += 1; else result += 100;", 3, 1),
            (std::vector<float>{200, 2, 2}));
  EXPECT_EQ(scene_.rays.size(), 4u);
}

TEST_F(Gather, WhereNobodyTracesEverythingMisses) {
  services_.traces = false;
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, 1), 0, 4) result += 1; else result += 100;"), all(400));
  ASSERT_EQ(machine_->messages().size(), 1u);
  EXPECT_EQ(machine_->messages()[0].text, "nobody traces rays here: they hit nothing");
  EXPECT_EQ(machine_->messages()[0].line, 2u);
  EXPECT_EQ(machine_->messages()[0].points, 6u);
}

TEST_F(Gather, OptionalArgumentsArrive) {
  run("gather(\"illuminance\", P, vector (0, 0, 1), PI / 2, 2, \"label\", \"mine\", \"subset\", \"a,-b\", "
      "\"hitsides\", "
      "\"front\", \"hitmode\", \"primitive\", \"bias\", 0.5 + u, \"maxdist\", 3 * (1 + u), \"weight\", color "
      "(0.5, u, 1)) result = 1;",
      2, 1);
  ASSERT_EQ(scene_.calls.size(), 1u);
  const AskedCall& call = scene_.calls[0];
  EXPECT_EQ(call.label, "mine");
  EXPECT_EQ(call.subset, "a,-b");
  EXPECT_EQ(call.sides, HitSides::kFront);
  EXPECT_EQ(call.mode, HitMode::kPrimitive);
  EXPECT_EQ(call.kind, RayKind::kDiffuse);
  for (const AskedRay& ray : scene_.rays) {
    EXPECT_EQ(ray.bias, 0.5 + ray.point);
    EXPECT_EQ(ray.max_distance, 3.0 * (1 + ray.point));
    EXPECT_EQ(ray.weight, (Vec{0.5, static_cast<double>(ray.point), 1}));
  }
}

TEST_F(Gather, WrongWordsAreReported) {
  run("gather(\"\", P, vector (0, 0, 1), 0, 1, \"hitsides\", \"outside\", \"hitmode\", \"fast\") result = "
      "1;");
  std::vector<std::string> texts;
  for (const RuntimeMessage& m : machine_->messages())
    texts.push_back(m.text);
  EXPECT_EQ(texts,
            (std::vector<std::string>{"gather: \"hitmode\" is default or primitive or shader, not \"fast\"",
                                      "gather: \"hitsides\" is both or front or back, not \"outside\""}));
}

TEST_F(Gather, NarrowConesAreSpecular) {
  auto kind = [&](const std::string& angle) {
    scene_.forget();
    run("gather(\"\", P, vector (0, 0, 1), " + angle + ", 1) result = 1;");
    return scene_.calls.at(0).kind;
  };
  EXPECT_EQ(kind("0"), RayKind::kSpecular);
  EXPECT_EQ(kind("radians(9.9)"), RayKind::kSpecular);
  EXPECT_EQ(kind("radians(10.1)"), RayKind::kDiffuse);
  services_.options["trace:specularthreshold"] = {Type::kFloat, 0, {40}, {}};
  EXPECT_EQ(kind("radians(39)"), RayKind::kSpecular);
  EXPECT_EQ(kind("PI / 2"), RayKind::kDiffuse);
}

TEST_F(Gather, SamplePatternShootsNothing) {
  EXPECT_EQ(
      run("vector d = 0, r = 0; gather(\"samplepattern\", P, vector (0, 0, 1), PI / 2, 16, "
          "\"ray:direction\", d, "
          "\"sample:randompair\", r) { result += zcomp(d) > 0 && xcomp(r) < 1 && ycomp(r) >= 0 ? 1 : -100; } "
          "else result = -1;"),
      all(16));
  EXPECT_TRUE(scene_.rays.empty());
}

TEST_F(Gather, MapsGiveDirections) {
  // 1 / (density n) each: all together the half sphere the map's light comes from, weighted by its sixth.
  const auto solid =
      run("float w = 0; color c = 0; vector d = 0; gather(\"environment:sky\", P, vector (0, 0, 0), 0, 8, "
          "\"environment:solidangle\", w, \"environment:color\", c, \"environment:direction\", d) "
          "result += w * comp(c, 2) * (ycomp(d) >= 0.5 ? 1 : 100);");
  for (float x : solid)
    EXPECT_NEAR(x, 3 * std::numbers::pi, 1e-4);
  EXPECT_TRUE(scene_.rays.empty());
  // Rays that go there; those outside the cone are neither hits nor misses.
  scene_.surfaces = {sphere_at({0, 0, 0}, 100)};
  EXPECT_EQ(run("gather(\"\", P, vector (0, 1, 0), PI / 2, 8, \"distribution\", \"sky\") result += 1; else "
                "result = -1;"),
            all(8));
  EXPECT_EQ(scene_.rays.size(), 48u);
  scene_.forget();
  EXPECT_EQ(run("gather(\"\", P, vector (0, -1, 0), PI / 2, 8, \"distribution\", \"sky\") result += 1; else "
                "result = -1;"),
            all(0));
  EXPECT_TRUE(scene_.rays.empty());
  scene_.map_problem = "cannot be read";
  EXPECT_EQ(run("gather(\"environment:sky\", P, vector (0, 0, 0), 0, 8) result += 1; else result += 1;"),
            all(0));
  EXPECT_EQ(machine_->messages().at(0).text, "environment \"sky\": cannot be read");
}

TEST_F(Gather, EffectiveBias) {
  EXPECT_EQ(
      run("float b = 0; gather(\"\", P, vector (0, 0, 1), 0, 1, \"effectivebias\", b) ; else result = b;"),
      all(0.01f));
  services_.attributes["trace:bias"] = {Type::kFloat, 0, {0.25f}, {}};
  EXPECT_EQ(
      run("float b = 0; gather(\"\", P, vector (0, 0, 1), 0, 1, \"effectivebias\", b) ; else result = b;"),
      all(0.25f));
  EXPECT_EQ(run("float b = 0; gather(\"\", P, vector (0, 0, 1), 0, 1, \"bias\", 0.5, \"effectivebias\", b) ; "
                "else result = b;"),
            all(0.5f));
}

TEST_F(Gather, LoopsOverRaysEndInTime) {
  machine_.emplace(MachineOptions{.most_rounds = 10});
  EXPECT_EQ(run("gather(\"\", P, vector (0, 0, 1), 0, 100) ; else result += 1;"), all(10));
  EXPECT_EQ(machine_->messages().at(0).text, "a loop has not ended after 10 rounds, and is left");
}

TEST_F(Gather, HugeArraysOfManyPointsAreNotBrought) {
  surface_ = instantiate(
      *machine_, source("float big[20000]; gather(\"\", P, vector (0, 0, 1), 0, 1, \"surface:big\", big) ; "
                        "else result = 1 + big[5];"));
  EXPECT_EQ(shade(30, 30), all(1, 900));
  ASSERT_EQ(machine_->messages().size(), 1u);
  EXPECT_EQ(machine_->messages()[0].text,
            "\"surface:big\": arrays of 20000 elements are too much for 900 rays");
}

// ---- traverse

TEST_F(Gather, TraverseMeetsSurfacesInOrder) {
  scene_.surfaces = {plane_at(9, {0.25f, 0, 0}), plane_at(3, {1, 0, 0}), plane_at(5, {0.5f, 0, 0})};
  EXPECT_EQ(run("float w = 1, d = 0; color c = 0; traverse(\"\", P, vector (0, 0, 1), \"surface:Ci\", c, "
                "\"ray:length\", d) { "
                "result += w * (comp(c, 0) + 100 * d); w *= 10; } else result = -1;"),
            all(1 + 200 + 10 * (0.5f + 400) + 100 * (0.25f + 800)));
  EXPECT_EQ(run("traverse(\"\", P, vector (0, 0, -1)) result += 1; else result += 100;"), all(100));
  EXPECT_EQ(
      run("traverse(\"\", P, vector (0, 0, 1 - 2 * u), \"maxdist\", 5) result += 1; else result += 100;", 2,
          1),
      (std::vector<float>{2, 100}));
}

TEST_F(Gather, BreakStopsTraversal) {
  scene_.surfaces = {plane_at(2), plane_at(3), plane_at(4)};
  EXPECT_EQ(run("traverse(\"\", P, vector (0, 0, 1)) { result += 1; if (result > 2 * u) break; }", 3, 1),
            (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(scene_.rays.size(), 1u + 2 + 3);
}

TEST_F(Gather, SurfacesInOnePlaceAreMetOneByOne) {
  scene_.surfaces = {plane_at(2), plane_at(2), sphere_at({0, 0, 2}, 50)};
  EXPECT_EQ(run("traverse(\"\", P, vector (0, 0, 1)) result += 1;"), all(3));
}

// ---- Derivatives: rays that chance spreads tell nothing of their neighbours.

TEST_F(Gather, ScatteredValuesHaveNoDerivatives) {
  scene_.surfaces = {plane_at(5)};
  const std::string body =
      "point p = 0; gather(\"\", P, vector (0, 0, 1), {}, 1, \"surface:P\", p) result = length(Du(p));";
  EXPECT_EQ(run(fmt::format(fmt::runtime(body), "0.2")), all(0));
  EXPECT_EQ(run(fmt::format(fmt::runtime(body), "0")), all(1));
}

TEST_F(Gather, DifferentialsOnlyWhereSomethingIsShaded) {
  run("gather(\"\", P, vector (0, 0, 1), 0, 1) result = 1;");
  EXPECT_FALSE(scene_.rays.at(0).has_differentials);
  scene_.forget();
  run("normal n = 0; gather(\"\", P, vector (0, 0, 1), 0, 1, \"primitive:N\", n) result = zcomp(n);");
  EXPECT_FALSE(scene_.rays.at(0).has_differentials);
  scene_.forget();
  run("color c = 0; gather(\"occlusion\", P, vector (0, 0, 1), 0, 1, \"surface:Ci\", c) result = comp(c, "
      "0);");
  EXPECT_FALSE(scene_.rays.at(0).has_differentials);
  scene_.forget();
  run("color c = 0; gather(\"\", P, vector (0, 0, 1), 0, 1, \"surface:Ci\", c) result = comp(c, 0);");
  EXPECT_TRUE(scene_.rays.at(0).has_differentials);
}

TEST_F(Gather, DifferentialsAreThoseOfTheUnitDirection) {
  run("color c = 0; gather(\"\", P, vector P, 0, 1, \"surface:Ci\", c) result = comp(c, 0);", 65, 65);
  for (const AskedRay& ray : scene_.rays) {
    const double x = ray.origin[0], y = ray.origin[1], l = std::sqrt(x * x + y * y + 1), step = 1.0 / 64;
    EXPECT_NEAR(ray.origin_du[0], step, 1e-6);
    EXPECT_NEAR(ray.origin_dv[1], step, 1e-6);
    // d/dx of (x, y, 1) / l, at the edges too, where differences are one-sided.
    EXPECT_NEAR(ray.direction_du[0], step * (1 / l - x * x / (l * l * l)), 1e-5);
    EXPECT_NEAR(ray.direction_du[1], step * (-x * y / (l * l * l)), 1e-5);
    EXPECT_NEAR(ray.direction_dv[2], step * (-y / (l * l * l)), 1e-5);
  }
}

TEST_F(Gather, ConesWidenDifferentials) {
  run("color c = 0; gather(\"\", P, vector (0, 0, 1), PI / 3, 16, \"surface:Ci\", c, \"samplebase\", 0) "
      "result += 1; else result += 1;");
  const double side = std::sqrt(2 * std::numbers::pi * (1 - std::cos(std::numbers::pi / 3)) / 16);
  auto dot = [](const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  for (const AskedRay& ray : scene_.rays) {
    EXPECT_NEAR(dot(ray.direction_du, ray.direction_du), side * side, 1e-5);
    EXPECT_NEAR(dot(ray.direction_dv, ray.direction_dv), side * side, 1e-5);
    EXPECT_NEAR(dot(ray.direction_du, ray.direction_dv), 0, 1e-5);
    EXPECT_NEAR(dot(ray.direction_du, ray.direction), 0, 1e-5);
  }
}

// ---- What must not matter.

constexpr const char* kMixed = R"(
float visible(point p; vector d) {
  float n = 0;
  gather("", p, d, 0.3, 3 + 4 * u) { n += 1; if (n > 3) return n; }
  return -n;
}
surface s(output varying float result = 0; float k = 0.4) {
  color c = 0; point p = 0; vector d = 0;
  float i;
  if (v < 0.8) {
    for (i = 0; i < 2; i += 1)
      gather("", P, vector (0, 0, 1), k, 7, "surface:Ci", c, "surface:P", p, "ray:direction", d, "distribution", "cosine") {
        result += comp(c, 0) + xcomp(p);
        if (xcomp(p) > 0.9) continue;
        if (ycomp(p) > 1.2) break 2;
        traverse("", p, vector (0, u - 0.5, 1), "surface:P", p) { result += zcomp(p); if (zcomp(p) > 6) break; }
      } else result += zcomp(d);
  }
  result += visible(P, vector (u - v, 0.1, 1)) + comp(trace(P, vector (0, v, 1), "samples", 4, "samplecone", 0.3), 0);
})";

std::vector<float> shade_mixed(const Machine& machine, int level, RayServicesScene& services) {
  services.scene.surfaces = {sphere_at({0.4, 0.6, 3}, 0.7, {0.5f, 1, 1}), plane_at(5, {0.25f, 1, 1}),
                             plane_at(7)};
  auto shader = machine.load(compile(kMixed, level));
  auto surface = machine.instantiate(*shader, {});
  Grid grid = square(17, 5);
  grid.id = 3;
  ShadingContext context(machine, services);
  context.shade({.surface = surface->get()}, grid);
  std::vector<float> out;
  for (size_t i = 0; i < grid.points(); ++i)
    out.push_back(context.output(**surface, "result")->get(0, i));
  return out;
}

TEST(GatherDeterminism, StripsLevelsAndSpecialisationDoNotMatter) {
  RayServicesScene services;
  const std::vector<float> expected =
      shade_mixed(Machine({.strip_points = 4096, .specialise = false}), 0, services);
  const size_t rays = services.scene.rays.size();
  for (int level : {0, 1, 2})
    for (uint32_t strip : {16u, 80u, 256u})
      for (bool specialise : {false, true}) {
        services.scene.forget();
        EXPECT_EQ(
            shade_mixed(Machine({.strip_points = strip, .specialise = specialise, .poison_registers = true}),
                        level, services),
            expected)
            << "-O" << level << " strips of " << strip << " specialise " << specialise;
        EXPECT_EQ(services.scene.rays.size(), rays);
      }
}

TEST(GatherDeterminism, TargetsShootTheSameRays) {
  RayServicesScene services;
  const std::vector<float> expected = shade_mixed(Machine({.target = "EMU128"}), 2, services);
  for (const char* target : kernel_targets()) {
    const std::vector<float> got = shade_mixed(Machine({.target = target}), 2, services);
    for (size_t i = 0; i < got.size(); ++i)
      EXPECT_NEAR(got[i], expected[i], 1e-4) << target << " point " << i;
  }
}

} // namespace
} // namespace slvm
