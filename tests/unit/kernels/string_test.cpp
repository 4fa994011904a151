// concat, match, arraylength.
#include "slvm/kernels/regex.h"
#include "tests/unit/kernels/harness.h"

#include <chrono>

#include <gtest/gtest.h>

namespace slvm::test {
namespace {

TEST(String, ConcatJoinsAnyNumberOfTexts) {
  StringPool strings;
  std::mt19937 random(1);
  ShadeopId row = row_of("concat", "string(uniform string parts...)");
  Arguments arguments = make_arguments(row, kMaxLanes, Values::kModerate, random, strings, ~0u);
  std::string expected;
  for (const Value& v : arguments.values)
    expected += strings.text(v.bits[0][0]);
  Value v = call(kernel_table(), row, arguments, strings)[0];
  for (size_t lane = 0; lane < kMaxLanes; ++lane)
    EXPECT_EQ(strings.text(v.bits[lane][0]), expected);
}

TEST(String, ArraylengthCountsElements) {
  StringPool strings;
  std::mt19937 random(1);
  for (ShadeopId row : shadeop_overloads("arraylength")) {
    Arguments arguments = make_arguments(row, kMaxLanes, Values::kModerate, random, strings);
    EXPECT_EQ(call(kernel_table(), row, arguments, strings)[0].at(0), float(kManyKnots));
  }
}

TEST(Match, FindsThePatternAnywhere) {
  EXPECT_TRUE(regex_found("b+", "abbc"));
  EXPECT_TRUE(regex_found("^left_.*eye$", "left_upper_eye"));
  EXPECT_FALSE(regex_found("^eye", "left_eye"));
  EXPECT_TRUE(regex_found("[0-9]{2,3}", "frame 0123"));
  EXPECT_TRUE(regex_found("(cat|dog)s?", "dogs"));
  EXPECT_TRUE(regex_found("", "anything"));
}

TEST(Match, IsFalseForPatternsThatAreNotWellFormed) {
  EXPECT_FALSE(regex_found("a(", "a("));
  EXPECT_FALSE(regex_found("[z-a]", "b"));
  EXPECT_FALSE(regex_found("*", "*"));
}

TEST(Match, HostilePatternsEndQuickly) {
  auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(regex_found("((a{1,1000}){1,1000}){1,1000}b", std::string(1000, 'a')));
  EXPECT_FALSE(regex_found("a{99999999999999999999}", "a"));
  regex_found("(a*)*b", std::string(1000, 'a'));
  regex_found(std::string(1000, '('), "a");
  regex_found("(x+x+)+y", std::string(1000, 'x'));
  EXPECT_FALSE(regex_found("a", std::string(1 << 20, 'a')));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

} // namespace
} // namespace slvm::test
