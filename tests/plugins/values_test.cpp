// Arguments of every type, in and out, in both forms of functions.
#include "tests/plugins/plugged.h"

namespace slvm::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::IsEmpty;

// Weights 1, 2, 3... times the numbers in order, as both plug-ins compute it.
float weighted(std::initializer_list<float> numbers) {
  float total = 0, weight = 1;
  for (float x : numbers)
    total += weight++ * x;
  return total;
}

struct PluginValues : ::testing::TestWithParam<const char*>, Plugged {
  std::string f(const char* name) const { return std::string(GetParam()) + name; }
};

TEST_P(PluginValues, EveryTypeInUniform) {
  std::string arrays = "float k[3] = {41, 42, 43}; color c[2] = {color(51, 52, 53), color(54, 55, 56)};";
  EXPECT_THAT(shade(arrays + "Ci = " + f("sum") +
                    "(1, point(2,3,4), vector(5,6,7), normal(8,9,10), color(11,12,13),"
                    "matrix(1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16), \"seven..\", k, c);"),
              Each(weighted({1, 2, 3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 1,  2,  3,  4,  5,  6, 7,
                             8, 9, 10, 11, 12, 13, 14, 15, 16, 7,  41, 42, 43, 51, 52, 53, 54, 55, 56})));
  EXPECT_THAT(messages(), IsEmpty());
}

TEST_P(PluginValues, EveryTypeInVarying) {
  std::string source =
      "float x = xcomp(P); float k[3]; color c[2]; k[0] = x; k[1] = 2; k[2] = 3 * x; c[0] = color(x, 1, 2);"
      "c[1] = color(0, x, x); string s = x > 0.5 ? \"longer\" : \"a\"; Ci = " +
      f("sum") + "(x, P, N * x, normal(0,x,0), color(x,1,1), matrix(1) * x, s, k, c);";
  std::vector<float> got = shade(source, 3);
  ASSERT_EQ(got.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const float x = static_cast<float>(i) / 2;
    EXPECT_FLOAT_EQ(got[i], weighted({x, x, 0,     1, 0, 0, -x, 0, x, 0, x, 1, 1, x, 0,
                                      0, 0, 0,     x, 0, 0, 0,  0, x, 0, 0, 0, 0, x, x > 0.5f ? 6.0f : 1.0f,
                                      x, 2, 3 * x, x, 1, 2, 0,  x, x}))
        << i;
  }
}

TEST_P(PluginValues, EveryTypeOut) {
  std::string before = "float x = xcomp(P), g = 100; point p = 0; color c = 0; matrix m = 0; string s = "
                       "\"\", t[2] = {\"a\", \"b\"};"
                       "float k[2] = {0, 7}; " +
                       f("out") + "(x, g, p, c, m, s, k, t); ";
  auto expect = [&](const char* expression, std::vector<float> values) {
    EXPECT_THAT(shade(before + "Ci = " + expression + ";", 3), ::testing::ElementsAreArray(values))
        << expression;
  };
  expect("g", {100, 100.5f, 101});
  expect("xcomp(p) + 10 * zcomp(p)", {20, 25.5f, 31});
  expect("comp(c, 2)", {0, 1.5f, 3});
  expect("comp(m, 0, 0) + comp(m, 3, 3) + comp(m, 1, 2)", {21, 22.5f, 24});
  expect("k[0]", {0, 0.5f, 1});
  expect("k[1]", {8, 8, 8});
  expect("s == \"written\" ? 1 : 0", {1, 1, 1});
  expect("t[0] == \"a\" ? 1 : 0", {1, 1, 1});
  expect("t[1] == \"second\" ? 1 : 0", {1, 1, 1});
}

TEST_P(PluginValues, LanesThatAreOffKeepTheirs) {
  std::string source = "float x = xcomp(P), g = 100; point p = 5; color c = 6; matrix m = 7; string s = "
                       "\"\", t[2] = {\"\", \"\"};"
                       "float k[2] = {8, 9}; if (x > 0.3) " +
                       f("out") +
                       "(x, g, p, c, m, s, k, t); Ci = color(g, k[0] * 10 + k[1], xcomp(p) + comp(m, 0, 0));";
  EXPECT_THAT(shade(source, 3, 0), ElementsAre(100, 100.5f, 101));
  EXPECT_THAT(shade(source, 3, 1), ElementsAre(89, 15, 20));
  EXPECT_THAT(shade(source, 3, 2), ElementsAre(12, 1, 2));
}

