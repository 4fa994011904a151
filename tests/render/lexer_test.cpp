// Tokens of RIB, ASCII and encoded.
#include "tests/render/tokens.h"

#include <gtest/gtest.h>

#include <vector>

namespace render {
namespace {

TEST(Lexer, kinds_of_tokens) {
  auto t = tokens_of("Sphere 1 -.5 [ \"a b\" ] - 2e3");
  ASSERT_EQ(t.size(), 8u);
  EXPECT_EQ(t[0].kind, TokenKind::kWord);
  EXPECT_EQ(t[0].text, "Sphere");
  EXPECT_EQ(t[1].kind, TokenKind::kInteger);
  EXPECT_EQ(t[2].kind, TokenKind::kReal);
  EXPECT_EQ(t[2].number, -0.5);
  EXPECT_EQ(t[3].kind, TokenKind::kOpen);
  EXPECT_EQ(t[4].text, "a b");
  EXPECT_EQ(t[5].kind, TokenKind::kClose);
  EXPECT_EQ(t[6].kind, TokenKind::kDash);
  EXPECT_EQ(t[7].number, 2000);
}

TEST(Lexer, forms_of_numbers) {
  const std::pair<const char*, double> kCases[] = {{"+5", 5},     {"5.", 5},      {".5", 0.5},
                                                   {"-.5", -0.5}, {"1e-3", 1e-3}, {"1.5E+2", 150},
                                                   {"-0", 0},     {"007", 7}};
  for (auto [text, value] : kCases) {
    auto t = tokens_of(text);
    ASSERT_EQ(t.size(), 1u) << text;
    EXPECT_TRUE(t[0].is_number()) << text;
    EXPECT_EQ(t[0].number, value) << text;
  }
}

TEST(Lexer, string_escapes) {
  auto t = tokens_of(R"("a\n\t\\\"\101\q\
b")");
  ASSERT_EQ(t.size(), 1u);
  EXPECT_EQ(t[0].text, "a\n\t\\\"Aqb");
}

TEST(Lexer, comments_end_with_any_line_end_and_not_in_strings) {
  auto t = tokens_of("1 # two\r2 # x\n3 # y\r\n4 \"# no\"");
  ASSERT_EQ(t.size(), 5u);
  EXPECT_EQ(t[4].text, "# no");
}

TEST(Lexer, positions_count_all_line_ends) {
  auto t = tokens_of("A\nB\r\n C\rDD");
  ASSERT_EQ(t.size(), 4u);
  EXPECT_EQ(t[0].where, (slvm::SourceRange{1, 1, 1, 2}));
  EXPECT_EQ(t[1].where, (slvm::SourceRange{1, 2, 1, 2}));
  EXPECT_EQ(t[2].where, (slvm::SourceRange{1, 3, 2, 3}));
  EXPECT_EQ(t[3].where, (slvm::SourceRange{1, 4, 1, 3}));
}

TEST(Lexer, errors_are_tokens_and_reading_goes_on) {
  EXPECT_EQ(tokens_of("\"abc")[0].text, "this string is not closed before the end of the file");
  EXPECT_EQ(tokens_of("1e999")[0].text, "the number 1e999 is out of range");
  EXPECT_EQ(tokens_of("12abc")[0].text, "'12abc' is neither a number nor a request");
  EXPECT_EQ(tokens_of("@@ 1")[0].text, "'@' has no meaning in a RIB file");
  auto t = tokens_of("\xa8\xa9 Sphere");
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].text, "byte 0xa8 has no meaning in a RIB file");
  EXPECT_EQ(t[1].text, "byte 0xa9 has no meaning in a RIB file");
  EXPECT_EQ(t[2].text, "Sphere");
}

TEST(Lexer, end_comes_again_and_again) {
  Lexer lexer("", 1);
  Token t;
  for (int i = 0; i < 3; ++i) {
    lexer.next(t);
    EXPECT_EQ(t.kind, TokenKind::kEnd);
  }
}

} // namespace
} // namespace render
