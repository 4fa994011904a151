// The binary encoding of RIB tokens: a byte from 128 on begins an encoded number, string, request or array;
// all others are ASCII. Formats: RISpec 3.2, appendix C.2. The lexer (lexer.h) mixes both freely.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace render {

/// What the first byte of an encoded item announces.
enum class EncodedKind : uint8_t {
  kInteger,
  kFixed, ///< integer / 256^point
  kString,
  kFloat,
  kDouble,
  kRequest,
  kFloatArray,
  kDefineRequest,
  kDefineString,
  kUseString,
  kEndOfStream,
  kReserved,
};

struct EncodedHead {
  EncodedKind kind = EncodedKind::kReserved;
  /// Bytes of the number that follows: the value itself, a length, a count or a code.
  int width = 0;
  int point = 0;    ///< kFixed: bytes behind the binary point
  size_t given = 0; ///< kString with width 0: its length
};

inline bool is_encoded(char c) {
  return static_cast<unsigned char>(c) >= 0x80;
}
EncodedHead encoded_head(char first);
/// Most significant byte first; at most 8 bytes.
uint64_t read_unsigned(std::string_view bytes);
int64_t read_signed(std::string_view bytes);
/// IEEE numbers of 4 or 8 bytes.
double read_real(std::string_view bytes);

/// Names of encoded requests and strings that a stream has defined so far.
struct EncodedNames {
  std::array<std::string, 256> requests;
  std::map<uint32_t, std::string> strings;
};

/// Walks over RIB text to find where it ends: at the mark 0377 that is neither in a string, nor in a comment,
/// nor inside an encoded item. May be fed a growing text.
class EndMarkFinder {
public:
  static constexpr size_t kNone = std::string_view::npos;
  /// `text` is what was fed before, and more. The position of the mark, or kNone.
  size_t find(std::string_view text);
  /// Whether an encoded token was passed.
  bool saw_encoded() const { return saw_encoded_; }

private:
  enum class Inside : uint8_t { kNothing, kString, kComment };
  bool skip_encoded(std::string_view text);

  size_t at_ = 0;
  Inside inside_ = Inside::kNothing;
  bool saw_encoded_ = false;
};

} // namespace render
