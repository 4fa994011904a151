// How often functions are called: once for a grid where nothing varies, else for each active point; and that
// the same happens at every level of optimisation, strip width and after a file was written and read.
#include "tests/plugins/plugged.h"

namespace slvm::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

struct PluginDetail : ::testing::Test, Plugged {};

TEST_F(PluginDetail, UniformCallsHappenOnce) {
  EXPECT_THAT(shade("float a = pt_count(1), b = pt_count(2); Ci = a * 10 + b;", 8), Each(12.0f));
}

TEST_F(PluginDetail, VaryingCallsHappenForEachPointInOrder) {
  EXPECT_THAT(shade("Ci = pt_count(xcomp(P));", 4), ElementsAre(1, 2, 3, 4));
}

TEST_F(PluginDetail, DeclaredVaryingThoughWithoutArguments) {
  EXPECT_THAT(shade("Ci = pt_count();", 4), ElementsAre(1, 2, 3, 4));
}

TEST_F(PluginDetail, OnlyActivePointsCount) {
  EXPECT_THAT(shade("float r = 0; if (xcomp(P) > 0.5) r = pt_count(xcomp(P)); Ci = r;", 4),
              ElementsAre(0, 0, 1, 2));
  EXPECT_THAT(shade("float r = 0; if (xcomp(P) > 2) r = pt_count(xcomp(P)); Ci = r + pt_count(1);", 4),
              Each(1.0f));
}

TEST_F(PluginDetail, AUniformCallUnderVaryingControlHappensOnce) {
  EXPECT_THAT(shade("float r = 0; if (xcomp(P) > 0.5) r = pt_count(1); Ci = r + 10 * pt_count(1);", 4),
              ElementsAre(20, 20, 21, 21));
}

TEST_F(PluginDetail, CallsOfOneStatementComeBeforeThoseOfTheNext) {
  // Shared data of both overloads: 1..4, then 5..8.
  EXPECT_THAT(shade("float a = pt_count(xcomp(P)), b = pt_count(xcomp(P)); Ci = a * 100 + b;", 4),
              ElementsAre(105, 206, 307, 408));
}

TEST_F(PluginDetail, NothingIsMergedMovedOrRemoved) {
  for (int level : {0, 1, 2}) {
    EXPECT_THAT(shade("float a = pt_count(1), b = pt_count(1); pt_count(1); Ci = pt_count(1);", 4, 0, level),
                Each(4.0f));
    EXPECT_THAT(shade("float i, r = 0; for (i = 0; i < 5; i += 1) r = pt_count(1); Ci = r;", 4, 0, level),
                Each(5.0f));
  }
}

TEST_F(PluginDetail, ShortCircuitsHold) {
  EXPECT_THAT(
      shade(
          "float r = 0; if (xcomp(P) > 0.5 && pt_count(xcomp(P)) > 0) r = 1; Ci = color(r, pt_count(1), 0);",
          4, 1),
      Each(3.0f));
}

TEST_F(PluginDetail, FilesKeepTheFunctions) {
  std::vector<std::byte> bytes =
      compile("surface s() { float x = xcomp(P); gr_largest(x, x); Ci = pt_sum(x) + gr_sum(1); }");
  ASSERT_TRUE(bytes.empty()); // a varying variable for a uniform output
  bytes = compile("surface s(float k = 2) { uniform float m = 0; gr_largest(xcomp(P) * k, m); Ci = pt_sum(m) "
                  "+ gr_sum(1); }");
  ASSERT_FALSE(bytes.empty()) << diagnostics;
  auto program = read_slo(bytes);
  ASSERT_TRUE(program);
  EXPECT_EQ(write_slo(*program), bytes);
  ASSERT_EQ(program->facts.plugins.size(), 2u);
  EXPECT_THAT(program->facts.plugins[0], ::testing::EndsWith("good/grids.so"));
  EXPECT_THAT(program->facts.plugins[1], ::testing::EndsWith("good/points.so"));
  EXPECT_THAT(program->facts.shadeops, ::testing::IsSupersetOf({"gr_largest", "gr_sum", "pt_sum"}));
  EXPECT_EQ(program->plugins.list().size(), 3u);
  // Bound with another value the optimiser runs again.
  auto shader = machine.load(bytes);
  ASSERT_TRUE(shader);
  std::vector<ParamValue> k{number("k", 5)};
  auto instance = machine.instantiate(*shader, k);
  ASSERT_TRUE(instance) << instance.error();
  Grid grid = square(3, 1);
  ShadingContext context(machine, services);
  context.shade({.surface = instance->get()}, grid);
  EXPECT_THAT(red(grid), Each(60.0f));
}

TEST_F(PluginDetail, StripsAndThreadsDoNotMatter) {
  const std::string source =
      "surface s() { float x = xcomp(P), r = 0, i; for (i = 0; i < 3; i += 1) { if (mod(floor(x * 97), 2) == "
      "i) r += gr_sum(x) + xcomp(pt_sum(P)); } Ci = r; }";
  std::vector<float> expected;
  for (uint32_t strip : {16u, 64u, 4096u}) {
    Plugged other;
    Machine narrow({.strip_points = strip, .plugin_folders = {plugin_folder("good")}});
    auto shader = narrow.load(other.compile(source));
    ASSERT_TRUE(shader);
    auto instance = narrow.instantiate(*shader, {});
    ASSERT_TRUE(instance) << instance.error();
    Grid grid = square(100, 3);
    ShadingContext context(narrow, services);
    context.shade({.surface = instance->get()}, grid);
    if (expected.empty()) expected = red(grid);
    EXPECT_EQ(red(grid), expected);
  }
  EXPECT_GT(expected[50], 0);
}

} // namespace
} // namespace slvm::test
