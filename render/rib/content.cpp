// Base64 and quoted-printable.
#include "render/rib/content.h"

#include <fmt/format.h>

namespace render {

namespace {

int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

slvm::Result<std::string> decode_base64(std::string_view data) {
  std::string out;
  uint32_t bits = 0;
  int count = 0;
  for (char c : data) {
    if (c == '=') break;
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    int value = base64_value(c);
    if (value < 0) return slvm::Error{fmt::format("'{}' is no digit of base64", c)};
    bits = bits << 6 | static_cast<uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out += static_cast<char>(bits >> count & 0xff);
    }
  }
  return out;
}

slvm::Result<std::string> decode_quoted_printable(std::string_view data) {
  std::string out;
  for (size_t i = 0; i < data.size(); ++i) {
    if (data[i] != '=') {
      out += data[i];
      continue;
    }
    std::string_view rest = data.substr(i + 1);
    if (rest.starts_with("\r\n")) {
      i += 2;
    } else if (rest.empty() || rest[0] == '\n') {
      i += 1;
    } else if (rest.size() >= 2 && hex_value(rest[0]) >= 0 && hex_value(rest[1]) >= 0) {
      out += static_cast<char>(16 * hex_value(rest[0]) + hex_value(rest[1]));
      i += 2;
    } else {
      return slvm::Error{fmt::format("expected two hexadecimal digits or a line end after '=', found \"{}\"",
                                     rest.substr(0, 2))};
    }
  }
  return out;
}

} // namespace

slvm::Result<std::string> decode_content(std::string_view encoding, std::string_view data) {
  if (encoding == "base64") return decode_base64(data);
  if (encoding == "quoted-printable") return decode_quoted_printable(data);
  if (encoding.empty() || encoding == "7bit" || encoding == "8bit" || encoding == "binary")
    return std::string(data);
  return slvm::Error{fmt::format("unknown encoding \"{}\"; known are quoted-printable, base64", encoding)};
}

} // namespace render
