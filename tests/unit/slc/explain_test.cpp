// slc --explain-varying, word for word; and the notes of errors about varying values.
#include "tests/unit/slc/tool_fixture.h"

#include <algorithm>

namespace {

class Explain : public slc_test::Tool {
protected:
  void expect(const std::string& names, const std::string& source, const std::string& text) {
    write("a.sl", source);
    std::string options;
    for (char name : names)
      options += std::string("--explain-varying ") + name + " ";
    EXPECT_EQ(run("-nw " + options + "a.sl"), 0);
    EXPECT_EQ(output_, text);
    EXPECT_FALSE(exists("a.slo"));
  }
};

TEST_F(Explain, follows_assignments_and_conditions) {
  expect("cru",
         "surface a(float k = 1) {\n"
         "  float r = 0, u = k;\n"
         "  if (s > 0.5)\n"
         "    r = u;\n"
         "  float c = 2 * r;\n"
         "  Ci = c;\n"
         "}\n",
         "surface \"a\"\n"
         "a.sl:5:13: 'c' is varying: it is set from 'r' here\n"
         "a.sl:4:9: 'r' is varying: it is set under a varying condition here\n"
         "a.sl:3:7: the condition is varying: it depends on 's'\n"
         "a.sl:3:7: 's' is a predefined variable that varies\n"
         "surface \"a\"\n"
         "a.sl:4:9: 'r' is varying: it is set under a varying condition here\n"
         "a.sl:3:7: the condition is varying: it depends on 's'\n"
         "a.sl:3:7: 's' is a predefined variable that varies\n"
         "surface \"a\"\n"
         "a.sl:2:16: 'u' is uniform\n");
}

TEST_F(Explain, follows_loops_that_some_points_leave) {
  expect("nm",
         "surface a() {\n"
         "  float i, n = 0, m = 0;\n"
         "  for (i = 0; i < 9; i += 1) {\n"
         "    m += 1;\n"
         "    if (i > 9 * u) break;\n"
         "    n += 1;\n"
         "  }\n"
         "  Ci = n + m;\n"
         "}\n",
         "surface \"a\"\n"
         "a.sl:6:5: 'n' is varying: it is set under a varying condition here\n"
         "a.sl:3:15: the condition is varying: it depends on 'i'\n"
         "a.sl:3:22: 'i' is varying: it is set here, in a loop that some points leave earlier\n"
         "a.sl:5:20: some points leave the round here, under a varying condition here\n"
         "a.sl:5:9: the condition is varying: it depends on 'u'\n"
         "a.sl:5:17: 'u' is a predefined variable that varies\n"
         "surface \"a\"\n"
         "a.sl:4:5: 'm' is varying: it is set under a varying condition here\n"
         "a.sl:3:15: the condition is varying: it depends on 'i'\n"
         "a.sl:3:22: 'i' is varying: it is set here, in a loop that some points leave earlier\n"
         "a.sl:5:20: some points leave the round here, under a varying condition here\n"
         "a.sl:5:9: the condition is varying: it depends on 'u'\n"
         "a.sl:5:17: 'u' is a predefined variable that varies\n");
}

TEST_F(Explain, looks_into_functions_as_they_are_called) {
  expect("xyrq",
         "float f(float x; output float y) {\n"
         "  if (x > 1) return 0;\n"
         "  y = 1;\n"
         "  return 2;\n"
         "}\n"
         "float g(float q) { return q * random(); }\n"
         "surface a() {\n"
         "  float r = 0, k = 0;\n"
         "  r = f(k, k) + f(v, r) + g(3);\n"
         "  Ci = r;\n"
         "}\n",
         "surface \"a\"\n"
         "a.sl:1:15: 'x' is uniform\n"
         "a.sl:9:19: 'x' is varying: it is given 'v' here\n"
         "a.sl:9:19: 'v' is a predefined variable that varies\n"
         "surface \"a\"\n"
         "a.sl:9:12: 'y' is 'k' of the caller here\n"
         "a.sl:8:16: 'k' is uniform\n"
         "a.sl:9:22: 'y' is 'r' of the caller here\n"
         "a.sl:3:7: 'y' is varying: it is set here, where some points have returned already\n"
         "a.sl:2:14: some points return here, under a varying condition here\n"
         "a.sl:2:7: the condition is varying: it depends on 'x'\n"
         "a.sl:9:19: 'x' is varying: it is given 'v' here\n"
         "a.sl:9:19: 'v' is a predefined variable that varies\n"
         "surface \"a\"\n"
         "a.sl:3:7: 'y' is varying: it is set here, where some points have returned already\n"
         "a.sl:2:14: some points return here, under a varying condition here\n"
         "a.sl:2:7: the condition is varying: it depends on 'x'\n"
         "a.sl:9:19: 'x' is varying: it is given 'v' here\n"
         "a.sl:9:19: 'v' is a predefined variable that varies\n"
         "surface \"a\"\n"
         "a.sl:6:15: 'q' is uniform\n");
}

TEST_F(Explain, names_what_functions_return) {
  expect("rp",
         "float f(float x) { return x * random(); }\n"
         "float h(float x) { if (x > 1) return 1; return 2; }\n"
         "surface a() { float r = f(1), p = h(t); Ci = r + p; }\n",
         "surface \"a\"\n"
         "a.sl:3:25: 'r' is varying: it is set from what 'f' returns here\n"
         "a.sl:1:27: 'f' returns a varying value: it depends on 'random' here\n"
         "a.sl:1:31: what 'random' gives varies, whatever it is given\n"
         "surface \"a\"\n"
         "a.sl:3:35: 'p' is varying: it is set from what 'h' returns here\n"
         "a.sl:2:31: 'h' returns a varying value: it returns under a varying condition here\n"
         "a.sl:2:24: the condition is varying: it depends on 'x'\n"
         "a.sl:3:37: 'x' is varying: it is given 't' here\n"
         "a.sl:3:37: 't' is a predefined variable that varies\n");
}

TEST_F(Explain, knows_lights_rays_messages_and_declarations) {
  expect("dlmwPE",
         "surface a(varying float w = 1) {\n"
         "  float l = 0, d = 0, m = 0, hit = 0;\n"
         "  illuminance(P) l = 1;\n"
         "  gather(\"\", P, N, 0, 1, \"ray:length\", hit) d = 1;\n"
         "  surface(\"x\", m);\n"
         "  Ci = l + d + m + hit;\n"
         "}\n",
         "surface \"a\"\n"
         "a.sl:4:49: 'd' is varying: it is set in a loop over rays here\n"
         "a.sl:4:3: rays are shot from each point\n"
         "surface \"a\"\n"
         "a.sl:3:22: 'l' is varying: it is set in a light loop here\n"
         "a.sl:3:3: light reaches some points and not others\n"
         "surface \"a\"\n"
         "a.sl:5:16: 'm' is varying: it is set from 'surface' here\n"
         "a.sl:5:3: what 'surface' gives varies, whatever it is given\n"
         "surface \"a\"\n"
         "a.sl:1:25: 'w' is varying: it is declared so\n"
         "surface \"a\"\n"
         "'P' is a predefined variable that varies\n"
         "surface \"a\"\n"
         "'E' is a predefined variable that is uniform\n");
}

TEST_F(Explain, chains_are_as_long_as_they_are) {
  constexpr int kLinks = 5000;
  std::string source = "surface a() {\n  float a0 = s;\n";
  for (int i = 1; i < kLinks; ++i)
    source += "  float a" + std::to_string(i) + " = a" + std::to_string(i - 1) + ";\n";
  write("a.sl", source + "  float last = a" + std::to_string(kLinks - 1) + ";\n  Ci = last;\n}\n");
  EXPECT_EQ(run("--explain-varying last a.sl"), 0);
  EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), kLinks + 3);
  EXPECT_TRUE(output_.ends_with("a.sl:2:14: 'a0' is varying: it is set from 's' here\n"
                                "a.sl:2:14: 's' is a predefined variable that varies\n"));
}

