// Spelling of tokens.
#include "render/rib/write_tokens.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace render {

namespace {

/// Bytes of a number, most significant first.
void append_bytes(std::string& out, uint64_t value, int count) {
  for (int i = count - 1; i >= 0; --i)
    out += static_cast<char>((value >> (8 * i)) & 0xff);
}

int bytes_of(uint64_t value) {
  int n = 1;
  while (n < 4 && (value >> (8 * n)) != 0)
    ++n;
  return n;
}

/// First byte, then a length or count in as few bytes as hold it.
void append_head(std::string& out, int first, uint64_t count) {
  int n = bytes_of(count);
  out += static_cast<char>(first + n - 1);
  append_bytes(out, count, n);
}

/// Readers take the nearest double first; rounding twice can end at a neighbour.
bool reads_back(std::string_view text, float value) {
  double read = 0;
  std::from_chars(text.data(), text.data() + text.size(), read);
  return static_cast<float>(read) == value;
}

} // namespace

void append_real(std::string& out, float value, int precision) {
  if (std::isnan(value)) value = 0;
  if (std::isinf(value)) {
    out += value < 0 ? "-1e39" : "1e39";
    return;
  }
  size_t begin = out.size();
  if (precision > 0)
    fmt::format_to(std::back_inserter(out), "{:.{}g}", value, precision);
  else
    fmt::format_to(std::back_inserter(out), "{}", value);
  if (precision == 0 && !reads_back(std::string_view(out).substr(begin), value)) {
    out.resize(begin);
    constexpr int kExact = 17;
    fmt::format_to(std::back_inserter(out), "{:.{}g}", static_cast<double>(value), kExact);
  }
  if (std::string_view(out).substr(begin).find_first_of(".e") == std::string_view::npos) out += ".0";
}

void append_whole(std::string& out, float value) {
  fmt::format_to(std::back_inserter(out), "{:.0f}", value);
}

void append_string(std::string& out, std::string_view text) {
  out += '"';
  for (char c : text) {
    auto byte = static_cast<unsigned char>(c);
    switch (c) {
    case '"': out += "\\\""; break;
    case '\\': out += "\\\\"; break;
    case '\n': out += "\\n"; break;
    case '\r': out += "\\r"; break;
    case '\t': out += "\\t"; break;
    case '\b': out += "\\b"; break;
    case '\f': out += "\\f"; break;
    default:
      if (byte < 0x20 || byte >= 0x7f) // three digits: a digit may follow
        fmt::format_to(std::back_inserter(out), "\\{:03o}", byte);
      else
        out += c;
    }
  }
  out += '"';
}

void append_encoded_real(std::string& out, float value) {
  out += '\244';
  append_bytes(out, std::bit_cast<uint32_t>(std::isnan(value) ? 0.0f : value), 4);
}

void append_encoded_integer(std::string& out, int value) {
  int width = 1;
  while (width < 4 && (value < -(1 << (8 * width - 1)) || value >= 1 << (8 * width - 1)))
    ++width;
  out += static_cast<char>(0200 + width - 1);
  append_bytes(out, static_cast<uint32_t>(value), width);
}

void append_encoded_string(std::string& out, std::string_view text) {
  constexpr size_t kShort = 16;
  if (text.size() < kShort)
    out += static_cast<char>(0220 + static_cast<int>(text.size()));
  else
    append_head(out, 0240, text.size());
  out += text;
}

void append_encoded_reals(std::string& out, std::span<const float> values) {
  append_head(out, 0310, values.size());
  for (float v : values)
    append_bytes(out, std::bit_cast<uint32_t>(std::isnan(v) ? 0.0f : v), 4);
}

void append_request_definition(std::string& out, unsigned char code, std::string_view name) {
  out += '\314';
  out += static_cast<char>(code);
  append_encoded_string(out, name);
}

void append_encoded_request(std::string& out, unsigned char code) {
  out += '\246';
  out += static_cast<char>(code);
}

} // namespace render
