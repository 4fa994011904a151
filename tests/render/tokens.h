// The tokens of a text, for tests of the lexer.
#pragma once

#include "render/rib/lexer.h"

#include <vector>

namespace render {

inline std::vector<Token> tokens_of(std::string_view text) {
  Lexer lexer(text, 1);
  std::vector<Token> out;
  do {
    lexer.next(out.emplace_back());
  } while (out.back().kind != TokenKind::kEnd && out.size() < 1000);
  out.pop_back();
  return out;
}

} // namespace render