TEST_F(Explain, answers_for_each_shader) {
  expect("c",
         "surface a(float k = 1) { float c = k; Ci = c; }\n"
         "surface b(float k = 1) { Ci = k; }\n"
         "light l() { uniform float c = 0; illuminate(point(0, 0, 0)) { c = 1; Cl = c; } }\n",
         "surface \"a\"\n"
         "a.sl:1:32: 'c' is uniform\n"
         "light \"l\"\n"
         "a.sl:3:67: 'c' is varying: it is set in a light loop here\n"
         "a.sl:3:34: light reaches some points and not others\n");
}

TEST_F(Explain, explains_errors_too) {
  write("a.sl", "surface a(float rings = 1) {\n  uniform float r = rings * u;\n  Ci = r;\n}\n");
  EXPECT_EQ(run("--explain-varying r a.sl"), 1);
  EXPECT_EQ(output_,
            "a.sl:2:21: error: a varying value cannot be stored in the uniform variable 'r': declare "
            "it 'varying'\n"
            "    2 |   uniform float r = rings * u;\n"
            "      |                     ^~~~~~~~~\n"
            "a.sl:2:29: note: 'u' is a predefined variable that varies\n"
            "    2 |   uniform float r = rings * u;\n"
            "      |                             ^\n"
            "surface \"a\"\n"
            "a.sl:2:17: 'r' is uniform\n");
  write("b.sl", "surface b(float rings = 1) { Ci = rings; }");
  EXPECT_EQ(run("--explain-varying rinks --explain-varying rings b.sl"), 1);
  EXPECT_EQ(output_, "slc: b.sl has no variable 'rinks'; did you mean 'rings'?\n"
                     "surface \"b\"\nb.sl:1:17: 'rings' is uniform\n");
  EXPECT_EQ(run("--explain-varying rings --dump=ir b.sl"), 2);
}

TEST_F(Explain, errors_name_the_nearest_step) {
  write("a.sl", "float half(uniform float x) { return x / 2; }\n"
                "surface a() {\n"
                "  float r = P . P;\n"
                "  float h = half(r);\n"
                "  Ci = h;\n"
                "}\n");
  EXPECT_EQ(run("a.sl"), 1);
  EXPECT_EQ(output_, "a.sl:4:18: error: 'x' of 'half' must be uniform; this value is varying\n"
                     "    4 |   float h = half(r);\n"
                     "      |                  ^\n"
                     "a.sl:3:13: note: 'r' is varying: it is set from 'P' here\n"
                     "    3 |   float r = P . P;\n"
                     "      |             ^~~~~\n");
}

} // namespace
