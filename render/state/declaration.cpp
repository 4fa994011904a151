// Declarations: parsing of "[class] [type] [[n]] [name]" and the predeclared names of RISpec 3.2, table 5.1.
#include "render/state/declaration.h"

#include "slvm/support/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace render {

namespace {

struct Predeclared {
  std::string_view name, text;
};

constexpr Predeclared kPredeclared[] = {
    // primitive variables
    {"P", "vertex point"},
    {"Pz", "vertex float"},
    {"Pw", "vertex hpoint"},
    {"N", "varying normal"},
    {"Np", "uniform normal"},
    {"Ng", "varying normal"},
    {"Cs", "varying color"},
    {"Os", "varying color"},
    {"s", "varying float"},
    {"t", "varying float"},
    {"st", "varying float[2]"},
    {"width", "varying float"},
    {"constantwidth", "constant float"},
    // parameters of the standard shaders
    {"Ka", "uniform float"},
    {"Kd", "uniform float"},
    {"Ks", "uniform float"},
    {"Kr", "uniform float"},
    {"Km", "uniform float"},
    {"roughness", "uniform float"},
    {"intensity", "uniform float"},
    {"coneangle", "uniform float"},
    {"conedeltaangle", "uniform float"},
    {"beamdistribution", "uniform float"},
    {"mindistance", "uniform float"},
    {"maxdistance", "uniform float"},
    {"distance", "uniform float"},
    {"amplitude", "uniform float"},
    {"falloff", "uniform float"},
    {"texturename", "uniform string"},
    {"specularcolor", "uniform color"},
    {"lightcolor", "uniform color"},
    {"background", "uniform color"},
    {"bgcolor", "uniform color"},
    {"from", "uniform point"},
    {"to", "uniform point"},
    {"fov", "uniform float"},
};

std::optional<StorageClass> storage_class(std::string_view word) {
  if (word == "constant") return StorageClass::kConstant;
  if (word == "uniform") return StorageClass::kUniform;
  if (word == "varying") return StorageClass::kVarying;
  if (word == "vertex") return StorageClass::kVertex;
  if (word == "facevarying" || word == "facevertex") return StorageClass::kFaceVarying;
  return {};
}

bool set_type(std::string_view word, Declaration& d) {
  using slvm::Type;
  if (word == "float") {
    d.type = Type::kFloat;
  } else if (word == "integer" || word == "int") {
    d.type = Type::kFloat;
    d.integer = true;
  } else if (word == "hpoint") {
    d.type = Type::kPoint;
    d.hpoint = true;
  } else if (word == "mpoint") {
    d.type = Type::kPoint;
    d.mpoint = true;
  } else {
    for (Type t : {Type::kString, Type::kColor, Type::kPoint, Type::kVector, Type::kNormal, Type::kMatrix})
      if (slvm::type_name(t) == word) {
        d.type = t;
        return true;
      }
    return false;
  }
  return true;
}

/// Words, and brackets as words of their own, of a declaration.
std::vector<std::string_view> split_words(std::string_view text) {
  std::vector<std::string_view> words;
  auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  for (size_t i = 0; i < text.size();) {
    if (is_blank(text[i])) {
      ++i;
      continue;
    }
    size_t begin = i++;
    if (text[begin] != '[' && text[begin] != ']')
      while (i < text.size() && !is_blank(text[i]) && text[i] != '[' && text[i] != ']')
        ++i;
    words.push_back(text.substr(begin, i - begin));
  }
  return words;
}

constexpr uint32_t kMaxArrayLength = 1u << 20;

/// "[n]", if it is there.
std::optional<slvm::Error> parse_length(const std::vector<std::string_view>& words, size_t& at,
                                        Declaration& d) {
  if (at + 2 >= words.size() || words[at] != "[") return {};
  std::string_view n = words[at + 1];
  auto [end, status] = std::from_chars(n.data(), n.data() + n.size(), d.elements);
  bool ok = status == std::errc() && end == n.data() + n.size() && words[at + 2] == "]" && d.elements > 0 &&
            d.elements <= kMaxArrayLength;
  if (!ok) return slvm::Error{fmt::format("'{}' is not an array length", n)};
  at += 3;
  return {};
}

/// "[class] [type] [[n]]" from `words`, leaving `at` after it.
std::optional<slvm::Error> parse_declaration(const std::vector<std::string_view>& words, size_t& at,
                                             Declaration& d) {
  if (at < words.size())
    if (auto storage = storage_class(words[at])) {
      d.storage = *storage;
      ++at;
    }
  if (at < words.size() && set_type(words[at], d)) ++at;
  return parse_length(words, at, d);
}

} // namespace

