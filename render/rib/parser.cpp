// The RIB parser. One loop over requests; parse_argument does the kinds of requests.def, parse_params the
// list after.
#include "render/rib/parser.h"

#include "render/rib/lexer.h"

#include <fmt/format.h>

#include <cmath>

namespace render {

namespace {

class Parser {
public:
  Parser(TokenStream& tokens, RiTarget& target, slvm::Diagnostics& diagnostics)
      : tokens_(tokens), target_(target), diagnostics_(diagnostics) {
    tokens_.keep_comments = target_.wants_comments();
    take();
  }
  void run();

private:
  void take() { tokens_.next(token_); }
  void hand_on_comments();
  void recover();
  bool fail(std::string text);
  bool fail_expected(std::string_view what);
  std::string found() const;
  std::string place() const;

  bool parse_request(const RequestInfo& info);
  bool parse_flat(const RequestInfo& info);
  bool parse_argument(const ArgumentInfo& info, Argument& out);
  bool starts(const ArgumentInfo& info) const;
  bool parse_float(const ArgumentInfo& info, std::vector<float>& out);
  bool parse_int(const ArgumentInfo& info, std::vector<int>& out);
  bool parse_string(const ArgumentInfo& info, std::vector<std::string>& out);
  bool parse_floats(const ArgumentInfo& info, std::vector<float>& out);
  template <class ParseOne> bool parse_array(const ArgumentInfo& info, bool bare_ok, ParseOne parse_one);
  bool parse_params();
  bool read_data();
  bool parse_value(Param& param);

