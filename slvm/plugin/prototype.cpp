#include "slvm/plugin/prototype.h"

#include <fmt/format.h>

namespace slvm {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
}

class PrototypeParser {
public:
  explicit PrototypeParser(std::string_view text) : text_(text) {}

  Result<Prototype> parse() {
    Prototype p;
    if (!result(p) || !params(p)) return Error{error_};
    take(';');
    blanks();
    if (at_ != text_.size()) return Error{fmt::format("'{}' follows the prototype", rest())};
    return p;
  }

private:
  bool fail(std::string text) {
    error_ = std::move(text);
    return false;
  }
  std::string rest() const {
    std::string shown(text_.substr(at_, 20));
    for (char& c : shown)
      if (c < ' ' || c > '~') c = '?';
    return shown;
  }
  std::string found() {
    blanks();
    return at_ == text_.size() ? "it ends" : fmt::format("'{}' stands", rest());
  }

  void blanks() {
    while (at_ < text_.size() && is_blank(text_[at_]))
      ++at_;
  }
  bool take(char c) {
    blanks();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  std::string_view word() {
    blanks();
    const size_t begin = at_;
    while (at_ < text_.size() && is_word(text_[at_]))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  bool type(std::string_view name, Type& out) {
    for (int i = 0; i < kTypeCount; ++i)
      if (const auto t = static_cast<Type>(i); t != Type::kBool && type_name(t) == name) {
        out = t;
        return true;
      }
    if (name.empty()) return fail(fmt::format("a type is missing where {}", found()));
    return fail(fmt::format("'{}' is no type of the shading language", name.substr(0, 40)));
  }

  bool result(Prototype& p) {
    std::string_view w = word();
    for (; w == "uniform" || w == "varying"; w = word())
      (w == "uniform" ? p.uniform_result : p.varying_result) = true;
    if (!type(w, p.result)) return false;
    if (PrototypeParam array{.type = p.result, .uniform = p.uniform_result, .output = true, .name = "result"};
        !length(array)) {
      return false;
    } else if (array.array) {
      if (p.result == Type::kVoid) return fail("it returns an array of nothing");
      p.array_result = true;
      p.params.push_back(std::move(array));
      p.result = Type::kVoid;
      p.uniform_result = false;
    }
    p.name = word();
    if (p.name.empty() || is_digit(p.name[0]))
      return fail(fmt::format("a name is missing where {}", found()));
    if (p.uniform_result && p.varying_result) return fail("its result is both uniform and varying");
    return true;
  }

  bool params(Prototype& p) {
    if (!take('(')) return fail(fmt::format("a '(' is missing where {}", found()));
    if (take(')')) return true;
    if (const size_t before = at_; word() == "void" && take(')'))
      return true;
    else
      at_ = before;
    do {
      if (p.params.size() == kMaxPluginParams)
        return fail(fmt::format("it has more than {} parameters", kMaxPluginParams));
      if (!param(p.params.emplace_back())) return false;
    } while (take(','));
    return take(')') || fail(fmt::format("a ',' or ')' is missing where {}", found()));
  }

  bool param(PrototypeParam& p) {
    if (take('.'))
      return fail("it takes any number of arguments ('...'), which calls from shaders cannot give it");
    std::string_view w = word();
    for (; w == "uniform" || w == "varying" || w == "output"; w = word()) {
      p.uniform |= w == "uniform";
      p.output |= w == "output";
    }
    if (!type(w, p.type)) return false;
    if (p.type == Type::kVoid) return fail("a parameter is void");
    if (!length(p)) return false;
    p.name = word();
    return (p.name.empty() || !p.array) && !p.name.empty() ? length(p) : true;
  }

  bool length(PrototypeParam& p) {
    if (!take('[')) return true;
    p.array = true;
    for (blanks(); at_ < text_.size() && is_digit(text_[at_]); ++at_)
      if ((p.elements = p.elements * 10 + static_cast<uint32_t>(text_[at_] - '0')) > kMaxElements)
        return fail(fmt::format("an array has more than {} elements", kMaxElements));
    return take(']') || fail(fmt::format("a ']' is missing where {}", found()));
  }

  std::string_view text_;
  size_t at_ = 0;
  std::string error_;
};

} // namespace

std::string Prototype::signature() const {
  std::string text = uniform_result ? "uniform " : varying_result ? "varying " : "";
  (text += type_name(result)) += '(';
  for (size_t i = 0; i < params.size(); ++i) {
    const PrototypeParam& p = params[i];
    if (i) text += ", ";
    if (p.output) text += "inout ";
    if (p.uniform) text += "uniform ";
    text += type_name(p.type);
    if (p.array) text += p.elements ? fmt::format("[{}]", p.elements) : "[]";
    text += ' ';
    text += p.name.empty() ? fmt::format("a{}", i + 1) : p.name;
  }
  return text + ')';
}

Result<Prototype> parse_prototype(std::string_view text) {
  if (text.size() > kMaxPrototype)
    return Error{fmt::format("it is longer than {} characters", kMaxPrototype)};
  return PrototypeParser(text).parse();
}

} // namespace slvm
