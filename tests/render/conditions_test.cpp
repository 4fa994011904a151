// Conditional RIB and the substitution of state variables.
#include "render/state/condition.h"
#include "render/state/state_values.h"
#include "tests/render/render_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace render::testing {
namespace {

using ::testing::HasSubstr;

std::optional<slvm::Value> lookup(std::string_view name) {
  if (name == "user:pass") return slvm::Value{slvm::Type::kString, 0, {}, {"shadow"}};
  if (name == "user:empty") return slvm::Value{slvm::Type::kString, 0, {}, {""}};
  if (name == "Frame") return slvm::Value{slvm::Type::kFloat, 0, {7}, {}};
  if (name == "Shutter") return slvm::Value{slvm::Type::kFloat, 2, {0, .5f}, {}};
  return {};
}

/// "true", "false" or the error.
std::string outcome(std::string_view expression) {
  auto r = evaluate_condition(expression, lookup);
  if (!r) return r.error();
  return *r ? "true" : "false";
}

TEST(Condition, expressions_and_their_results) {
  const std::pair<const char*, bool> kCases[] = {
      {"1", true},
      {"0", false},
      {"-0", false},
      {"!0", true},
      {"!!'x'", true},
      {"''", false},
      {"'0'", true},
      {"$user:pass == 'shadow'", true},
      {"$user:pass == shadow", true},
      {"${user:pass} != 'beauty'", true},
      {"$user:empty", false},
      {"$Frame == 7", true},
      {"$Frame == '7'", true},
      {"'7.0' == '7'", false},
      {"$Frame > 6 && $Frame <= 7", true},
      {"$Frame < 7 || $Frame >= 8", false},
      {"1 + 2 * 3 == 7", true},
      {"(1 + 2) * 3 == 9", true},
      {"8 / 2 / 2 == 2", true},
      {"5 - 3 - 1 == 1", true},
      {"-$Frame == 0 - 7", true},
      {"1 == 1 == 1", true},
      {"1 || 0 && 0", true},
      {"!0 == 1", true},
      {"$user:pass =~ '^sh.*w$'", true},
      {"$user:pass =~ 'beauty|light'", false},
      {"matches($user:pass, 'had')", true},
      {"defined(user:pass)", true},
      {"defined($user:pass)", true},
      {"defined('user:none')", false},
      {"!defined(user:none) || $user:none == 1", true},
      {"defined(user:none) && $user:none == 1", false},
      {"concat('a', 1 + 1, $user:pass) == 'a2shadow'", true},
      {"concat() == ''", true},
      {"$(concat('user:', 'pass')) == shadow", true},
      {"$Shutter == '0 0.5'", true},
  };
  for (auto [text, value] : kCases)
    EXPECT_EQ(outcome(text), value ? "true" : "false") << text;
}

TEST(Condition, every_mistake_is_named_with_its_column) {
  const std::pair<const char*, const char*> kCases[] = {
      {"", "expected a value, found the end of the expression (column 1 of \"\")"},
      {"1 +", "expected a value, found the end of the expression (column 4"},
      {"1 ) 2", "expected an operator, found ')' (column 3"},
      {"(1", "expected ')', found the end of the expression"},
      {"'abc", "this string is not closed (column 1"},
      {"$", "expected the name of a variable after '$'"},
      {"$user:none == 1", "there is no variable \"user:none\""},
      {"${Frame", "expected '}', found the end of the expression"},
      {"'a' + 1", "'a' is not a number"},
      {"1 / 0", "division by zero"},
      {"sin(1)", "unknown function sin; known are defined, concat, matches"},
      {"defined(a, b)", "defined takes the name of a variable"},
      {"matches(a)", "matches takes a text and a pattern"},
      {"a =~ '('", "'(' is not a pattern: "},
      {"a =~ '(a)\\1'", "patterns take no back references"},
      {"a =~ 'a{2}'", "patterns take no counts in braces"},
      {". == 1", "this is not a number"},
  };
  for (auto [text, message] : kCases)
    EXPECT_THAT(outcome(text), HasSubstr(message)) << text;
  EXPECT_THAT(outcome(std::string(1000, '(')), HasSubstr("parentheses are nested more than 64 deep"));
  EXPECT_THAT(outcome("a =~ '" + std::string(300, 'b') + "'"),
              HasSubstr("the pattern is longer than 256 characters"));
  EXPECT_EQ(outcome(std::string(100000, '!') + "1"), "true");
}

TEST(Condition, substitution_in_strings) {
  auto filled = [](const char* text) { return substitute_variables(text, "$", lookup).text; };
  EXPECT_EQ(filled("a_$user:pass.tex"), "a_shadow.tex");
  EXPECT_EQ(filled("${user:pass}s"), "shadows");
  EXPECT_EQ(filled("f$Frame: $Shutter"), "f7: 0 0.5");
  EXPECT_EQ(filled("$$Frame costs $5 $"), "$Frame costs $5 $");
  EXPECT_EQ(filled("${Frame"), "${Frame");
  Substituted s = substitute_variables("x$none y", "$", lookup);
  EXPECT_EQ(s.text, "x$none y");
  EXPECT_EQ(s.unknown, "none");
  EXPECT_EQ(substitute_variables("%Frame$Frame", "%", lookup).text, "7$Frame");
}

TEST(StateValues, attributes_and_options_by_name) {
  Options o;
  o.frame = 12;
  EXPECT_EQ(option_value(o, "Ri:Frame")->numbers, std::vector<float>{12});
  EXPECT_EQ(option_value(o, "Format")->numbers, (std::vector<float>{640, 480, 1}));
  EXPECT_FALSE(option_value(o, "user:none"));
  Attributes a;
  a.orientation = Orientation::kInside;
  EXPECT_EQ(text_of(*attribute_value(a, "Ri:Orientation")), "inside");
  EXPECT_EQ(text_of(*attribute_value(a, "Color")), "1 1 1");
}

std::vector<float> radii(const std::string& rib) {
  std::vector<float> out;
  for (const Primitive& p : render_text("Format 4 4 1\n" + rib).scene.primitives)
    out.push_back(p.attributes().shading_rate);
  return out;
}

TEST(ConditionalRib, one_branch_is_taken) {
  auto taken = [](const std::string& pass) {
    return radii("Option \"user\" \"string pass\" [\"" + pass +
                 "\"] WorldBegin IfBegin \"$user:pass == 'a'\" ShadingRate 2 ElseIf \"$user:pass == 'b'\" "
                 "ShadingRate 3 IfBegin \"1\" ElseIf \"1\" ShadingRate 9 Else ShadingRate 9 IfEnd Else "
                 "ShadingRate 4 IfEnd Disk 0 1 360 WorldEnd");
  };
  EXPECT_EQ(taken("a"), std::vector<float>{2});
  EXPECT_EQ(taken("b"), std::vector<float>{3});
  EXPECT_EQ(taken("c"), std::vector<float>{4});
}

TEST(ConditionalRib, skipped_branches_may_hold_anything) {
  EXPECT_EQ(
      radii("WorldBegin IfBegin \"0\" WorldEnd AttributeEnd IfBegin \"nonsense(\" Else IfEnd ElseIf \"0\" "
            "FrameEnd Else Disk 0 1 360 IfEnd WorldEnd")
          .size(),
      1u);
}

TEST(ConditionalRib, attributes_hide_options_and_prefixes_choose) {
  EXPECT_EQ(
      radii("Option \"user\" \"float x\" 1 WorldBegin Attribute \"user\" \"float x\" 2 "
            "IfBegin \"$user:x == 2 && $Option:user:x == 1 && $Attribute:user:x == 2\" Disk 0 1 360 IfEnd "
            "AttributeBegin ShadingRate 5 IfBegin \"$ShadingRate == 5\" Disk 0 1 360 IfEnd AttributeEnd "
            "WorldEnd"),
      (std::vector<float>{1, 5}));
}

TEST(ConditionalRib, mistakes_are_named) {
  EXPECT_THAT(
      messages_of("IfBegin \"$user:x\" IfEnd"),
      HasSubstr("test.rib:1:9: error: IfBegin: there is no variable \"user:x\" (column 8 of \"$user:x\"); "
                "the condition counts as false"));
  EXPECT_THAT(messages_of("IfBegin \"0\" Else Else IfEnd"),
              HasSubstr("Else: Else is the last branch of a condition; this one is not taken"));
  EXPECT_THAT(messages_of("IfBegin \"1\""), HasSubstr("this block is not closed before the end of the file"));
}

TEST(Substitution, happens_in_inline_archives_at_the_instance) {
  std::string archive =
      "ArchiveBegin \"a\" Attribute \"identifier\" \"name\" [\"$user:x\"] Disk 0 1 360 ArchiveEnd ";
  Rendered r = render_text("Format 4 4 1 WorldBegin " + archive +
                           "Attribute \"user\" \"string x\" \"one\" ArchiveInstance \"a\" "
                           "Attribute \"user\" \"string x\" \"two\" ReadArchive \"a\" "
                           "Attribute \"identifier\" \"name\" [\"$user:x\"] Disk 0 1 360 WorldEnd");
  ASSERT_EQ(r.scene.primitives.size(), 3u);
  EXPECT_EQ(r.scene.primitives[0].attributes().name, "one");
  EXPECT_EQ(r.scene.primitives[1].attributes().name, "two");
  EXPECT_EQ(r.scene.primitives[2].attributes().name, "$user:x");
}

TEST(Substitution, can_be_switched_on_for_files) {
  Rendered r =
      render_text("Format 4 4 1 Option \"ribparse\" \"string varsubst\" [\"$\"] FrameBegin 3 WorldBegin "
                  "Attribute \"identifier\" \"name\" [\"f$Frame\"] Disk 0 1 360 WorldEnd FrameEnd");
  EXPECT_EQ(r.scene.primitives[0].attributes().name, "f3");
  EXPECT_THAT(messages_of("Option \"ribparse\" \"string varsubst\" [\"$\"]\nCoordinateSystem \"$user:y\""),
              HasSubstr("2:18: error: CoordinateSystem: there is no variable \"user:y\" to be put in here"));
}

} // namespace
} // namespace render::testing
