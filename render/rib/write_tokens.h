// The tokens of RIB as bytes, in ASCII and in the binary encoding (RISpec 3.2, appendix C.2): what lexer.h
// reads. Numbers come back from either as they were.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace render {

/// The shortest decimal number that reads back as `value`, with a point or an exponent where it would look
/// like an integer. `precision` > 0: that many significant digits instead. Infinity is written as 1e39, which
/// reads back as infinity; NaN, which no text stands for, as 0.
void append_real(std::string& out, float value, int precision = 0);
/// The number without point and exponent. `value` has no fraction.
void append_whole(std::string& out, float value);
/// In quotes, with escapes.
void append_string(std::string& out, std::string_view text);

/// 0244 and four bytes.
void append_encoded_real(std::string& out, float value);
/// 0200 to 0203 and as few bytes as hold it.
void append_encoded_integer(std::string& out, int value);
/// 0220 to 0243, the length, the characters.
void append_encoded_string(std::string& out, std::string_view text);
/// 0310 to 0313, the count, four bytes each.
void append_encoded_reals(std::string& out, std::span<const float> values);
/// 0314: from here on 0246 `code` is the request of this name.
void append_request_definition(std::string& out, unsigned char code, std::string_view name);
/// 0246 and a code that was defined.
void append_encoded_request(std::string& out, unsigned char code);

} // namespace render
