// The parser: tokens to a syntax tree without types. Read next: parser.h, then declarations.cpp,
// statements.cpp, expressions.cpp (one function per grammar rule) and recovery.cpp (what happens after an
// error).
#pragma once

#include "slc/ast/unit.h"
#include "slc/lex/lexer.h"

namespace slc {

/// Parses a whole file. Errors go to `diags`; what could be parsed is in the result all the same.
TranslationUnit parse(TokenList tokens, slvm::Diagnostics& diags);

/// Deepest nesting of statements, and of parentheses in an expression; longest chain of operators of one
/// precedence.
inline constexpr int kMaxNesting = 200;
inline constexpr int kMaxChain = 1000;

} // namespace slc
