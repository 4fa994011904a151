// A recursive-descent evaluator: each function of Evaluator reads one level of the grammar and returns its
// value.
#include "render/state/condition.h"

#include "render/state/state_values.h"

#include <fmt/format.h>
#include <regex.h>

#include <charconv>
#include <variant>

namespace render {

namespace {

/// A number or a string.
using Scalar = std::variant<double, std::string>;

bool truth(const Scalar& s) {
  return s.index() == 0 ? std::get<0>(s) != 0 : !std::get<1>(s).empty();
}
std::string as_text(const Scalar& s) {
  return s.index() == 0 ? fmt::format("{:g}", std::get<0>(s)) : std::get<1>(s);
}
/// The number a string spells, or nothing.
std::optional<double> as_number(const Scalar& s) {
  if (s.index() == 0) return std::get<0>(s);
  const std::string& t = std::get<1>(s);
  double value = 0;
  auto [end, status] = std::from_chars(t.data(), t.data() + t.size(), value);
  if (status != std::errc() || end != t.data() + t.size()) return {};
  return value;
}

bool is_name_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == ':';
}

/// Length of the variable name at the start of the text; a colon at its end belongs to what follows.
size_t name_length(std::string_view text) {
  size_t n = 0;
  while (n < text.size() && is_name_char(text[n]))
    ++n;
  while (n > 0 && text[n - 1] == ':')
    --n;
  return n;
}

constexpr int kDeepest = 64;
constexpr size_t kLongestPattern = 256;

class Evaluator {
public:
  Evaluator(std::string_view text, const StateLookup& lookup) : text_(text), lookup_(lookup) {}

  slvm::Result<bool> run() {
    Scalar value = any();
    skip_blanks();
    if (error_.empty() && at_ < text_.size())
      fail(fmt::format("expected an operator, found '{}'", text_[at_]));
    if (!error_.empty()) return slvm::Error{error_};
    return truth(value);
  }

private:
  Scalar any();
  Scalar all();
  Scalar equality();
  Scalar order();
  Scalar sum();
  Scalar product();
  Scalar unary();
  Scalar primary();
  Scalar variable();
  Scalar value_of(const std::string& name);
  Scalar word();
  Scalar call(std::string_view function);
  Scalar quoted();
  Scalar matches(const Scalar& text, const Scalar& pattern);

  void skip_blanks() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
  }
  bool accept(std::string_view symbol) {
    skip_blanks();
    if (!error_.empty() || !text_.substr(at_).starts_with(symbol)) return false;
    at_ += symbol.size();
    return true;
  }
  void expect(std::string_view symbol) {
    if (error_.empty() && !accept(symbol)) fail(fmt::format("expected '{}', found {}", symbol, found()));
  }
  std::string found() const {
    return at_ < text_.size() ? fmt::format("'{}'", text_[at_]) : "the end of the expression";
  }
  Scalar fail(std::string text) {
    if (error_.empty()) error_ = fmt::format("{} (column {} of \"{}\")", text, at_ + 1, text_);
    return 0.0;
  }
  double number(const Scalar& s) {
    if (auto n = as_number(s)) return *n;
    fail(fmt::format("'{}' is not a number", as_text(s)));
    return 0;
  }

  std::string_view text_;
  const StateLookup& lookup_;
  size_t at_ = 0;
  int depth_ = 0;
  bool skipped_ = false; ///< in the part of && or || that does not count: its variables need not exist
  std::string error_;
};

Scalar Evaluator::any() {
  if (++depth_ > kDeepest) return fail(fmt::format("parentheses are nested more than {} deep", kDeepest));
  Scalar left = all();
  while (accept("||")) {
    bool outer = skipped_;
    skipped_ = outer || truth(left);
    Scalar right = all();
    skipped_ = outer;
    left = truth(left) || truth(right) ? 1.0 : 0.0;
  }
  --depth_;
  return left;
}

