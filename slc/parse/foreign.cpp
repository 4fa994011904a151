// The tables of foreign words.
#include "slc/parse/foreign.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace slc {
namespace {

constexpr std::string_view kNumber = "all numbers are floats", kTriple = "use vector, point, normal or color";

constexpr ForeignType kTypes[] = {
    {"int", Type::kFloat, kNumber},
    {"integer", Type::kFloat, kNumber},
    {"unsigned", Type::kFloat, kNumber},
    {"short", Type::kFloat, kNumber},
    {"long", Type::kFloat, kNumber},
    {"double", Type::kFloat, kNumber},
    {"half", Type::kFloat, kNumber},
    {"real", Type::kFloat, kNumber},
    {"bool", Type::kFloat, "use a float, 0 or 1"},
    {"boolean", Type::kFloat, "use a float, 0 or 1"},
    {"char", Type::kString, "texts are strings"},
    {"sampler2D", Type::kString, "a texture is named by a string"},
    {"vec2", Type::kVoid, "use two floats, or a triple"},
    {"float2", Type::kVoid, "use two floats, or a triple"},
    {"vec3", Type::kVector, kTriple},
    {"float3", Type::kVector, kTriple},
    {"half3", Type::kVector, kTriple},
    {"double3", Type::kVector, kTriple},
    {"vector3", Type::kVector, kTriple},
    {"vec4", Type::kVoid, "use a color and a float"},
    {"float4", Type::kVoid, "use a color and a float"},
    {"half4", Type::kVoid, "use a color and a float"},
    {"rgb", Type::kColor, "use color"},
    {"mat3", Type::kMatrix, "matrices are 4x4; use matrix"},
    {"mat4", Type::kMatrix, "use matrix"},
    {"float3x3", Type::kMatrix, "matrices are 4x4; use matrix"},
    {"float4x4", Type::kMatrix, "use matrix"},
    {"matrix4", Type::kMatrix, "use matrix"},
};

constexpr ForeignSpecifier kSpecifiers[] = {
    {"const", "leave it out, or write #define for a constant", false},
    {"static", "leave it out, nothing is kept from one run to the next", false},
    {"register", "leave it out", false},
    {"volatile", "leave it out", false},
    {"in", "leave it out, what is not declared 'output' is read-only", false},
    {"out", "write 'output'", true},
    {"inout", "write 'output'", true},
    {"ref", "write 'output'", true},
    {"closure", "leave it out, a surface computes its color itself, in Ci", false},
    {"attribute", "leave it out, primitive variables override parameters of their name", false},
};

constexpr std::string_view kNoBits = "there are no bit operations";
constexpr ForeignOperator kOperators[] = {
    {"%", 6, "write mod(a, b)", "mod", Operator::kNot},
    {"**", 6, "write pow(a, b)", "pow", Operator::kNot},
    {"<<", 4, kNoBits, "", Operator::kNot},
    {">>", 4, kNoBits, "", Operator::kNot},
    {"&", 1, "logical 'and' is &&, and there are no bit operations", "", Operator::kNot},
    {"|", 0, "logical 'or' is ||, and there are no bit operations", "", Operator::kNot},
    {"and", 1, "logical 'and' is &&", "", Operator::kNot},
    {"or", 0, "logical 'or' is ||", "", Operator::kNot},
    {"=<", 3, "less or equal is <=", "", Operator::kLessEqual},
    {"=>", 3, "greater or equal is >=", "", Operator::kGreaterEqual},
    {"<>", 2, "not equal is !=", "", Operator::kNotEqual},
    {"===", 2, "equal is ==", "", Operator::kEqual},
    {"!==", 2, "not equal is !=", "", Operator::kNotEqual},
    {"++", -1, "write x += 1", "", Operator::kNot},
    {"--", -1, "write x -= 1", "", Operator::kNot},
    {"~", -1, kNoBits, "", Operator::kNot},
    {"not", -1, "logical 'not' is !", "", Operator::kNot},
    {"%=", -1, "write x = mod(x, y)", "", Operator::kNot},
    {"^=", -1, "write x = x ^ y", "", Operator::kNot},
    {"&=", -1, kNoBits, "", Operator::kNot},
    {"|=", -1, kNoBits, "", Operator::kNot},
};

constexpr std::pair<std::string_view, std::string_view> kStatements[] = {
    {"switch", "write if ... else if ..."},
    {"do", "write while (condition) ..., or while (1 > 0) { ... if (...) break; }"},
    {"goto", "loops are left by break, functions by return"},
    {"foreach", "write for (i = 0; i < n; i += 1) ..."},
    {"unless", "write if (!(...)) ..."},
    {"until", "write while (!(...)) ..."},
    {"repeat", "write for (i = 0; i < n; i += 1) ..."},
};

} // namespace

const ForeignType* foreign_type(std::string_view word) {
  auto it =
      std::find_if(std::begin(kTypes), std::end(kTypes), [&](const auto& row) { return row.word == word; });
  return it == std::end(kTypes) ? nullptr : it;
}

const ForeignSpecifier* foreign_specifier(std::string_view word) {
  auto it = std::find_if(std::begin(kSpecifiers), std::end(kSpecifiers),
                         [&](const auto& row) { return row.word == word; });
  return it == std::end(kSpecifiers) ? nullptr : it;
}

const ForeignOperator* foreign_operator(std::string_view text) {
  auto it = std::find_if(std::begin(kOperators), std::end(kOperators),
                         [&](const auto& row) { return row.text == text; });
  return it == std::end(kOperators) ? nullptr : it;
}

std::string_view foreign_statement(std::string_view word) {
  for (const auto& [first, advice] : kStatements)
    if (first == word) return advice;
  return {};
}

std::string member_advice(std::string_view object, std::string_view member, bool assigned) {
  constexpr std::string_view kAxes = "xyz", kColors = "rgb";
  bool several = member == "xyz" || member == "rgb" || member == "rgba" || member == "xy";
  if (several) return fmt::format("{} itself, all its components", object);
  if (member.size() != 1) return {};
  std::string_view value = assigned ? ", value" : "";
  if (size_t i = kAxes.find(member); i != kAxes.npos)
    return fmt::format("{}{}comp({}{})", assigned ? "set" : "", member, object, value);
  if (size_t i = kColors.find(member); i != kColors.npos)
    return fmt::format("{}comp({}, {}{})", assigned ? "set" : "", object, i, value);
  return {};
}

} // namespace slc
