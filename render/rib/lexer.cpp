// RIB text: RISpec 3.2, appendix C; encoded tokens are in encoded_tokens.cpp. Line ends (LF, CR, CRLF) only
// separate; positions count them.
#include "render/rib/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace render {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool is_octal(char c) {
  return c >= '0' && c <= '7';
}

} // namespace

Lexer::Lexer(std::string_view text, slvm::FileId file) : text_(text), file_(file) {}

void Lexer::advance() {
  char c = text_[at_++];
  if (c == '\n' || (c == '\r' && peek() != '\n')) {
    ++line_;
    line_start_ = at_;
  }
}

void Lexer::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      advance();
    } else if (text_[at_] == '#') {
      uint32_t first_column = column();
      size_t begin = at_ + 1;
      while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r')
        ++at_;
      if (keep_comments)
        comments.push_back(
            {std::string(text_.substr(begin, at_ - begin)), {file_, line_, first_column, column()}});
    } else {
      return;
    }
  }
}

bool Lexer::starts_number() const {
  size_t i = peek() == '+' || peek() == '-' ? 1 : 0;
  return is_digit(peek(i)) || (peek(i) == '.' && is_digit(peek(i + 1)));
}

void Lexer::next(Token& token) {
  before_ = {at_, line_start_, line_};
  if (!in_array_) skip_blanks();
  token.text.clear();
  token.number = 0;
  token.encoded = false;
  token.offset = at_;
  token.where = {file_, line_, column(), column()};
  if (in_array_) {
    read_array_element(token);
    return;
  }
  if (at_ >= text_.size() || ended_) {
    token.kind = TokenKind::kEnd;
    return;
  }
  uint32_t first_line = line_;
  char c = peek();
  if (c == '[' || c == ']') {
    token.kind = c == '[' ? TokenKind::kOpen : TokenKind::kClose;
    ++at_;
  } else if (is_encoded(c)) {
    read_encoded(token);
  } else if (c == '"') {
    read_string(token);
  } else if (starts_number()) {
    read_number(token);
  } else if (c == '-') {
    token.kind = TokenKind::kDash;
    ++at_;
  } else if (is_letter(c)) {
    read_word(token);
  } else {
    read_garbage(token);
  }
  // A range never leaves its line: of a string over several lines the first character is marked.
  token.where.end = line_ == first_line ? column() : token.where.column + 1;
}

bool Lexer::read_data(const std::string& name, std::string& data) {
  at_ = before_.at;
  line_start_ = before_.line_start;
  line_ = before_.line;
  auto skip_line = [&] {
    for (uint32_t line = line_; at_ < text_.size() && line_ == line;)
      advance();
  };
  skip_line();
  size_t begin = at_;
  while (at_ < text_.size()) {
    size_t line_end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    std::string_view line = text_.substr(at_, line_end - at_);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    constexpr std::string_view kEnd = "ArchiveEnd";
    if (line.starts_with(kEnd)) {
      line.remove_prefix(kEnd.size());
      line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
      if (line.starts_with("\"" + name + "\"")) {
        data = text_.substr(begin, at_ - begin);
        return true;
      }
    }
    skip_line();
  }
  data = text_.substr(begin);
  return false;
}

void Lexer::read_word(Token& token) {
  token.kind = TokenKind::kWord;
  size_t begin = at_;
  while (is_letter(peek()) || is_digit(peek()))
    ++at_;
  token.text = text_.substr(begin, at_ - begin);
}

void Lexer::read_number(Token& token) {
  size_t begin = at_;
  if (peek() == '+' || peek() == '-') ++at_;
  bool real = false;
  while (is_digit(peek()))
    ++at_;
  if (peek() == '.') {
    real = true;
    ++at_;
    while (is_digit(peek()))
      ++at_;
  }
  size_t exponent = peek(1) == '+' || peek(1) == '-' ? 2 : 1;
  if ((peek() == 'e' || peek() == 'E') && is_digit(peek(exponent))) {
    real = true;
    at_ += exponent;
    while (is_digit(peek()))
      ++at_;
  }
  std::string_view digits = text_.substr(begin, at_ - begin);
  if (digits.front() == '+') digits.remove_prefix(1);
  token.kind = real ? TokenKind::kReal : TokenKind::kInteger;
  auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), token.number);
  if (status == std::errc::result_out_of_range) {
    token.kind = TokenKind::kError;
    token.text = fmt::format("the number {} is out of range", digits);
  } else if (is_letter(peek())) {
    while (is_letter(peek()) || is_digit(peek()))
      ++at_;
    token.kind = TokenKind::kError;
    token.text = fmt::format("'{}' is neither a number nor a request", text_.substr(begin, at_ - begin));
  }
}

void Lexer::read_string(Token& token) {
  token.kind = TokenKind::kString;
  ++at_;
  while (at_ < text_.size() && peek() != '"') {
    if (peek() == '\\') {
      ++at_;
      read_escape(token.text);
    } else {
      token.text += peek();
      advance();
    }
  }
  if (at_ < text_.size()) {
    ++at_;
    return;
  }
  token.kind = TokenKind::kError;
  token.text = "this string is not closed before the end of the file";
}

/// The part after a backslash. Octal codes take up to three digits; an unknown escape is the character
/// itself.
void Lexer::read_escape(std::string& out) {
  if (at_ >= text_.size()) return;
  char c = peek();
  if (is_octal(c)) {
    int code = 0;
    for (int i = 0; i < 3 && is_octal(peek()); ++i)
      code = code * 8 + (text_[at_++] - '0');
    out += static_cast<char>(code & 0xff);
    return;
  }
  if (c == '\r' && peek(1) == '\n') ++at_;
  advance();
  switch (c) {
  case 'n': out += '\n'; break;
  case 'r': out += '\r'; break;
  case 't': out += '\t'; break;
  case 'b': out += '\b'; break;
  case 'f': out += '\f'; break;
  case '\n':
  case '\r': break;
  default: out += c; break;
  }
}

void Lexer::read_garbage(Token& token) {
  token.kind = TokenKind::kError;
  auto byte = static_cast<unsigned char>(peek());
  bool plain = byte > 0x20 && byte < 0x7f;
  token.text = plain ? fmt::format("'{}' has no meaning in a RIB file", peek())
                     : fmt::format("byte 0x{:02x} has no meaning in a RIB file", byte);
  // One message for a whole run of such bytes.
  auto is_known = [](char c) {
    return is_encoded(c) || is_blank(c) || is_letter(c) || is_digit(c) || c == '[' || c == ']' || c == '"' ||
           c == '#' || c == '-' || c == '+' || c == '.';
  };
  ++at_;
  while (at_ < text_.size() && !is_known(peek()))
    ++at_;
}

} // namespace render