Scalar Evaluator::all() {
  Scalar left = equality();
  while (accept("&&")) {
    bool outer = skipped_;
    skipped_ = outer || !truth(left);
    Scalar right = equality();
    skipped_ = outer;
    left = truth(left) && truth(right) ? 1.0 : 0.0;
  }
  return left;
}

/// Numbers are compared as numbers, also when one of them is written as a string.
Scalar Evaluator::equality() {
  Scalar left = order();
  for (;;) {
    bool equal = accept("=="), differ = !equal && accept("!="), match = !equal && !differ && accept("=~");
    if (!equal && !differ && !match) return left;
    Scalar right = order();
    if (match) {
      left = matches(left, right);
      continue;
    }
    bool text = left.index() == 1 && right.index() == 1;
    auto a = as_number(left), b = as_number(right);
    bool same = !text && a && b ? *a == *b : as_text(left) == as_text(right);
    left = same == equal ? 1.0 : 0.0;
  }
}

Scalar Evaluator::order() {
  Scalar left = sum();
  for (;;) {
    // The longer symbols first.
    int which = accept("<=") ? 0 : accept(">=") ? 1 : accept("<") ? 2 : accept(">") ? 3 : 4;
    if (which == 4) return left;
    double b = number(sum()), a = number(left);
    bool holds[] = {a <= b, a >= b, a<b, a> b};
    left = holds[which] ? 1.0 : 0.0;
  }
}

Scalar Evaluator::sum() {
  Scalar left = product();
  for (;;) {
    if (accept("+"))
      left = number(left) + number(product());
    else if (accept("-"))
      left = number(left) - number(product());
    else
      return left;
  }
}

Scalar Evaluator::product() {
  Scalar left = unary();
  for (;;) {
    if (accept("*")) {
      left = number(left) * number(unary());
    } else if (accept("/")) {
      double b = number(unary());
      if (b == 0 && !skipped_) return fail("division by zero");
      left = number(left) / b;
    } else {
      return left;
    }
  }
}

Scalar Evaluator::unary() {
  // A loop: a long row of signs must not use up the stack.
  std::string signs;
  for (;;) {
    skip_blanks();
    if (!text_.substr(at_).starts_with("!=") && accept("!"))
      signs += '!';
    else if (accept("-"))
      signs += '-';
    else
      break;
  }
  Scalar value = primary();
  for (size_t i = signs.size(); i-- > 0;)
    value = signs[i] == '!' ? (truth(value) ? 0.0 : 1.0) : -number(value);
  return value;
}

Scalar Evaluator::primary() {
  skip_blanks();
  if (!error_.empty()) return 0.0;
  char c = at_ < text_.size() ? text_[at_] : '\0';
  if (accept("(")) {
    Scalar value = any();
    expect(")");
    return value;
  }
  if (c == '\'' || c == '"') return quoted();
  if (c == '$') return variable();
  if ((c >= '0' && c <= '9') || c == '.') {
    double value = 0;
    auto [end, status] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (status != std::errc()) return fail("this is not a number");
    at_ = static_cast<size_t>(end - text_.data());
    return value;
  }
  if (is_name_char(c)) return word();
  return fail(fmt::format("expected a value, found {}", found()));
}

Scalar Evaluator::quoted() {
  size_t end = text_.find(text_[at_], at_ + 1);
  if (end == std::string_view::npos) return fail("this string is not closed");
  std::string value(text_.substr(at_ + 1, end - at_ - 1));
  at_ = end + 1;
  return value;
}

/// After the dollar: name, {name} or (expression).
Scalar Evaluator::variable() {
  ++at_;
  if (accept("(")) {
    std::string name = as_text(any());
    expect(")");
    return value_of(name);
  }
  bool braces = accept("{");
  size_t length = name_length(text_.substr(at_));
  if (length == 0) return fail("expected the name of a variable after '$'");
  std::string name(text_.substr(at_, length));
  at_ += length;
  if (braces) expect("}");
  return value_of(name);
}