std::string_view storage_class_name(StorageClass c) {
  constexpr std::string_view kNames[] = {"constant", "uniform", "varying", "vertex", "facevarying"};
  return kNames[static_cast<size_t>(c)];
}

Declarations::Declarations() {
  for (const Predeclared& p : kPredeclared)
    (void)declare(p.name, p.text);
}

slvm::Result<Declaration> Declarations::declare(std::string_view name, std::string_view text) {
  std::vector<std::string_view> words = split_words(text);
  Declaration d;
  d.name = name;
  size_t at = 0;
  if (auto error = parse_declaration(words, at, d)) return *error;
  if (at != words.size() || words.empty())
    return slvm::Error{fmt::format("\"{}\" is not a declaration; expected \"[class] type\", such as "
                                   "\"varying color\" or \"uniform float[2]\"",
                                   text)};
  names_[d.name] = d;
  return d;
}

const Declaration* Declarations::find(std::string_view name) const {
  auto it = names_.find(name);
  return it == names_.end() ? nullptr : &it->second;
}

slvm::Result<Declaration> Declarations::resolve(std::string_view token) const {
  std::vector<std::string_view> words = split_words(token);
  if (words.size() == 1) {
    if (const Declaration* known = find(words[0])) return *known;
    std::vector<std::string_view> known;
    for (const auto& [name, d] : names_)
      known.push_back(name);
    std::string_view near = slvm::nearest_name(words[0], known);
    std::string hint = near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
    return slvm::Error{fmt::format("\"{}\" is not declared{}", words[0], hint)};
  }
  Declaration d;
  size_t at = 0;
  if (auto error = parse_declaration(words, at, d)) return *error;
  // "float heat[3]" as well as "float[3] heat".
  if (at + 4 == words.size() && d.elements == 0) {
    std::rotate(words.begin() + static_cast<std::ptrdiff_t>(at),
                words.begin() + static_cast<std::ptrdiff_t>(at) + 1, words.end());
    if (auto error = parse_length(words, at, d)) return *error;
  }
  if (words.empty() || at + 1 != words.size())
    return slvm::Error{fmt::format("\"{}\" is not a declaration; expected \"[class] type name\"", token)};
  d.name = words[at];
  return d;
}

slvm::Result<std::pair<std::string, slvm::Value>> loose_value(const Param& param,
                                                              const Declarations& declarations) {
  slvm::Value value;
  auto declared = declarations.resolve(param.token);
  if (!declared) {
    if (param.token.find_first_of(" \t[") != std::string::npos) return slvm::Error{declared.error()};
    value.type = param.is_string() ? slvm::Type::kString : slvm::Type::kFloat;
    value.numbers = param.numbers;
    value.strings = param.strings;
    size_t count = param.numbers.size() + param.strings.size();
    value.elements = count == 1 ? 0 : static_cast<uint32_t>(count);
    return std::pair{param.token, value};
  }
  if (declared->mpoint)
    return slvm::Error{fmt::format("\"{}\" is an mpoint: only a Blobby has these", declared->name)};
  value.type = declared->type;
  value.elements = declared->elements;
  value.integers = declared->integer;
  value.strings = param.strings;
  size_t count = value.type == slvm::Type::kString ? param.strings.size() : param.numbers.size();
  if (count != static_cast<size_t>(declared->width()))
    return slvm::Error{fmt::format("\"{}\" takes {} value{}, found {}", declared->name, declared->width(),
                                   declared->width() == 1 ? "" : "s", count)};
  value.numbers = param.numbers;
  if (declared->hpoint) {
    value.numbers.clear();
    for (size_t i = 0; i + 3 < param.numbers.size(); i += 4)
      for (size_t k = 0; k < 3; ++k)
        value.numbers.push_back(param.numbers[i + k] / param.numbers[i + 3]);
  }
  return std::pair{declared->name, value};
}

} // namespace render