TEST_P(PluginValues, InLoopsThatLanesLeaveOneByOne) {
  std::string source =
      "float x = xcomp(P) * 4, n = 0, total = 0; while (n < x) { n += 1; total += " + f("sum") +
      "(n); if (total > 55) break; } Ci = total;";
  for (int level : {0, 1, 2})
    EXPECT_THAT(shade(source, 5, 0, level), ElementsAre(0, 10, 30, 60, 60)) << level;
}

TEST_P(PluginValues, InNestedFunctionsWithOutputs) {
  std::string source =
      "float twice(float v; output float side) { float g = 1, k[2] = {0, 0}; point p = 0; color c = 0;"
      "matrix m = 0; string s = \"\", t[2] = {\"\", \"\"}; " +
      f("out") + "(v, g, p, c, m, s, k, t); side = k[1]; return 2 * g; }" +
      "float side = 0; Ci = twice(xcomp(P), side) + 10 * side;";
  EXPECT_THAT(shade(source, 3), ElementsAre(12, 13, 14));
}

INSTANTIATE_TEST_SUITE_P(Forms, PluginValues, ::testing::Values("pt_", "gr_"), [](const auto& form) {
  return std::string(form.param) == "pt_" ? "ByPoint" : "ByGrid";
});

struct ReturnedArrays : ::testing::Test, Plugged {};

TEST_F(ReturnedArrays, InitialiseArraysAndAreAssigned) {
  for (int level : {0, 1, 2}) {
    EXPECT_THAT(shade("float a[4] = gr_array(3); Ci = color(a[1], a[2], a[3]);", 2, 0, level), Each(1.0f));
    EXPECT_THAT(shade("float a[4] = gr_array(3); Ci = color(a[1], a[2], a[3]);", 2, 1, level), Each(4.0f));
    EXPECT_THAT(
        shade("float a[4] = {7, 7, 7, 7}; a = gr_array(3); Ci = color(a[0], a[2], a[3]);", 2, 2, level),
        Each(7.0f)); // what is not returned stays
    EXPECT_THAT(shade("color c[] = gr_colors(color P); Ci = c[1];", 3, 0, level), ElementsAre(0, 1, 2));
    EXPECT_THAT(shade("color c[2]; float x = xcomp(P); if (x > .3) c = gr_colors(color(x, 1, 1)); Ci = c[1];",
                      3, 0, level),
                ElementsAre(0, 1, 2));
  }
  EXPECT_THAT(messages(), IsEmpty());
}

TEST_F(ReturnedArrays, HoldNoMoreThanTheVariable) {
  EXPECT_THAT(shade("float a[2] = gr_array(5); Ci = a[1];", 1), ElementsAre(1));
  EXPECT_THAT(messages(), ElementsAre(::testing::HasSubstr(
                              "it wants 5 elements in 'result', which holds 2: declare a longer array")));
}

struct PointValues : ::testing::Test, Plugged {};

TEST_F(PointValues, OverloadsByTypeOfTheArgument) {
  EXPECT_THAT(
      shade("Ci = color(pt_sum(2), xcomp(pt_sum(point(3, 0, 0))), comp(pt_sum(color(1, 1, 1)), 2));", 1, 0),
      ElementsAre(20));
  EXPECT_THAT(
      shade("Ci = color(pt_sum(2), xcomp(pt_sum(point(3, 0, 0))), comp(pt_sum(color(1, 1, 1)), 2));", 1, 1),
      ElementsAre(60));
  EXPECT_THAT(
      shade("Ci = color(pt_sum(2), xcomp(pt_sum(point(3, 0, 0))), comp(pt_sum(color(1, 1, 1)), 2));", 1, 2),
      ElementsAre(30));
}

TEST_F(PointValues, OneThatNamesNoOutputsMayStoreToVariables) {
  EXPECT_THAT(shade("float a = xcomp(P), b = 7; pt_swap(a, b); Ci = color(a, b, 0);", 3, 0), Each(7.0f));
  EXPECT_THAT(shade("float a = xcomp(P), b = 7; pt_swap(a, b); Ci = color(a, b, 0);", 3, 1),
              ElementsAre(0, 0.5f, 1));
  EXPECT_THAT(shade("uniform float a = 3, b = 4; pt_swap(a, b); Ci = color(a, b, 0);", 3, 0), Each(4.0f));
  EXPECT_THAT(shade("float a = xcomp(P); pt_swap(a, 9); Ci = a;", 3),
              Each(9.0f)); // not to what is no variable
  EXPECT_THAT(shade("float a = xcomp(P); pt_swap(a + 0, a); Ci = a;", 3), ElementsAre(0, 0.5f, 1));
}

