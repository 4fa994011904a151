// What semantic analysis makes of whole shaders.
#include "tests/unit/slc/front_end.h"

#include <gtest/gtest.h>
#include <thread>

namespace {

using slc_test::Front;

TEST(Sema, defaults_keep_the_space_they_are_written_in) {
  Front front;
  slc::CheckedSource source = front.check(
      "light l(point from = point \"shader\" (0, 0, 0); color c = color \"hsv\" (0, 1, 1); float a = 1) "
      "{ illuminate(from) Cl = c * a; }");
  EXPECT_EQ(front.messages(), "");
  const slc::Shader& shader = source.unit.shaders.front();
  EXPECT_EQ(shader.params[0]->init_space, "shader");
  EXPECT_EQ(shader.params[1]->init_space, "hsv");
  EXPECT_EQ(shader.params[2]->init_space, "");
}

TEST(Sema, nested_functions_reach_outer_variables_by_extern) {
  Front front;
  front.check("surface s() { float k = 2; float f(float x) { extern float k; extern vector I; return k * x * "
              "length(I); } Ci = f(3); }");
  EXPECT_EQ(front.messages(), "");
}

TEST(Sema, detail_follows_the_call) {
  Front front;
  front.check("float twice(float x) { float y = x * 2; return y; }\n"
              "surface s(float k = 1) { uniform float a = twice(k); Ci = a * twice(s); }");
  EXPECT_EQ(front.messages(), "");
}

TEST(Sema, output_parameters_set_in_light_loops_come_to_an_end) {
  Front front;
  front.check("surface s(output float n = 0; output varying float m = 0) { illuminance(P) { n += 1; m += n; "
              "} Ci = n; }");
  EXPECT_EQ(front.messages(), "");
}

TEST(Sema, annotations_go_to_their_shader) {
  Front front;
  slc::CheckedSource source = front.check("#pragma annotation \"first\" \"1\"\nsurface a() {}\nsurface "
                                          "b()\n{\n#pragma annotation \"second\" \"2\"\n}\n");
  ASSERT_EQ(source.unit.shaders.size(), 2u);
  ASSERT_EQ(source.unit.shaders[0].annotations.size(), 1u);
  EXPECT_EQ(source.unit.shaders[0].annotations[0].id, "first");
  ASSERT_EQ(source.unit.shaders[1].annotations.size(), 1u);
  EXPECT_EQ(source.unit.shaders[1].annotations[0].text, "2");
}

TEST(Sema, messages_have_the_documented_form) {
  Front front;
  front.check("surface plastic() {\n    float w = smoothstep(Cs, 0.2, 0.8);\n    Ci = w;\n}\n");
  EXPECT_EQ(front.messages(), "main.sl:2:15: error: no 'smoothstep' takes (color, float, float)\n"
                              "    2 |     float w = smoothstep(Cs, 0.2, 0.8);\n"
                              "      |               ^~~~~~~~~~\n"
                              "note: candidate: float smoothstep(float min, float max, float x)\n"
                              "main.sl:2:26: note: 'min' is a float, this is a color\n"
                              "    2 |     float w = smoothstep(Cs, 0.2, 0.8);\n"
                              "      |                          ^~\n");
}

TEST(Sema, one_compiler_serves_many_threads) {
  slc::Compiler compiler;
  auto work = [&] {
    for (int i = 0; i < 20; ++i) {
      slvm::SourceManager sources;
      slvm::Diagnostics diags;
      slc::CheckedSource source = compiler.check(
          sources.add("a.sl", "surface a() { Ci = diffuse(normalize(N)) + specular(N, -I, .1); }"), {},
          sources, diags);
      EXPECT_FALSE(diags.has_errors());
    }
  };
  std::thread one(work), two(work);
  one.join();
  two.join();
}

} // namespace
