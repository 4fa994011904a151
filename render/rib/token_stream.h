// The words of a RIB stream, whatever its encoding. The parser sees nothing else of a file; the lexer of
// files (lexer.h) is one source of tokens.
#pragma once

#include "slvm/support/source.h"

#include <cstdint>
#include <string>
#include <vector>

namespace render {

enum class TokenKind : uint8_t {
  kEnd,
  kWord, ///< the name of a request
  kInteger,
  kReal,
  kString,
  kOpen,  ///< [
  kClose, ///< ]
  kDash,  ///< a "-" that is not the sign of a number
  kError, ///< text holds the message; the stream can be read on
};

struct Token {
  TokenKind kind = TokenKind::kEnd;
  double number = 0;
  std::string text; ///< of words, strings (escapes resolved) and errors
  slvm::SourceRange where;
  size_t offset = 0;    ///< first byte, counted from the beginning of the stream
  bool encoded = false; ///< in binary: lines and columns tell a reader little

  bool is_number() const { return kind == TokenKind::kInteger || kind == TokenKind::kReal; }
};

struct Comment {
  std::string text; ///< without the first # and the line end
  slvm::SourceRange where;
};

class TokenStream {
public:
  virtual ~TokenStream() = default;
  /// With `keep_comments` those that next() passes are gathered, until their reader clears them.
  bool keep_comments = false;
  std::vector<Comment> comments;
  /// Replaces `token` by the next one; kEnd again and again at the end.
  virtual void next(Token& token) = 0;
  /// Takes back the last token and moves what follows the token before it, from the next line on, into
  /// `data`: everything up to a line `ArchiveEnd "name"`, which is the next to be read. False: there is no
  /// such line.
  virtual bool read_data(const std::string& name, std::string& data) = 0;
};

} // namespace render
