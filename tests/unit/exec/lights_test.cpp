// Lights on grids: what they emit, cones, categories, messages, and that results are kept while they hold.
#include "tests/unit/exec/shading.h"

#include <cmath>
#include <gmock/gmock.h>

namespace slvm {
namespace {

using namespace test;
using ::testing::Each;
using ::testing::FloatNear;

struct LightsTest : ::testing::Test {
  Machine machine;
  TableServices services;
  std::vector<std::unique_ptr<Instance>> lights;

  void add(const std::string& source, std::vector<ParamValue> params = {}) {
    lights.push_back(instantiate(machine, source, std::move(params)));
    services.light_list.push_back(lights.back().get());
  }
  std::vector<float> shade(const std::string& source, size_t component = 0) {
    auto surface = instantiate(machine, source);
    Grid grid = square(4, 4);
    ShadingContext context(machine, services);
    context.shade({.surface = surface.get()}, grid);
    return red(grid, component);
  }
};

constexpr const char* kSun =
    "light sun(float i = 1; string __category = \"\") { solar(vector (0, 0, 2), 0) { Cl = i; } }";
constexpr const char* kPoint = "light p(point from = (0, 0, 0)) { illuminate(from) { Cl = 1 / (L . L); } }";
constexpr const char* kCount = "surface s() { float n = 0; illuminance(P, N, PI) { n += 1; } Ci = n; }";

TEST_F(LightsTest, SolarLightIsUnitLengthAndReversedOnTheSurface) {
  add(kSun);
  EXPECT_THAT(shade("surface s() { illuminance(P) { Ci = color L; } }", 2), Each(-1.0f));
}

TEST_F(LightsTest, IlluminateGivesTheDistance) {
  add(kPoint);
  std::vector<float> d = shade("surface s() { illuminance(P) { Ci = length(L) - length(P); } }");
  EXPECT_THAT(d, Each(FloatNear(0, 1e-6f)));
}

TEST_F(LightsTest, SurfaceConeSelectsLanes) {
  add(kSun);
  EXPECT_THAT(shade(kCount), Each(1.0f));
  EXPECT_THAT(shade("surface s() { float n = 0; illuminance(P, -N, PI/2) { n += 1; } Ci = n; }"), Each(0.0f));
}

TEST_F(LightsTest, LightConeSelectsPoints) {
  add("light spot() { illuminate(point (0, 0, 0), vector (0, 0, 1), PI/6) { Cl = 1; } }");
  std::vector<float> lit = shade(kCount); // x^2 + y^2 <= tan(30 degrees)^2 = 1/3 at z = 1
  for (int j = 0, i = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k, ++i)
      EXPECT_EQ(lit[static_cast<size_t>(i)], j * j + k * k <= 3 ? 1 : 0) << k << " " << j;
}

TEST_F(LightsTest, AmbientLightsAreApart) {
  add("light a() { Cl = color(0.25, 0, 0); }");
  add("light b() { Cl = 0.5; }");
  add(kSun);
  EXPECT_THAT(shade("surface s() { Ci = ambient(); }"), Each(0.75f));
  EXPECT_THAT(shade(kCount), Each(1.0f));
}

TEST_F(LightsTest, SeveralBlocksAreSeveralEmitters) {
  add("light two() { illuminate(point (0, 0, 0)) { Cl = 1; } solar(vector (0, 0, 1), 0) { Cl = 10; } }");
  EXPECT_THAT(shade("surface s() { color c = 0; illuminance(P) { c += Cl; } Ci = c; }"), Each(11.0f));
}

TEST_F(LightsTest, ColourFinishedAfterTheBlockCounts) {
  add("light late() { illuminate(point (0, 0, 0)) { Cl = 1; } Cl *= 3; }");
  EXPECT_THAT(shade("surface s() { illuminance(P) { Ci = Cl; } }"), Each(3.0f));
}

TEST_F(LightsTest, Categories) {
  add(kSun, {number("i", 1), {"__category", {Type::kString, 0, {}, {"key, hero"}}}});
  add(kSun, {number("i", 10), {"__category", {Type::kString, 0, {}, {"fill"}}}});
  add(kSun, {number("i", 100)});
  auto sum = [&](const std::string& category) {
    return shade("surface s() { color c = 0; illuminance(\"" + category +
                 "\", P, N, PI) { c += Cl; } Ci = c; }")[0];
  };
  EXPECT_EQ(sum(""), 111);
  EXPECT_EQ(sum("hero"), 1);
  EXPECT_EQ(sum("fill"), 10);
  EXPECT_EQ(sum("-fill"), 101);
  EXPECT_EQ(sum("key,fill"), 11);
  EXPECT_EQ(sum("other"), 0);
}

TEST_F(LightsTest, LightsourceReadsTheCurrentLight) {
  add(kSun, {number("i", 3)});
  add(kSun, {number("i", 4)});
  EXPECT_THAT(shade("surface s() { float n = 0; illuminance(P) { float i = 100; lightsource(\"i\", i); n += "
                    "i; } Ci = n; }"),
              Each(7.0f));
  EXPECT_THAT(shade("surface s() { float n = 0; illuminance(P) { float x = 100; n += lightsource(\"none\", "
                    "x) + x; } Ci = n; }"),
              Each(200.0f));
}

TEST_F(LightsTest, NondiffuseAndNonspecular) {
  add("light l(float __nondiffuse = 0.25; output float __nonspecular = 1) { solar(vector (0, 0, 1), 0) { Cl "
      "= 1; } }");
  EXPECT_THAT(shade("surface s() { Ci = diffuse(normalize(N)); }"), Each(0.75f));
  EXPECT_THAT(shade("surface s() { Ci = specular(normalize(N), vector (0, 0, -1), 0.1); }"), Each(0.0f));
}

TEST_F(LightsTest, LightsReadTheSurface) {
  add("light l() { float k = -1; surface(\"k\", k); illuminate(point (0, 0, 0)) { Cl = k; } }");
  EXPECT_THAT(shade("surface s(output float k = 2) { illuminance(P) { Ci = Cl; } }"), Each(2.0f));
  // The value of the moment: output parameters are stored before lights run.
  EXPECT_THAT(shade("surface s(output varying float k = 2) { k = 5; illuminance(P) { Ci = Cl; } }"),
              Each(5.0f));
}

TEST_F(LightsTest, BreakLeavesTheLightLoop) {
  add(kSun);
  add(kSun);
  EXPECT_THAT(shade("surface s() { float n = 0; illuminance(P) { n += 1; if (u >= 0) break; } Ci = n; }"),
              Each(1.0f));
}

TEST_F(LightsTest, OtherPositionsRunTheLightAgain) {
  add(kPoint);
  std::vector<float> c = shade("surface s() { color a = 0, b = 0; illuminance(P) { a = Cl; } illuminance(2 * "
                               "P) { b = Cl; } Ci = a / b; }");
  EXPECT_THAT(c, Each(FloatNear(4, 1e-5f)));
}

TEST_F(LightsTest, ALightByItself) {
  auto light = instantiate(machine, kPoint);
  Grid grid = square(3, 1);
  ShadingContext context(machine, services);
  context.run(*light, grid);
  EXPECT_FLOAT_EQ(grid.variable(Global::kCl).get(0, 0), 1);
  EXPECT_FLOAT_EQ(grid.variable(Global::kCl).get(0, 2), 0.5f);
  EXPECT_FLOAT_EQ(grid.variable(Global::kL).get(2, 2), 1);
}

} // namespace
} // namespace slvm
