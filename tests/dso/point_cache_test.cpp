// opencache and its relatives: each point is lit once, by whichever points of grids come first.
#include "tests/dso/with_plugin.h"
#include "tests/unit/subsurface/surfaces.h"

#include <thread>

namespace subsurface::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class PointCacheCalls : public WithPlugin {
protected:
  void SetUp() override {
    points_ = ball(100, 2);
    points_.irradiance.clear();
    save("points.ply", points_);
  }
  /// Light of a point is its position, green with 1 more each time it is lit.
  std::string lighting(const std::string& before = "") {
    return before + "if (opencache(" + quoted("points.ply") +
           ") == 1) { float i = indexcache(); while (i >= 0) { point p = getPcache(i); normal n = "
           "getNcache(i);"
           "accumcache(i, color(xcomp(p), 1, zcomp(n))); i = indexcache(); } writecache(" +
           quoted("lit.ply") + "); }";
  }
  void expect_all_lit_once() {
    const PointCloud lit = cloud("lit.ply");
    ASSERT_EQ(lit.size(), points_.size());
    for (size_t i = 0; i < lit.size(); ++i) {
      EXPECT_EQ(lit.position[i], points_.position[i]);
      EXPECT_EQ(lit.irradiance[i], (Color{points_.position[i].x, 1, points_.normal[i].z})) << i;
    }
  }
  PointCloud points_;
};

TEST_F(PointCacheCalls, OnePointLightsThemAll) {
  run(lighting(), 1);
  EXPECT_THAT(messages(), IsEmpty());
  expect_all_lit_once();
}

TEST_F(PointCacheCalls, ManyPointsShareThem) {
  run(lighting(), 7, 5);
  EXPECT_THAT(messages(), IsEmpty());
  expect_all_lit_once();
}

TEST_F(PointCacheCalls, SoDoGridsOfManyThreads) {
  auto surface = bind("surface s() { " + lighting() + " }");
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      slvm::Grid grid = slvm::test::square(3, 1);
      slvm::ShadingContext context(machine, services);
      for (int g = 0; g < 5; ++g)
        context.shade({.surface = surface.get()}, grid);
    });
  for (std::thread& t : threads)
    t.join();
  EXPECT_THAT(messages(), IsEmpty());
  expect_all_lit_once();
}

TEST_F(PointCacheCalls, EachFrameLightsAnew) {
  run(lighting(), 2);
  machine.end_plugins();
  run(lighting(), 2);
  expect_all_lit_once();
}

TEST_F(PointCacheCalls, AShaderThatDoesNotWriteLeavesNoFile) {
  run("if (opencache(" + quoted("points.ply") + ") == 1) accumcache(indexcache(), color 1);", 2);
  EXPECT_THAT(messages(), IsEmpty());
  EXPECT_FALSE(folder_.has("lit.ply"));
}

TEST_F(PointCacheCalls, IndicesOutOfRange) {
  const auto got = run("float o = opencache(" + quoted("points.ply") +
                           "); accumcache(100, 1); accumcache(-1, 1); Ci = o + color(xcomp(getPcache(-1)), "
                           "zcomp(getNcache(1e9)), xcomp(getPcache(100)));",
                       1);
  EXPECT_THAT(got, ElementsAre(Color{1, 1, 1}));
  EXPECT_THAT(messages(), IsEmpty());
}

TEST_F(PointCacheCalls, ACloudThatIsNotThere) {
  const auto got = run("Ci = opencache(" + quoted("none.ply") + ");", 1);
  EXPECT_THAT(got, ElementsAre(Color{}));
  EXPECT_THAT(messages(), ElementsAre(AllOf(HasSubstr("none.ply"), HasSubstr("subsurface.so: "))));
}

TEST_F(PointCacheCalls, CallsWithoutACacheSayWhatIsMissing) {
  run("Ci = indexcache() + xcomp(getPcache(0)) + xcomp(getNcache(0)); accumcache(0, 1); "
      "writecache(\"a.ply\");",
      1);
  std::string all;
  for (const std::string& m : messages())
    all += m + "\n";
  for (std::string function : {"indexcache()", "getPcache()", "getNcache()", "accumcache()", "writecache()"})
    EXPECT_THAT(all, HasSubstr(function + " is called without a cache: call opencache() first"));
}

TEST_F(PointCacheCalls, AFileNeedsANameAndAFolder) {
  run("uniform float o = opencache(" + quoted("points.ply") +
          "); if (o == 1) { accumcache(0, 1); writecache(\"\"); }",
      1);
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("writecache() needs the name of a file")));
  run("uniform float o = opencache(" + quoted("points.ply") + "); if (o == 1) writecache(" +
          quoted("no/folder.ply") + ");",
      1);
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("no/folder.ply")));
}

} // namespace
} // namespace subsurface::test
