// Tokens of an ASCII RIB file: words, numbers, strings with escapes, brackets, # comments.
#pragma once

#include "render/rib/token_stream.h"

#include <string_view>

namespace render {

class AsciiLexer : public TokenStream {
public:
  /// `text` must outlive the lexer; `file` goes into every position.
  AsciiLexer(std::string_view text, slvm::FileId file);
  void next(Token& token) override;

private:
  void skip_blanks();
  void read_string(Token& token);
  void read_escape(std::string& out);
  void read_number(Token& token);
  void read_word(Token& token);
  void read_garbage(Token& token);
  char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void advance();
  bool starts_number() const;
  uint32_t column() const { return static_cast<uint32_t>(at_ - line_start_) + 1; }

  std::string_view text_;
  size_t at_ = 0;
  size_t line_start_ = 0;
  uint32_t line_ = 1;
  slvm::FileId file_;
};

} // namespace render
