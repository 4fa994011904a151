// Which function or row a call means, and what is converted for it.
#include "tests/unit/slc/front_end.h"

#include <gtest/gtest.h>

namespace {

using slc_test::Front;

// The checked tree of the last statement of a surface shader.
std::string checked(const std::string& statements, const std::string& functions = "") {
  Front front;
  front.diags.no_warnings = true;
  slc::CheckedSource source = front.check(
      functions + "surface s(string name = \"a\"; string list[2] = {\"a\", \"b\"}) { " + statements + " }");
  if (front.diags.has_errors()) return front.messages();
  const auto* last = slc::as<slc::ExpressionStmt>(source.unit.shaders[0].body->statements.back().get());
  return slc::print_ast(*last->expressions[0]);
}
void expect_row(const std::string& statements, const std::string& row, const std::string& functions = "") {
  std::string tree = checked(statements, functions);
  EXPECT_NE(tree.find("[" + row + "]"), std::string::npos) << statements << "\n" << tree;
}

TEST(Overload, the_result_follows_the_context) {
  expect_row("float f; f = noise(P);", "noise float(point p)");
  expect_row("color c; c = noise(P);", "noise color(point p)");
  expect_row("color c; c = 2 * noise(P);", "noise color(point p)");
  expect_row("color c; c = float noise(P);", "noise float(point p)");
  expect_row("float f; f = color noise(P) . color 1;", "noise color(point p)");
  expect_row("color c; c = mix(Cs, noise(P), noise(s));", "noise color(point p)");
  expect_row("color c; c = mix(Cs, noise(P), noise(s));", "noise float(float x)");
}

TEST(Overload, the_other_operand_is_context_too) {
  expect_row("Ci = Cs * texture(name);", "texture color(string name, uniform float channel, @texture)");
  expect_row("P += N * noise(P);", "noise float(point p)");
  expect_row("P += noise(P);", "noise vector(point p)");
}

// A float beside a call that could be a color does not keep it from being one.
TEST(Overload, floats_do_not_hide_the_context) {
  const std::string noise = "noise color(point p)";
  for (const char* value :
       {"noise(P) + .1", "1 - noise(P)", "1 / noise(P)", ".5 * (noise(P) + .1)", "-(noise(P) - .5)",
        "s > .5 ? noise(P) : 1", "max(noise(P), .1)", "clamp(2 * noise(P) - 1, 0, 1)", "noise(P) + t + .1"}) {
    expect_row(std::string("Ci = ") + value + ";", noise);
    expect_row(std::string("color c = 0; c += ") + value + ";", noise);
    expect_row(std::string("float f; f = ") + value + ";", "noise float(point p)");
    expect_row(std::string("Ci = float (") + value + ");", "noise float(point p)");
  }
  expect_row("Ci = trace(P, N) + .1;", "trace color(point P, vector R, @trace)");
  expect_row("Ci = 1 - texture(name);", "texture color(string name, uniform float channel, @texture)");
  expect_row("Ci *= 1 - shadow(name, P);",
             "shadow color(string name, uniform float channel, point P, @shadow)");
  // Between floats alone there is nothing to choose.
  expect_row("Ci = s + .1;", "operator+ float(float a, float b)");
}

TEST(Overload, what_stands_around_operators_chooses_for_their_operands) {
  expect_row("Ci = mix(Cs, noise(P) + .1, .5);", "noise color(point p)");
  expect_row("Ci = mix(Cs, Os, noise(P) + .1);", "noise float(point p)");
  expect_row("Ci = Cs * (noise(P) + .1);", "noise color(point p)");
  expect_row("Ci = color(noise(P) - .5) + 1;", "noise color(point p)");
  expect_row("Ci = half(noise(P) + .1);", "noise color(point p)", "color half(color c) { return c / 2; }\n");
  const std::string halves = "float half(float x) { return x / 2; } color half(color c) { return c / 2; }\n";
  expect_row("Ci = half(noise(P) + .1);", "noise color(point p)", halves);
  expect_row("float f; f = half(noise(P) + .1);", "noise float(point p)", halves);
  expect_row("P += noise(P) - .5;", "noise vector(point p)");
  expect_row("N = normalize(noise(P) - .5);", "noise normal(point p)");
  expect_row("P = P + N * (noise(P) - .5);", "noise float(point p)");
  expect_row("P = point \"world\" (noise(P) - .5);", "noise vector(point p)");
  // Relations and conditions are about floats unless something else is compared.
  expect_row("float f; f = noise(P) + .1 > 1 ? 1 : 0;", "noise float(point p)");
  expect_row("float f; f = noise(P) + .1 == .6 ? 1 : 0;", "noise float(point p)");
  expect_row("float f; f = noise(P) + .1 == Cs ? 1 : 0;", "noise color(point p)");
  expect_row("float f; f = (noise(P) + .1) . Cs;", "noise color(point p)");
  expect_row("float a[2]; a[noise(P) + .1] = 1;", "noise float(point p)");
  Front front;
  slc::CheckedSource source = front.check("color tint(point P) { return noise(P) + .1; }");
  EXPECT_NE(slc::print_ast(source.unit).find("[noise color(point p)]"), std::string::npos);
}

TEST(Overload, bare_triples_take_the_type_of_their_context) {
  expect_row("vector v; v = v * (1, 1, 0);", "operator* vector(vector a, vector b)");
  expect_row("Ci = Cs + (1, 0, 0);", "operator+ color(color a, color b)");
  expect_row("point p; p = P - (0, 1, 0);", "operator- point(point a, vector b)");
  expect_row("float f; f = length((1, 2, 3));", "triple vector(float a, float b, float c)");
}

TEST(Overload, conversions_are_as_cheap_as_can_be) {
  expect_row("float f; f = length(P - E);", "operator- vector(point a, point b)");
  expect_row("Ci = 0.5 * Cs;", "operator* color(float a, color b)");
  expect_row("P = P + 0.1;", "operator+ point(point a, point b)");
  expect_row("N = N + 0.1;", "operator+ normal(normal a, normal b)");
  expect_row("matrix m; m = 1 / m;", "operator/ matrix(float a, matrix b)");
}

TEST(Overload, functions_of_the_source_come_first) {
  std::string own = "float mix(float a, b, c) { return a; } float mix(string a) { return 2; }\n";
  EXPECT_NE(checked("float f; f = mix(1, 2, 3);", own).find("call mix inlined : "), std::string::npos);
  expect_row("Ci = mix(Cs, Os, .5);", "mix color(color a, color b, float t)", own);
}

TEST(Overload, channels_become_arguments) {
  EXPECT_NE(checked("float f; f = texture(name[2], s, t);").find("    2 : uniform float\n"),
            std::string::npos);
  EXPECT_NE(checked("float f; f = texture(list[1], s, t);").find("list[] : uniform string\n"),
            std::string::npos);
  EXPECT_NE(checked("float f; f = texture(name);").find("    0 : uniform float\n"), std::string::npos);
}

TEST(Overload, many_arguments_fold_into_pairs) {
  EXPECT_EQ(checked("float f; f = min(1, 2, 3);"),
            "= : uniform float\n  f : uniform float\n"
            "  call min [min float(float a, float b)] : uniform float\n"
            "    call min [min float(float a, float b)] : uniform float\n"
            "      1 : uniform float\n      2 : uniform float\n    3 : uniform float\n");
}

TEST(Overload, casts_with_spaces_become_calls) {
  expect_row("point p; p = point \"world\" (0, 0, 1);",
             "transform point(uniform string from, uniform string to, point p)");
  expect_row("Ci = color \"hsv\" (0, 0, 1);",
             "ctransform color(uniform string from, uniform string to, color c)");
  expect_row("matrix m; m = matrix \"world\" 1;",
             "spacematrix uniform matrix(uniform string from, uniform string to)");
}

TEST(Overload, compound_assignments_read_their_target_once) {
  EXPECT_EQ(checked("float a[2]; a[1] *= 3;"),
            "*= : uniform float\n  a[] : uniform float\n    1 : uniform float\n"
            "  * [operator* float(float a, float b)] : uniform float\n"
            "    old value : uniform float\n    3 : uniform float\n");
}

} // namespace
