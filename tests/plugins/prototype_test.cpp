// Prototypes as tables have them, and what is wrong with others.
#include "slvm/plugin/prototype.h"

#include <gtest/gtest.h>

namespace slvm {
namespace {

std::string signature_of(std::string_view text) {
  auto p = parse_prototype(text);
  return p ? p->name + ": " + p->signature() : p.error();
}

TEST(Prototype, Types) {
  EXPECT_EQ(signature_of("float f(float, point, vector, normal, color, matrix, string)"),
            "f: float(float a1, point a2, vector a3, normal a4, color a5, matrix a6, string a7)");
  EXPECT_EQ(signature_of("void f()"), "f: void()");
  EXPECT_EQ(signature_of("string f(void)"), "f: string()");
}

TEST(Prototype, DetailOutputsAndArrays) {
  EXPECT_EQ(signature_of("uniform color f(uniform string mode, output varying float x)"),
            "f: uniform color(uniform string mode, inout float x)");
  EXPECT_EQ(signature_of("varying float f(uniform output float [3] a, color[], float b[2])"),
            "f: varying float(inout uniform float[3] a, color[] a2, float[2] b)");
}

TEST(Prototype, WaysOfWriting) {
  EXPECT_EQ(signature_of("  float\tsqr_f ( float ) ;\n"), "sqr_f: float(float a1)");
  EXPECT_EQ(signature_of("float  and (float,  float)"), "and: float(float a1, float a2)");
  EXPECT_EQ(signature_of("float P(string, float float, float)"),
            "P: float(string a1, float float, float a3)");
}

TEST(Prototype, EveryPluginSignatureIsOneOfTheTable) {
  auto p = parse_prototype("uniform color f(uniform string mode, output float[3] x, point)");
  ASSERT_TRUE(p);
  auto made = PluginShadeop::make({p->name, p->signature(), "x.so", PluginForm::kGrid});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->info().signature.uniform_result);
  EXPECT_EQ(made->info().signature.param(1).elements, 3u);
  EXPECT_TRUE(made->info().signature.param(1).output);
  EXPECT_EQ(made->storing_to({false, false, true})->info().signature_text,
            "uniform color(uniform string mode, inout float[3] x, inout point a3)");
}

TEST(Prototype, AReturnedArrayIsTheFirstOutput) {
  EXPECT_EQ(signature_of("float[3] f()"), "f: void(inout float[3] result)");
  EXPECT_EQ(signature_of("uniform color[] f(float x)"), "f: void(inout uniform color[] result, float x)");
}

TEST(Prototype, Mistakes) {
  EXPECT_EQ(signature_of(""), "a type is missing where it ends");
  EXPECT_EQ(signature_of("quaternion f()"), "'quaternion' is no type of the shading language");
  EXPECT_EQ(signature_of("bool f()"), "'bool' is no type of the shading language");
  EXPECT_EQ(signature_of("float (float)"), "a name is missing where '(float)' stands");
  EXPECT_EQ(signature_of("float f"), "a '(' is missing where it ends");
  EXPECT_EQ(signature_of("float f(float"), "a ',' or ')' is missing where it ends");
  EXPECT_EQ(signature_of("float f(float;)"), "a ',' or ')' is missing where ';)' stands");
  EXPECT_EQ(signature_of("float f(void, float)"), "a parameter is void");
  EXPECT_EQ(signature_of("float f(float, )"), "a type is missing where ')' stands");
  EXPECT_EQ(signature_of("float f(float[3)"), "a ']' is missing where ')' stands");
  EXPECT_EQ(signature_of("float f(float[9999999])"), "an array has more than 1048576 elements");
  EXPECT_EQ(signature_of("float f(float) x"), "'x' follows the prototype");
  EXPECT_EQ(signature_of("uniform varying float f()"), "its result is both uniform and varying");
  EXPECT_EQ(signature_of("void[3] f()"), "it returns an array of nothing");
  EXPECT_EQ(signature_of("float f(float, ...)"),
            "it takes any number of arguments ('...'), which calls from shaders cannot give it");
}

TEST(Prototype, IsBounded) {
  std::string many = "float f(float";
  for (size_t i = 1; i < kMaxPluginParams; ++i)
    many += ",float";
  EXPECT_TRUE(parse_prototype(many + ")"));
  EXPECT_EQ(signature_of(many + ",float)"), "it has more than 64 parameters");
  EXPECT_EQ(signature_of(std::string(10000, ' ')), "it is longer than 8192 characters");
}

TEST(Prototype, SignaturesOfOtherKindsAreRefused) {
  for (const char* text :
       {"float(any x)", "float(float x...)", "float(@texture)", "bool(float x)", "float(output float x)",
        "float(float[3 x)", "nonsense", "float(float[2000000] x)"})
    EXPECT_FALSE(PluginShadeop::make({"f", text, "x.so", PluginForm::kGrid})) << text;
  EXPECT_FALSE(PluginShadeop::make({"", "float(float x)", "x.so", PluginForm::kGrid}));
}

} // namespace
} // namespace slvm
