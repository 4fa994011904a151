// The parser, by the printed tree.
#include "tests/unit/slc/front_end.h"

#include <gtest/gtest.h>

namespace {

using slc_test::Front;

// The tree of `x = EXPRESSION;` on one line, children in parentheses.
std::string tree(const std::string& expression) {
  Front front;
  slc::TranslationUnit unit = front.parse("surface s() { x = " + expression + "; }");
  if (front.diags.has_errors()) return front.messages();
  const auto* statement = slc::as<slc::ExpressionStmt>(unit.shaders[0].body->statements[0].get());
  const auto* assign = slc::as<slc::AssignExpr>(statement->expressions[0].get());
  std::string out;
  size_t depth = 0;
  std::string text = slc::print_ast(*assign->value);
  for (size_t begin = 0; begin < text.size();) {
    size_t end = text.find('\n', begin), indent = text.find_first_not_of(' ', begin) - begin;
    if (indent / 2 > depth)
      out += '(';
    else if (begin > 0)
      out += std::string(depth - indent / 2, ')') + " ";
    depth = indent / 2;
    out += text.substr(begin + indent, end - begin - indent);
    begin = end + 1;
  }
  return out + std::string(depth, ')');
}

TEST(Parse, precedence) {
  EXPECT_EQ(tree("a + b * c"), "+(a *(b c))");
  EXPECT_EQ(tree("a * b ^ c"), "^(*(a b) c)");
  EXPECT_EQ(tree("-I.N"), ".(-(I) N)");
  EXPECT_EQ(tree("a.b * c"), "*(.(a b) c)");
  EXPECT_EQ(tree("a ^ b + c"), "+(^(a b) c)");
  EXPECT_EQ(tree("a - b - c"), "-(-(a b) c)");
  EXPECT_EQ(tree("a < b == c > d"), "==(<(a b) >(c d))");
  EXPECT_EQ(tree("a || b && !c"), "||(a &&(b !(c)))");
  EXPECT_EQ(tree("a ? b : c ? d : e"), "?:(a b ?:(c d e))");
  EXPECT_EQ(tree("b = c += d"), "=(b +=(c d))");
}

TEST(Parse, casts_bind_to_the_next_unary_expression) {
  EXPECT_EQ(tree("float noise(u, v) * 2 - 1"), "-(*(cast float(call noise(u v)) 2) 1)");
  EXPECT_EQ(tree("color \"hsv\" (1, 2, 3)"), "cast color \"hsv\"(tuple(1 2 3))");
  EXPECT_EQ(tree("2 * -color P.N"), "*(2 .(-(cast color(P)) N))");
}

TEST(Parse, calls_and_channels) {
  EXPECT_EQ(tree("surface(\"a\" \"b\", x)"), "call surface(\"ab\" x)");
  EXPECT_EQ(tree("texture(\"a\"[2], s)"), "call texture(channel(2) \"a\" s)");
  EXPECT_EQ(tree("a[1 + i]"), "a[](+(1 i))");
}

TEST(Parse, formals_in_all_their_forms) {
  Front front;
  slc::TranslationUnit unit =
      front.parse("float f(float a, b; output varying color c, normal n; point list[], m[3];) { return a; }");
  EXPECT_EQ(front.messages(), "");
  EXPECT_EQ(slc::print_ast(unit),
            "function float f\n  formal float a\n  formal float b\n  formal output varying color c\n"
            "  formal normal n\n  formal point[] list\n  formal point[] m\n    length\n      3\n"
            "  block\n    return\n      a\n");
}

TEST(Parse, words_are_names_where_they_can_be) {
  Front front;
  front.parse("surface s(float gather = 1, light = 2) { float solar = gather; float struct = light; solar += "
              "struct; }");
  EXPECT_EQ(front.messages(), "");
}

TEST(Parse, survives_any_cut) {
  std::string text = "float f(float a, b; output color c[2]) { if (a > b) c[0] = (1, 2, 3); else while (a < "
                     "2) { break 1; } return a; }\n"
                     "surface s(string n = \"x\"; float k[2] = {1, 2}) { illuminance(P, N, 1) { Ci += "
                     "texture(n[0], s, t); } "
                     "gather(\"\", P, N, 0, 1, \"ray:length\", k) { ; } else ; for (k = 1; k < 2; k += 1) "
                     "float g() { return 1; } }";
  for (size_t cut = 0; cut < text.size(); ++cut) {
    Front front;
    front.check(text.substr(0, cut));
    Front missing;
    missing.check(text.substr(0, cut) + text.substr(cut + 1));
    Front doubled;
    doubled.check(text.substr(0, cut) + text.substr(cut, 1) + text.substr(cut));
  }
}

TEST(Parse, depth_is_bounded) {
  for (const char* unit : {"(", "-", "{", "if (1) ", "float ", "x = ", "f(", "a[", "1 ? ", "{ float f() "}) {
    Front front;
    std::string text = "surface s() { ";
    for (int i = 0; i < 100'000; ++i)
      text += unit;
    front.check(text);
    EXPECT_TRUE(front.diags.has_errors()) << unit;
  }
  Front chain;
  std::string text = "surface s() { Ci = 1";
  for (int i = 0; i < 100'000; ++i)
    text += " + 1";
  chain.check(text + "; }");
  EXPECT_TRUE(chain.diags.has_errors());
}

} // namespace