Scalar Evaluator::value_of(const std::string& name) {
  if (skipped_ || !error_.empty()) return 0.0;
  auto value = lookup_(name);
  if (!value) return fail(fmt::format("there is no variable \"{}\"", name));
  if (value->type == slvm::Type::kFloat && value->numbers.size() == 1)
    return static_cast<double>(value->numbers[0]);
  return text_of(*value);
}

/// A bare word, or a function.
Scalar Evaluator::word() {
  size_t begin = at_;
  while (at_ < text_.size() && (is_name_char(text_[at_]) || text_[at_] == '.'))
    ++at_;
  std::string_view name = text_.substr(begin, at_ - begin);
  if (accept("(")) return call(name);
  return std::string(name);
}

Scalar Evaluator::call(std::string_view function) {
  std::vector<Scalar> arguments;
  // The name of a variable, with its dollar or without.
  bool by_name = function == "defined";
  if (by_name) accept("$");
  if (!accept(")")) {
    do
      arguments.push_back(any());
    while (accept(","));
    expect(")");
  }
  if (!error_.empty()) return 0.0;
  if (by_name && arguments.size() == 1) return lookup_(as_text(arguments[0])) ? 1.0 : 0.0;
  if (function == "matches" && arguments.size() == 2) return matches(arguments[0], arguments[1]);
  if (function == "concat") {
    std::string out;
    for (const Scalar& a : arguments)
      out += as_text(a);
    return out;
  }
  if (by_name) return fail("defined takes the name of a variable");
  if (function == "matches") return fail("matches takes a text and a pattern");
  return fail(fmt::format("unknown function {}; known are defined, concat, matches", function));
}

/// Back references and counted repetitions are left out: they let a short pattern run for hours.
Scalar Evaluator::matches(const Scalar& text, const Scalar& pattern) {
  std::string p = as_text(pattern), t = as_text(text);
  if (!error_.empty()) return 0.0;
  if (p.size() > kLongestPattern)
    return fail(fmt::format("the pattern is longer than {} characters", kLongestPattern));
  for (size_t i = 0; i + 1 < p.size(); ++i)
    if (p[i] == '\\' && p[i + 1] >= '0' && p[i + 1] <= '9') return fail("patterns take no back references");
  if (p.find('{') != std::string::npos) return fail("patterns take no counts in braces");
  regex_t compiled;
  int status = ::regcomp(&compiled, p.c_str(), REG_EXTENDED | REG_NOSUB);
  if (status != 0) {
    char why[256];
    ::regerror(status, &compiled, why, sizeof why);
    return fail(fmt::format("'{}' is not a pattern: {}", p, why));
  }
  bool found = ::regexec(&compiled, t.c_str(), 0, nullptr, 0) == 0;
  ::regfree(&compiled);
  return found ? 1.0 : 0.0;
}

} // namespace

slvm::Result<bool> evaluate_condition(std::string_view expression, const StateLookup& lookup) {
  return Evaluator(expression, lookup).run();
}

Substituted substitute_variables(std::string_view text, std::string_view marks, const StateLookup& lookup) {
  Substituted out;
  for (size_t i = 0; i < text.size();) {
    char c = text[i];
    if (marks.find(c) == std::string_view::npos) {
      out.text += c;
      ++i;
      continue;
    }
    std::string_view rest = text.substr(i + 1);
    if (rest.starts_with(c)) {
      out.text += c;
      i += 2;
      continue;
    }
    bool braces = rest.starts_with('{');
    if (braces) rest.remove_prefix(1);
    size_t length = name_length(rest);
    bool complete = length > 0 && (!braces || (length < rest.size() && rest[length] == '}'));
    if (!complete) {
      out.text += c;
      ++i;
      continue;
    }
    size_t whole = 1 + length + (braces ? 2 : 0);
    if (auto value = lookup(rest.substr(0, length))) {
      out.text += text_of(*value);
    } else {
      if (out.unknown.empty()) out.unknown = rest.substr(0, length);
      out.text += text.substr(i, whole);
    }
    i += whole;
  }
  return out;
}

} // namespace render
