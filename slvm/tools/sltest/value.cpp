#include "slvm/tools/sltest/value.h"

#include <fmt/format.h>

#include <charconv>

namespace slvm::sltest {

std::string to_string(const Where& w) {
  if (w.file.empty()) return "command line";
  return w.line ? fmt::format("{}:{}", w.file, w.line) : w.file;
}

std::string type_text(Type type, uint32_t elements) {
  return elements ? fmt::format("{}[{}]", type_name(type), elements) : std::string(type_name(type));
}

std::string numbers_text(const std::vector<float>& numbers, int digits) {
  std::string text;
  for (float x : numbers)
    text += fmt::format("{}{:.{}g}", text.empty() ? "" : " ", x, digits);
  return text;
}

namespace {

std::vector<std::string_view> words(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> result;
  for (size_t at = text.find_first_not_of(separators); at != std::string_view::npos;) {
    size_t end = std::min(text.find_first_of(separators, at), text.size());
    result.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(separators, end);
  }
  return result;
}

bool parse_number(std::string_view word, float& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

bool parse_type(std::string_view word, Declaration& d) {
  if (size_t bracket = word.find('['); bracket != std::string_view::npos) {
    std::string_view length = word.substr(bracket + 1);
    auto [end, error] = std::from_chars(length.data(), length.data() + length.size(), d.elements);
    if (error != std::errc() || d.elements == 0 || end + 1 != length.data() + length.size() || *end != ']')
      return false;
    word = word.substr(0, bracket);
  }
  for (Type t :
       {Type::kFloat, Type::kColor, Type::kPoint, Type::kVector, Type::kNormal, Type::kMatrix, Type::kString})
    if (type_name(t) == word) d.type = t;
  return d.type.has_value();
}

} // namespace

Result<Declaration> parse_declaration(std::string_view text) {
  Declaration d;
  std::vector<std::string_view> parts = words(text, " \t");
  if (parts.empty()) return Error{"an empty name"};
  d.name = parts.back();
  parts.pop_back();
  for (std::string_view word : parts) {
    if (word == "uniform" || word == "constant")
      d.detail = Detail::kUniform;
    else if (word == "varying" || word == "vertex" || word == "facevarying")
      d.detail = Detail::kVarying;
    else if (!parse_type(word, d))
      return Error{fmt::format("'{}' in '{}' is neither a type nor uniform or varying", word, text)};
  }
  return d;
}

RawValue parse_raw(std::string_view text) {
  RawValue raw;
  raw.strings.emplace_back(text);
  std::string_view inside = text;
  if (inside.starts_with('[') && inside.ends_with(']')) inside = inside.substr(1, inside.size() - 2);
  for (std::string_view word : words(inside, " \t,")) {
    float number = 0;
    if (!parse_number(word, number)) {
      raw.numbers.clear();
      raw.list = false;
      return raw;
    }
    raw.numbers.push_back(number);
  }
  raw.list = raw.numbers.size() > 1;
  return raw;
}

Declaration inferred_type(const RawValue& raw, const Declaration& given) {
  Declaration d = given;
  if (d.type) return d;
  if (raw.numbers.empty())
    d.type = Type::kString;
  else if (raw.numbers.size() == 3)
    d.type = Type::kColor;
  else if (raw.numbers.size() == 16)
    d.type = Type::kMatrix;
  else
    d.type = Type::kFloat;
  size_t count = raw.numbers.empty() ? raw.strings.size() : raw.numbers.size();
  if (raw.list && (*d.type == Type::kFloat || *d.type == Type::kString))
    d.elements = static_cast<uint32_t>(count);
  return d;
}

Result<Value> to_value(const RawValue& raw, Type type, uint32_t elements) {
  Value value{type, elements, {}, {}};
  const size_t count = value.count();
  if (type == Type::kString) {
    if (raw.strings.size() != count)
      return Error{
          fmt::format("{} text{} wanted for {}", count, count == 1 ? "" : "s", type_text(type, elements))};
    value.strings = raw.strings;
    return value;
  }
  const size_t width = static_cast<size_t>(components(type)), wanted = width * count;
  if (raw.numbers.empty()) return Error{fmt::format("{} wanted, not a text", type_text(type, elements))};
  if (raw.numbers.size() == wanted)
    value.numbers = raw.numbers;
  else if (raw.numbers.size() == 1 && type == Type::kMatrix && !elements) {
    value.numbers.assign(16, 0);
    for (size_t i = 0; i < 16; i += 5)
      value.numbers[i] = raw.numbers[0];
  } else if (raw.numbers.size() == 1 && is_triple(type) && !elements)
    value.numbers.assign(3, raw.numbers[0]);
  else
    return Error{fmt::format("{} number{} given, {} wanted for {}", raw.numbers.size(),
                             raw.numbers.size() == 1 ? "" : "s", wanted, type_text(type, elements))};
  return value;
}

Result<std::vector<float>> to_planes(const RawValue& raw, Type type, size_t points) {
  const size_t width = static_cast<size_t>(components(type));
  const bool splat = width == 3 && raw.numbers.size() == points; // one float for each point
  if (!splat && raw.numbers.size() != points * width)
    return Error{fmt::format("{} numbers given, {} wanted: {} for each of {} points", raw.numbers.size(),
                             points * width, width, points)};
  std::vector<float> planes(points * width);
  for (size_t c = 0; c < width; ++c)
    for (size_t i = 0; i < points; ++i)
      planes[c * points + i] = raw.numbers[splat ? i : i * width + c];
  return planes;
}

} // namespace slvm::sltest
