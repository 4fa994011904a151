// The lexer: numbers, dots, strings, pragmas.
#include "tests/unit/slc/front_end.h"

#include <gtest/gtest.h>

namespace {

using slc_test::Front;

// The tokens' texts, separated by blanks.
std::string tokens(const std::string& text) {
  Front front;
  std::string out;
  slc::TokenList list = front.lex(text);
  for (const slc::Token& t : list.tokens)
    if (t.kind != slc::TokenKind::kEnd) out += (out.empty() ? "" : " ") + t.text;
  return out + front.messages();
}

TEST(Lex, a_dot_behind_an_operand_is_the_dot_product) {
  EXPECT_EQ(tokens("L.A In.Nn f(x).N a[1].b"), "L . A In . Nn f ( x ) . N a [ 1 ] . b");
  EXPECT_EQ(tokens("x = .5 + 1. - 2.e3"), "x = .5 + 1. - 2.e3");
  EXPECT_EQ(tokens("return .5; color .5"), "return .5 ; color .5");
  EXPECT_EQ(tokens("N .5"), "N . 5");
}

TEST(Lex, numbers_have_their_values) {
  Front front;
  std::vector<float> values;
  slc::TokenList list = front.lex("1, .25, 3., 1e3, 2.5E-1, 007");
  for (const slc::Token& t : list.tokens)
    if (t.kind == slc::TokenKind::kNumber) values.push_back(t.number);
  EXPECT_EQ(values, (std::vector<float>{1, .25f, 3, 1000, .25f, 7}));
}

TEST(Lex, strings_resolve_escapes) {
  Front front;
  slc::TokenList list = front.lex("\"a\\tb\\n\\\"\\\\\\101\\0\" \"h\xe9llo\"");
  ASSERT_EQ(list.tokens.size(), 3u);
  EXPECT_EQ(list.tokens[0].text, std::string("a\tb\n\"\\A\0", 8));
  EXPECT_EQ(list.tokens[1].text, "h\xe9llo");
}

TEST(Lex, operators_take_the_longest_form) {
  EXPECT_EQ(tokens("a+=b->c<=d!=!e&&f||g"), "a += b -> c <= d != ! e && f || g");
}

TEST(Lex, annotations_are_kept) {
  Front front;
  slc::TokenList list =
      front.lex("#pragma annotation \"author\" \"some\" \"body\"\n#pragma annotation \"id\" \"text\"\n");
  ASSERT_EQ(list.annotations.size(), 1u);
  EXPECT_EQ(list.annotations[0].id, "id");
  EXPECT_EQ(list.annotations[0].text, "text");
}

} // namespace