TEST_F(PointValues, StringsThatFitAndOthers) {
  EXPECT_THAT(shade("string a = \"ab\"; Ci = pt_join(a, \"cd\") == \"abcd\" && a == \"ab\" ? 1 : 0;"),
              Each(1.0f));
  const std::string thousand(3000, 'x');
  EXPECT_THAT(shade("Ci = pt_join(\"" + thousand + "\", \"y\") == \"" + thousand + "y\" ? 1 : 0;"),
              Each(1.0f));
  EXPECT_THAT(shade("Ci = od_length(pt_join(\"v\", xcomp(P)));", 3), ElementsAre(2, 4, 2)); // v0, v0.5, v1
}

TEST_F(PointValues, WaysOfWritingOfOtherRenderers) {
  EXPECT_THAT(shade("Ci = od_length(\"seven..\") + xcomp(od_scale(vector(P), 2));", 2), ElementsAre(7, 9));
}

struct GridValues : ::testing::Test, Plugged {};

TEST_F(GridValues, ArgumentsTellWhatTheyAre) {
  EXPECT_THAT(shade("Ci = gr_describe(3);"), Each(1.5f)); // by the name "it"
  EXPECT_THAT(shade("Ci = gr_describe(xcomp(P));"), Each(11.5f));
  EXPECT_THAT(shade("Ci = gr_describe(P);"), Each(12.0f));
  EXPECT_THAT(shade("Ci = gr_describe(color(1, 0, 0));"), Each(5.5f));
  EXPECT_THAT(shade("Ci = gr_describe(\"text\");"), Each(7.5f));
  EXPECT_THAT(shade("float k[4] = {1, 2, 3, 4}; Ci = gr_describe(k);"), Each(400101.5f));
  EXPECT_THAT(shade("matrix m = 1; Ci = gr_describe_out(m);"), Each(1006.5f));
  EXPECT_THAT(shade("float k[2] = {xcomp(P), 2}; Ci = gr_describe_out(k);"), Each(211111.5f));
}

TEST_F(GridValues, RawDataAndRunFlags) {
  EXPECT_THAT(shade("float x = xcomp(P), r = 1; if (x > 0.3 && x < 0.9) r = gr_raw(x); Ci = r;", 5),
              ElementsAre(1, 1, 5, 7.5f, 1));
  EXPECT_THAT(shade("Ci = gr_raw(2);", 3), Each(20.0f));
}

TEST_F(GridValues, OnlyActivePointsInOrder) {
  EXPECT_THAT(shade("Ci = gr_order();", 4), ElementsAre(400, 401, 402, 403));
  EXPECT_THAT(shade("float r = -1; if (mod(floor(xcomp(P) * 5 + 0.5), 2) == 1) r = gr_order(); Ci = r;", 6),
              ElementsAre(-1, 300, -1, 301, -1, 302));
}

TEST_F(GridValues, UniformOutputsOfVaryingArguments) {
  EXPECT_THAT(shade("uniform float most = 0; gr_largest(xcomp(P) * 3, most); Ci = most;", 4), Each(3.0f));
  EXPECT_THAT(
      shade("uniform float most = 0; if (xcomp(P) < 0.9) gr_largest(xcomp(P) * 3, most); Ci = most;", 4),
      ElementsAre(2, 2, 2, 0)); // where it was called
}

TEST_F(GridValues, ArraysAreResizedWithinWhatTheyHold) {
  EXPECT_THAT(shade("float k[4] = {9, 9, 9, 9}; gr_fill(3, k); Ci = k[2] * 10 + k[3];", 2), Each(39.0f));
  EXPECT_THAT(messages(), IsEmpty());
  shade("float k[4] = {9, 9, 9, 9}; gr_fill(5, k); Ci = k[0];", 2);
  EXPECT_THAT(messages(),
              ElementsAre("1: 'gr_fill' of the plug-in grids.so: it wants 5 elements in 'a2', which holds 4: "
                          "declare a longer array (1)"));
}

TEST_F(GridValues, IteratorsOverOnesOwnData) {
  EXPECT_THAT(shade("Ci = gr_offset(xcomp(P));", 3), ElementsAre(5, 5.5f, 6));
}

} // namespace
} // namespace slvm::test
