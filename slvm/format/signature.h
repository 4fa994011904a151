// Signatures of shadeops as text ("float(float min, float max, float x)"), parsed at compile time, so that
// the table in shadeops.def stays readable and the types of an overload are written exactly once.
//
//   signature = [ "uniform" ] type "(" [ param { "," param } ] ")"
//   param     = { "uniform" | "output" | "inout" } ( type | "any" ) [ "[" [ number ] "]" ] name [ "..." ]
//             | "@" token_set                  optional token-value pairs, see tokens.def; always last
//
//   uniform   of a parameter: the argument must be uniform. Of the result: uniform whatever the arguments
//   are. output    the call stores there and does not read it;  inout  it reads and stores. Both need a
//   variable. any       a value of any type (printf arguments, message values).
//   ...       on the last parameter: one or more arguments of this kind.
//   []        an array of any length; [3]: of this length (functions of plug-ins).
#pragma once

#include "slvm/format/types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace slvm {

inline constexpr int kMaxParams = 12;
inline constexpr uint32_t kMaxElements = 1u << 20; ///< that a parameter may ask for

struct SignatureParam {
  Type type = Type::kVoid; // meaningless when `any`
  bool any = false;
  bool uniform = false;
  bool output = false; // also set for inout
  bool input = true;   // false for pure outputs
  bool array = false;
  bool variadic = false;
  uint32_t elements = 0; // of an array of fixed length; 0: of any
  std::string_view name;
};

struct Signature {
  Type result = Type::kVoid;
  bool uniform_result = false;
  int param_count = 0;
  std::array<SignatureParam, kMaxParams> params{};
  const SignatureParam* room = nullptr; // where the parameters are instead: those of plug-ins, any number
  std::string_view token_set;           // "" when the shadeop takes no token-value pairs
  bool ok = false;                      // false: the text does not follow the grammar above

  /// Fewest and most arguments before token-value pairs; most is -1 for "any number".
  constexpr int min_args() const { return param_count; }
  constexpr bool variadic() const { return param_count > 0 && param(param_count - 1).variadic; }
  constexpr const SignatureParam& param(int i) const {
    const SignatureParam* list = room ? room : params.data();
    return list[i < param_count ? i : param_count - 1]; // surplus arguments belong to the variadic one
  }
};

namespace detail {

struct SignatureParser {
  std::string_view text;
  size_t at = 0;

  constexpr void skip_blanks() {
    while (at < text.size() && text[at] == ' ')
      ++at;
  }
  constexpr bool take(char c) {
    skip_blanks();
    if (at < text.size() && text[at] == c) {
      ++at;
      return true;
    }
    return false;
  }
  constexpr std::string_view word() {
    skip_blanks();
    size_t begin = at;
    auto is_word = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    while (at < text.size() && is_word(text[at]))
      ++at;
    return text.substr(begin, at - begin);
  }
  static constexpr bool parse_type(std::string_view w, Type& out) {
    for (int i = 0; i < kTypeCount; ++i)
      if (type_name(static_cast<Type>(i)) == w) {
        out = static_cast<Type>(i);
        return true;
      }
    return false;
  }
  constexpr bool parse_param(SignatureParam& p) {
    std::string_view w = word();
    for (;; w = word()) {
      if (w == "uniform")
        p.uniform = true;
      else if (w == "output")
        p.output = true, p.input = false;
      else if (w == "inout")
        p.output = true;
      else
        break;
    }
    if (w == "any")
      p.any = true;
    else if (!parse_type(w, p.type) || p.type == Type::kVoid)
      return false;
    if (take('[')) {
      for (skip_blanks(); at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at)
        if ((p.elements = p.elements * 10 + static_cast<uint32_t>(text[at] - '0')) > kMaxElements)
          return false;
      if (!take(']')) return false;
      p.array = true;
    }
    p.name = word();
    if (p.name.empty()) return false;
    if (take('.')) {
      if (!take('.') || !take('.')) return false;
      p.variadic = true;
    }
    return true;
  }
  /// The parameters go to `params`, of which there are `most`.
  constexpr void parse(Signature& s, SignatureParam* params, int most) {
    std::string_view w = word();
    if (w == "uniform") {
      s.uniform_result = true;
      w = word();
    }
    if (!parse_type(w, s.result) || !take('(')) return;
    if (!take(')')) {
      do {
        if (!s.token_set.empty()) return; // token-value pairs come last
        if (take('@')) {
          s.token_set = word();
          if (s.token_set.empty()) return;
        } else {
          if (s.param_count == most || (s.param_count && params[s.param_count - 1].variadic)) return;
          if (!parse_param(params[s.param_count])) return;
          ++s.param_count;
        }
      } while (take(','));
      if (!take(')')) return;
    }
    skip_blanks();
    s.ok = at == text.size();
  }
};

} // namespace detail

constexpr Signature parse_signature(std::string_view text) {
  Signature s;
  detail::SignatureParser{text}.parse(s, s.params.data(), kMaxParams);
  return s;
}
/// The same with the parameters in `room`, which must live as long as the signature.
constexpr Signature parse_signature(std::string_view text, std::span<SignatureParam> room) {
  Signature s;
  detail::SignatureParser{text}.parse(s, room.data(), static_cast<int>(room.size()));
  s.room = room.data();
  return s;
}

} // namespace slvm
