// Tokens of a RIB file: words, numbers, strings with escapes, brackets, # comments, and their binary
// encodings (encoding.h) in any mixture.
#pragma once

#include "render/rib/encoding.h"
#include "render/rib/token_stream.h"

#include <string_view>

namespace render {

class Lexer : public TokenStream {
public:
  /// `text` must outlive the lexer; `file` goes into every position.
  Lexer(std::string_view text, slvm::FileId file);
  void next(Token& token) override;
  bool read_data(const std::string& name, std::string& data) override;

private:
  void skip_blanks();
  void read_string(Token& token);
  void read_escape(std::string& out);
  void read_number(Token& token);
  void read_word(Token& token);
  void read_garbage(Token& token);
  void read_encoded(Token& token);
  bool read_encoded_item(Token& token);
  void read_array_element(Token& token);
  bool read_definition(const EncodedHead& head, uint64_t code, Token& token);
  bool take(size_t count, std::string_view& bytes, Token& token);
  char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void advance();
  bool starts_number() const;
  uint32_t column() const { return static_cast<uint32_t>(at_ - line_start_) + 1; }

  struct Position {
    size_t at = 0, line_start = 0;
    uint32_t line = 1;
  };

  std::string_view text_;
  size_t at_ = 0;
  size_t line_start_ = 0;
  uint32_t line_ = 1;
  Position before_; ///< where the last token's blanks began
  slvm::FileId file_;
  EncodedNames names_;
  size_t array_left_ = 0; ///< numbers left of an encoded array whose '[' was handed out
  bool in_array_ = false;
  bool ended_ = false; ///< by the mark for the end of a stream
};

} // namespace render
