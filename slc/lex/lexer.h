// The lexer: preprocessed text to tokens with source ranges. RSL has no reserved words here: `surface`,
// `gather`, `if` and `float` are all identifiers, and the parser takes them for keywords where its grammar
// can.
#pragma once

#include "slc/preprocess/preprocess.h"

#include <string>
#include <string_view>
#include <vector>

namespace slc {

enum class TokenKind : uint8_t {
  kEnd,
  kIdentifier,
  kNumber,
  kString,
  kPlus,
  kMinus,
  kStar,
  kSlash,
  kDot,
  kCaret,
  kAssign,
  kPlusAssign,
  kMinusAssign,
  kStarAssign,
  kSlashAssign,
  kEqual,
  kNotEqual,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kAnd,
  kOr,
  kNot,
  kQuestion,
  kColon,
  kLeftParen,
  kRightParen,
  kLeftBrace,
  kRightBrace,
  kLeftBracket,
  kRightBracket,
  kComma,
  kSemicolon,
  kArrow,
  kForeign ///< an operator of other languages: ++ -- % & | ~ << ** and so on
};

struct Token {
  TokenKind kind = TokenKind::kEnd;
  bool after_nolint = false; ///< the first token behind a `#pragma nolint`
  bool is_integer = false;   ///< a number of digits only
  bool unterminated = false; ///< a string whose end is missing: reported
  bool after_error = false;  ///< characters before it were reported and skipped
  float number = 0;
  slvm::SourceRange range;
  std::string text; ///< as spelled; of strings the value, escapes resolved
};

struct PragmaAnnotation {
  std::string id, text;
  slvm::SourceRange where;
};

struct TokenList {
  std::vector<Token> tokens; ///< ends with one kEnd
  std::vector<PragmaAnnotation> annotations;
};

/// Never fails: what is no token is reported and skipped.
TokenList lex(const PreprocessedText&, slvm::Diagnostics&);

} // namespace slc
