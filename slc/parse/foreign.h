// Words and operators of other languages, with what the shading language has instead: for people who come
// from C, GLSL, HLSL or OSL. The parser reports them and goes on with what is meant, so that one habit is one
// message.
#pragma once

#include "slc/ast/expr.h"

#include <string>
#include <string_view>

namespace slc {

/// A type: `int i`.
struct ForeignType {
  std::string_view word;
  Type type; ///< the nearest one; kVoid: nothing is near
  std::string_view advice;
};
const ForeignType* foreign_type(std::string_view word);

/// A word before a type: `const float`, `inout float`.
struct ForeignSpecifier {
  std::string_view word, advice;
  bool output; ///< means that the formal is set
};
const ForeignSpecifier* foreign_specifier(std::string_view word);

/// An operator between two values: `a % b`.
struct ForeignOperator {
  std::string_view text;
  int level; ///< of the grammar (expressions.cpp); -1: none
  std::string_view advice;
  std::string_view function; ///< that computes it, or ""
  Operator op;               ///< else, the operator meant; kNot: none
};
const ForeignOperator* foreign_operator(std::string_view text);

/// A statement, by its first word: `switch (x) {...}`; "" when the word starts none.
std::string_view foreign_statement(std::string_view word);

/// What to write for `object.member`, or `object.member = ...`: "" when the member is no name of a component.
std::string member_advice(std::string_view object, std::string_view member, bool assigned);

} // namespace slc