  TokenStream& tokens_;
  RiTarget& target_;
  slvm::Diagnostics& diagnostics_;
  Token token_;
  RequestCall call_;
  const RequestInfo* info_ = nullptr;
};

void Parser::run() {
  while (hand_on_comments(), token_.kind != TokenKind::kEnd) {
    if (token_.kind != TokenKind::kWord) {
      if (token_.kind == TokenKind::kError)
        diagnostics_.error(token_.where, token_.text + place());
      else
        diagnostics_.error(token_.where, fmt::format("expected a request, found {}{}", found(), place()));
      take();
      recover();
      continue;
    }
    info_ = find_request(token_.text);
    call_.where = token_.where;
    if (!info_) {
      std::string name = token_.text;
      take();
      recover();
      target_.unknown_request(name, suggest_request(name), call_.where);
      continue;
    }
    take();
    if (parse_request(*info_) && read_data())
      target_.request(call_);
    else
      recover();
  }
}

void Parser::hand_on_comments() {
  for (const Comment& c : tokens_.comments)
    target_.comment(c.text, c.where);
  tokens_.comments.clear();
}

/// Skips to a request's name. Unknown words stop only outside of argument lists, where run() names them; a
/// word after an error is more likely a stray argument unless it is a known name.
void Parser::recover() {
  while (token_.kind != TokenKind::kEnd && !(token_.kind == TokenKind::kWord && find_request(token_.text)))
    take();
}

bool Parser::fail(std::string text) {
  diagnostics_.error(token_.where, fmt::format("{}: {}{}", info_->name, text, place()));
  return false;
}

bool Parser::fail_expected(std::string_view what) {
  if (token_.kind == TokenKind::kError) return fail(token_.text);
  return fail(fmt::format("expected {}, found {}", what, found()));
}

/// Where an encoded token is; of others the line says it.
std::string Parser::place() const {
  return token_.encoded ? fmt::format(" (byte {} of the file)", token_.offset) : "";
}

std::string Parser::found() const {
  switch (token_.kind) {
  case TokenKind::kEnd: return "the end of the file";
  case TokenKind::kWord:
    return find_request(token_.text) ? "the request " + token_.text : "'" + token_.text + "'";
  case TokenKind::kInteger:
  case TokenKind::kReal: return fmt::format("the number {}", token_.number);
  case TokenKind::kString: return fmt::format("\"{}\"", token_.text.substr(0, 40));
  case TokenKind::kOpen: return "'['";
  case TokenKind::kClose: return "']'";
  case TokenKind::kDash: return "'-'";
  case TokenKind::kError: return token_.text;
  }
  return "";
}

bool Parser::parse_request(const RequestInfo& info) {
  call_.id = info.id;
  call_.arguments.resize(info.arguments.size());
  for (Argument& a : call_.arguments)
    a.clear();
  call_.params.clear();
  // "Sphere [1 -1 1 360]": all arguments as one array. A single array argument is parse_floats' own.
  if (info.flat_count > 0 && info.arguments[0].kind != ArgumentKind::kFloats &&
      token_.kind == TokenKind::kOpen)
    return parse_flat(info) && parse_params();
  for (size_t i = 0; i < info.arguments.size(); ++i) {
    const ArgumentInfo& a = info.arguments[i];
    if (a.optional && !starts(a)) continue;
    if (!parse_argument(a, call_.arguments[i])) return false;
  }
  return parse_params();
}

bool Parser::parse_flat(const RequestInfo& info) {
  take();
  for (size_t i = 0; i < info.arguments.size(); ++i) {
    Argument& out = call_.arguments[i];
    const ArgumentInfo& a = info.arguments[i];
    out.where = token_.where;
    out.present = true;
    for (int k = 0; k < a.count; ++k)
      if (a.kind == ArgumentKind::kInt ? !parse_int(a, out.ints) : !parse_float(a, out.numbers)) return false;
  }
  if (token_.kind != TokenKind::kClose) return fail_expected("']'");
  take();
  return true;
}

/// Whether the next token can begin this (optional) argument.
bool Parser::starts(const ArgumentInfo& info) const {
  switch (info.kind) {
  case ArgumentKind::kFloat:
  case ArgumentKind::kInt: return token_.is_number();
  case ArgumentKind::kString: return token_.kind == TokenKind::kString;
  case ArgumentKind::kFloats:
  case ArgumentKind::kInts:
  case ArgumentKind::kStrings: return token_.kind == TokenKind::kOpen;
  case ArgumentKind::kHandle:
  case ArgumentKind::kBasis: return token_.is_number() || token_.kind == TokenKind::kString;
  case ArgumentKind::kDash: return token_.kind == TokenKind::kDash;
  }
  return false;
}

bool Parser::parse_argument(const ArgumentInfo& info, Argument& out) {
  out.where = token_.where;
  out.present = true;
  switch (info.kind) {
  case ArgumentKind::kFloat: return parse_float(info, out.numbers);
  case ArgumentKind::kInt: return parse_int(info, out.ints);
  case ArgumentKind::kString: return parse_string(info, out.strings);
  case ArgumentKind::kFloats: return parse_floats(info, out.numbers);
  case ArgumentKind::kInts: return parse_array(info, false, [&] { return parse_int(info, out.ints); });
  case ArgumentKind::kStrings:
    return parse_array(info, true, [&] { return parse_string(info, out.strings); });
  case ArgumentKind::kHandle:
    if (token_.kind == TokenKind::kInteger) {
      out.strings.push_back(fmt::format("{:.0f}", token_.number));
      take();
      return true;
    }
    if (token_.kind != TokenKind::kString)
      return fail_expected(fmt::format("an integer or a string for '{}'", info.name));
    return parse_string(info, out.strings);
  case ArgumentKind::kBasis:
    if (token_.kind == TokenKind::kString) return parse_string(info, out.strings);
    return parse_floats({ArgumentKind::kFloats, 16, false, info.name}, out.numbers);
  case ArgumentKind::kDash: take(); return true;
  }
  return false;
}

bool Parser::parse_float(const ArgumentInfo& info, std::vector<float>& out) {
  if (!token_.is_number()) return fail_expected(fmt::format("a number for '{}'", info.name));
  out.push_back(static_cast<float>(token_.number));
  take();
  return true;
}

bool Parser::parse_int(const ArgumentInfo& info, std::vector<int>& out) {
  if (!token_.is_number()) return fail_expected(fmt::format("an integer for '{}'", info.name));
  double value = token_.number;
  if (std::trunc(value) != value) return fail_expected(fmt::format("an integer for '{}'", info.name));
  if (std::abs(value) > 2147483647.0)
    return fail(fmt::format("{:g} is too large for the integer '{}'", value, info.name));
  // Once for a whole array.
  if (token_.kind == TokenKind::kReal && out.empty())
    diagnostics_.warning(
        token_.where, "rib-integer",
        fmt::format("{}: '{}' is an integer, written as a real number", info_->name, info.name));
  out.push_back(static_cast<int>(value));
  take();
  return true;
}

bool Parser::parse_string(const ArgumentInfo& info, std::vector<std::string>& out) {
  if (token_.kind != TokenKind::kString) return fail_expected(fmt::format("a string for '{}'", info.name));
  out.push_back(token_.text);
  take();
  return true;
}

/// Numbers in brackets, or bare: exactly `count` of them, or as many as there are when count is 0.
bool Parser::parse_floats(const ArgumentInfo& info, std::vector<float>& out) {
  slvm::SourceRange begin = token_.where;
  if (token_.kind == TokenKind::kOpen) {
    if (!parse_array(info, false, [&] { return parse_float(info, out); })) return false;
  } else if (info.count > 0) {
    for (int i = 0; i < info.count; ++i)
      if (!parse_float(info, out)) return false;
  } else {
    if (!token_.is_number()) return fail_expected(fmt::format("an array of numbers for '{}'", info.name));
    while (token_.is_number())
      parse_float(info, out);
  }
  if (info.count > 0 && static_cast<int>(out.size()) != info.count) {
    diagnostics_.error(begin, fmt::format("{}: '{}' takes {} numbers, found {}", info_->name, info.name,
                                          info.count, out.size()));
    return false;
  }
  return true;
}

template <class ParseOne>
bool Parser::parse_array(const ArgumentInfo& info, bool bare_ok, ParseOne parse_one) {
  if (token_.kind != TokenKind::kOpen) {
    if (bare_ok && token_.kind == TokenKind::kString) return parse_one();
    return fail_expected(fmt::format("'[' and an array for '{}'", info.name));
  }
  take();
  while (token_.kind != TokenKind::kClose)
    if (!parse_one()) return false;
  take();
  return true;
}

bool Parser::parse_params() {
  if (!info_->params) {
    if (token_.kind == TokenKind::kWord || token_.kind == TokenKind::kEnd) return true;
    return fail_expected("the next request");
  }
  while (token_.kind == TokenKind::kString) {
    Param& param = call_.params.emplace_back();
    param.token = token_.text;
    param.where = token_.where;
    take();
    if (!parse_value(param)) return false;
  }
  if (token_.kind == TokenKind::kWord || token_.kind == TokenKind::kEnd || call_.holds_data()) return true;
  // A missing argument shifts the rest: Display "a.tif" "rgba" "compression" ["lzw"] has no type.
  if (token_.kind == TokenKind::kOpen && call_.params.empty() && !info_->arguments.empty() &&
      info_->arguments.back().kind == ArgumentKind::kString && call_.arguments.back().present)
    return fail(
        fmt::format("found '[' after \"{}\", which was taken for '{}'; an argument is missing before it",
                    call_.arguments.back().strings[0], info_->arguments.back().name));
  return fail_expected("a token string or the next request");
}

bool Parser::read_data() {
  call_.data.clear();
  if (!call_.holds_data()) return true;
  bool complete = tokens_.read_data(call_.text(0), call_.data);
  take();
  return complete ||
         fail(fmt::format("the data has no end; expected a line ArchiveEnd \"{}\"", call_.text(0)));
}

bool Parser::parse_value(Param& param) {
  auto take_one = [&] {
    if (token_.kind == TokenKind::kString) {
      param.strings.push_back(token_.text);
    } else {
      param.numbers.push_back(static_cast<float>(token_.number));
      param.integers = param.integers && token_.kind == TokenKind::kInteger;
    }
    take();
  };
  auto is_value = [&] { return token_.is_number() || token_.kind == TokenKind::kString; };
  if (is_value()) {
    take_one();
    return true;
  }
  if (token_.kind != TokenKind::kOpen) return fail_expected(fmt::format("a value for \"{}\"", param.token));
  take();
  while (is_value())
    take_one();
  if (token_.kind != TokenKind::kClose)
    return fail_expected(fmt::format("a value of \"{}\" or ']'", param.token));
  if (!param.numbers.empty() && !param.strings.empty())
    return fail(fmt::format("the value of \"{}\" mixes numbers and strings", param.token));
  take();
  return true;
}

} // namespace

void parse_rib(TokenStream& tokens, RiTarget& target, slvm::Diagnostics& diagnostics) {
  Parser(tokens, target, diagnostics).run();
}

void parse_rib(std::string_view text, slvm::FileId file, RiTarget& target, slvm::Diagnostics& diagnostics) {
  Lexer lexer(text, file);
  parse_rib(lexer, target, diagnostics);
}

} // namespace render
