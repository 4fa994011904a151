// Numbers and heads of encoded RIB.
#include "render/rib/encoding.h"

#include <algorithm>
#include <bit>

namespace render {

EncodedHead encoded_head(char first) {
  int c = static_cast<unsigned char>(first);
  if (c < 0x80) return {};
  if (c <= 0203) return {EncodedKind::kInteger, c - 0200 + 1, 0, 0};
  if (c <= 0217) return {EncodedKind::kFixed, (c & 3) + 1, (c - 0200) / 4, 0};
  if (c <= 0237) return {EncodedKind::kString, 0, 0, static_cast<size_t>(c - 0220)};
  if (c <= 0243) return {EncodedKind::kString, c - 0240 + 1, 0, 0};
  if (c == 0244) return {EncodedKind::kFloat, 4, 0, 0};
  if (c == 0245) return {EncodedKind::kDouble, 8, 0, 0};
  if (c == 0246) return {EncodedKind::kRequest, 1, 0, 0};
  if (c >= 0310 && c <= 0313) return {EncodedKind::kFloatArray, c - 0310 + 1, 0, 0};
  if (c == 0314) return {EncodedKind::kDefineRequest, 1, 0, 0};
  if (c == 0315 || c == 0316) return {EncodedKind::kDefineString, c - 0315 + 1, 0, 0};
  if (c == 0317 || c == 0320) return {EncodedKind::kUseString, c - 0317 + 1, 0, 0};
  if (c == 0377) return {EncodedKind::kEndOfStream, 0, 0, 0};
  return {};
}

uint64_t read_unsigned(std::string_view bytes) {
  uint64_t value = 0;
  for (char c : bytes)
    value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

int64_t read_signed(std::string_view bytes) {
  auto unused = static_cast<int>(64 - 8 * bytes.size());
  return static_cast<int64_t>(read_unsigned(bytes) << unused) >> unused;
}

double read_real(std::string_view bytes) {
  uint64_t bits = read_unsigned(bytes);
  return bytes.size() == 4 ? std::bit_cast<float>(static_cast<uint32_t>(bits)) : std::bit_cast<double>(bits);
}

size_t EndMarkFinder::find(std::string_view text) {
  while (at_ < text.size()) {
    char c = text[at_];
    if (inside_ == Inside::kString) {
      if (c == '\\') {
        if (at_ + 1 >= text.size()) return kNone;
        ++at_;
      } else if (c == '"') {
        inside_ = Inside::kNothing;
      }
      ++at_;
    } else if (inside_ == Inside::kComment) {
      if (c == '\n' || c == '\r') inside_ = Inside::kNothing;
      ++at_;
    } else if (is_encoded(c)) {
      if (encoded_head(c).kind == EncodedKind::kEndOfStream) return at_;
      saw_encoded_ = true;
      if (!skip_encoded(text)) return kNone;
    } else {
      if (c == '"') inside_ = Inside::kString;
      if (c == '#') inside_ = Inside::kComment;
      ++at_;
    }
  }
  return kNone;
}

/// False: the item is not complete yet.
bool EndMarkFinder::skip_encoded(std::string_view text) {
  EncodedHead head = encoded_head(text[at_]);
  size_t left = text.size() - at_ - 1;
  auto width = static_cast<size_t>(head.width);
  if (left < width) return false;
  size_t size = width + head.given;
  uint64_t number = width <= 4 ? read_unsigned(text.substr(at_ + 1, width)) : 0;
  if (head.kind == EncodedKind::kString) size += number;
  if (head.kind == EncodedKind::kFloatArray) size += 4 * number;
  if (left < size) return false;
  at_ += 1 + size;
  return true;
}

} // namespace render
