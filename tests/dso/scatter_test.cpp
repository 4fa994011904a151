// The calls of scatter maps, as the course's shader makes them.
#include "stdlib/subsurface/scatter_cache.h"
#include "tests/dso/with_plugin.h"
#include "tests/unit/subsurface/surfaces.h"

#include <thread>

namespace subsurface::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ScatterCalls : public WithPlugin {
protected:
  void SetUp() override {
    skin_ = ball(3000, 1.2f);
    save("skin.ply", skin_);
  }
  std::string loop(const std::string& light, const std::string& before = "", const std::string& after = "") {
    return "ScatterDSOReadMap(" + quoted("skin.ply") +
           "); point p = 0; normal n = 0; float a = 0; float i = ScatterDSOAddGridPoint(P, .3);" + before +
           "while (ScatterDSOGetSample(p, n, a) == 1) { " + after + " ScatterDSOSaveIrradiance(" + light +
           "); }" + "Ci = ScatterDSOScatter(i, P, normalize(normal(P)), .3, color(1, 2, 1));";
  }
  PointCloud skin_;
};

TEST_F(ScatterCalls, SumIsThatOfTheLibrary) {
  const auto got = run(loop("color(xcomp(p), zcomp(n), a)"), 6, 4);
  EXPECT_THAT(messages(), IsEmpty());
  const ScatterMap map = *ScatterMap::build(skin_);
  for (size_t g = 0; g < got.size(); ++g) {
    const Vec3 P{static_cast<float>(g % 6) / 5, static_cast<float>(g / 6) / 3, 1};
    double sum[3] = {};
    for (size_t i = 0; i < map.size(); ++i) {
      const Vec3 Pi = map.position(i);
      const float w = map.area(i) * scatter_transmission(length(P - Pi), 0.3f) *
                      bounce_attenuation(P, Pi, normalize(P), map.normal(i), 0.3f);
      const float light[] = {Pi.x, 2 * map.normal(i).z, map.area(i)};
      for (int c = 0; c < 3; ++c)
        sum[c] += static_cast<double>(light[c] * w);
    }
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(got[g][c], sum[c], 1e-4 * std::abs(sum[c]) + 1e-6) << g;
  }
}

TEST_F(ScatterCalls, LightThatIsTheSameForAllSamples) {
  for (const Color& c : run(loop("color(1)"), 6, 4)) {
    EXPECT_GE(c.x, 0);
    EXPECT_EQ(c.y, 2 * c.x);
  }
  const auto on_the_ball = run("P = point(0, 0, 1.2); N = normal(0, 0, 1);" + loop("color(1)"), 1);
  EXPECT_NEAR(on_the_ball[0].x, 1, 0.03);
}

// Each sample is lit once, whatever number of grids need it.
TEST_F(ScatterCalls, SamplesAreLitOnce) {
  const std::string count = "float runs = 0;", body = "runs += 1;";
  auto lit = [&] {
    double sum = 0;
    for (const Color& c : run(loop("color(1)", count, body) + "Ci = runs;", 6, 4))
      sum += static_cast<double>(c.x);
    return sum;
  };
  const double first = lit();
  EXPECT_GT(first, 50);
  EXPECT_EQ(std::fmod(first, 24), 0); // passes are full
  EXPECT_EQ(lit(), 0);
}

TEST_F(ScatterCalls, CallsWithoutAMapSayWhatIsMissing) {
  run("point p = 0; normal n = 0; float a = 0; Ci = ScatterDSOAddGridPoint(P, 1); if (ScatterDSOGetSample(p, "
      "n, a) == 1) Ci = 1;"
      "ScatterDSOSaveIrradiance(1); Ci = ScatterDSOScatter(0, P, N, 1, 1);",
      1);
  std::string all;
  for (const std::string& m : messages())
    all += m + "\n";
  for (std::string function : {"ScatterDSOAddGridPoint()", "ScatterDSOGetSample()",
                               "ScatterDSOSaveIrradiance()", "ScatterDSOScatter()"})
    EXPECT_THAT(all, HasSubstr(function + " is called without a map: call ScatterDSOReadMap() first"));
}

TEST_F(ScatterCalls, MapsThatCannotBeRead) {
  run("ScatterDSOReadMap(" + quoted("none.ply") +
          "); float i = ScatterDSOAddGridPoint(P, 1); Ci = ScatterDSOScatter(i, P, N, 1, 1);",
      1);
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("none.ply")));
  run("ScatterDSOReadMap(" + quoted("none.tif") + ");", 1);
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("noneP.tif: ")));
}

TEST_F(ScatterCalls, ThreadsShareTheLight) {
  auto surface = bind("surface s() { " + loop("color(xcomp(p), zcomp(n), a)") + " }");
  const auto expected = run(loop("color(xcomp(p), zcomp(n), a)"), 6, 4);
  machine.end_plugins();
  std::vector<std::thread> threads;
  std::vector<std::vector<float>> got(4);
  for (size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      slvm::Grid grid = slvm::test::square(6, 4);
      slvm::ShadingContext context(machine, services);
      for (int g = 0; g < 5; ++g)
        context.shade({.surface = surface.get()}, grid);
      got[t] = slvm::test::red(grid);
    });
  for (std::thread& t : threads)
    t.join();
  EXPECT_THAT(messages(), IsEmpty());
  for (const auto& values : got)
    for (size_t i = 0; i < values.size(); ++i)
      EXPECT_EQ(values[i], expected[i].x);
}

} // namespace
} // namespace subsurface::test
