// The encoded half of the lexer. Every length is checked against what the file still holds, so that nothing
// is allocated on the word of a damaged file.
#include "render/rib/lexer.h"

#include <fmt/format.h>

#include <cmath>

namespace render {

/// Definitions are carried out on the way; the first real token after them is handed out.
void Lexer::read_encoded(Token& token) {
  while (read_encoded_item(token)) {
    skip_blanks();
    token.offset = at_;
    token.where = {file_, line_, column(), column()};
    if (at_ >= text_.size()) {
      token.kind = TokenKind::kEnd;
      return;
    }
    if (!is_encoded(peek())) {
      next(token);
      return;
    }
  }
}

/// True: it was a definition, and there is no token.
bool Lexer::read_encoded_item(Token& token) {
  token.encoded = true;
  EncodedHead head = encoded_head(text_[at_++]);
  std::string_view bytes;
  if (!take(static_cast<size_t>(head.width), bytes, token)) return false;
  switch (head.kind) {
  case EncodedKind::kInteger:
    token.kind = TokenKind::kInteger;
    token.number = static_cast<double>(read_signed(bytes));
    return false;
  case EncodedKind::kFixed:
    token.kind = TokenKind::kReal;
    token.number = std::ldexp(static_cast<double>(read_signed(bytes)), -8 * head.point);
    return false;
  case EncodedKind::kFloat:
  case EncodedKind::kDouble:
    token.kind = TokenKind::kReal;
    token.number = read_real(bytes);
    if (std::isnan(token.number)) {
      token.kind = TokenKind::kError;
      token.text = "this encoded float is not a number";
    }
    return false;
  case EncodedKind::kString:
    token.kind = TokenKind::kString;
    if (take(head.width > 0 ? read_unsigned(bytes) : head.given, bytes, token)) token.text = bytes;
    return false;
  case EncodedKind::kRequest: {
    uint64_t code = read_unsigned(bytes);
    token.kind = TokenKind::kWord;
    token.text = names_.requests[code];
    if (token.text.empty()) {
      token.kind = TokenKind::kError;
      token.text = fmt::format("the request code {} was not defined before", code);
    }
    return false;
  }
  case EncodedKind::kUseString: {
    auto it = names_.strings.find(static_cast<uint32_t>(read_unsigned(bytes)));
    token.kind = it == names_.strings.end() ? TokenKind::kError : TokenKind::kString;
    token.text = it == names_.strings.end()
                     ? fmt::format("the string number {} was not defined before", read_unsigned(bytes))
                     : it->second;
    return false;
  }
  case EncodedKind::kFloatArray:
    token.kind = TokenKind::kOpen;
    array_left_ = read_unsigned(bytes);
    in_array_ = true;
    if (array_left_ <= (text_.size() - at_) / 4) return false;
    in_array_ = false;
    token.kind = TokenKind::kError;
    token.text = fmt::format("an encoded array of {} floats reaches past the end of the file", array_left_);
    at_ = text_.size();
    return false;
  case EncodedKind::kDefineRequest:
  case EncodedKind::kDefineString: return read_definition(head, read_unsigned(bytes), token);
  case EncodedKind::kEndOfStream:
    token.kind = TokenKind::kEnd;
    ended_ = true;
    return false;
  case EncodedKind::kReserved: break;
  }
  token.kind = TokenKind::kError;
  token.text = fmt::format("byte 0x{:02x} has no meaning in a RIB file",
                           static_cast<unsigned char>(text_[token.offset]));
  return false;
}

/// The string that follows a code. True when it was one.
bool Lexer::read_definition(const EncodedHead& head, uint64_t code, Token& token) {
  bool request = head.kind == EncodedKind::kDefineRequest;
  skip_blanks();
  size_t begin = at_;
  if (peek() == '"') {
    read_string(token);
  } else if (is_encoded(peek()) && encoded_head(peek()).kind == EncodedKind::kString) {
    read_encoded_item(token);
  } else {
    token.kind = TokenKind::kError;
    token.text = fmt::format("expected a string for the encoded {} {} defined here",
                             request ? "request" : "string", code);
  }
  if (token.kind == TokenKind::kError) {
    if (at_ == begin && at_ < text_.size() && !is_encoded(peek())) ++at_;
    return false;
  }
  if (request)
    names_.requests[code] = token.text;
  else
    names_.strings[static_cast<uint32_t>(code)] = token.text;
  token.text.clear();
  return true;
}

/// The numbers of an encoded array, one token each, then its end.
void Lexer::read_array_element(Token& token) {
  token.encoded = true;
  if (array_left_ == 0) {
    in_array_ = false;
    token.kind = TokenKind::kClose;
    return;
  }
  --array_left_;
  token.kind = TokenKind::kReal;
  token.number = read_real(text_.substr(at_, 4));
  at_ += 4;
  if (std::isnan(token.number)) {
    token.kind = TokenKind::kError;
    token.text = "this encoded float is not a number";
  }
}

/// The next `count` bytes. False, with an error token: the file has fewer.
bool Lexer::take(size_t count, std::string_view& bytes, Token& token) {
  if (text_.size() - at_ < count) {
    token.kind = TokenKind::kError;
    token.text =
        fmt::format("an encoded item needs {} bytes more, the file has {}", count, text_.size() - at_);
    at_ = text_.size();
    return false;
  }
  bytes = text_.substr(at_, count);
  at_ += count;
  return true;
}

} // namespace render
