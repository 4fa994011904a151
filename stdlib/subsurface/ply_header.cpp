#include "stdlib/subsurface/ply_header.h"

#include <charconv>
#include <fmt/format.h>
#include <optional>

namespace subsurface {
namespace {

constexpr size_t kMostLine = 4096, kMostElements = 100, kMostProperties = 1000;
constexpr size_t kMostRows = size_t{1} << 31;

std::optional<PlyType> type_of(std::string_view word) {
  constexpr std::pair<std::string_view, PlyType> kTypes[] = {
      {"char", PlyType::kInt8},     {"int8", PlyType::kInt8},     {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},   {"short", PlyType::kInt16},   {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16}, {"uint16", PlyType::kUint16}, {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},   {"uint", PlyType::kUint32},   {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat},   {"float32", PlyType::kFloat}, {"double", PlyType::kDouble},
      {"float64", PlyType::kDouble}};
  for (auto [name, type] : kTypes)
    if (word == name) return type;
  return std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\r";
  for (size_t at = line.find_first_not_of(kBlank); at != line.npos;) {
    const size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

/// Takes the header line by line.
class Parser {
public:
  Parser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  slvm::Result<PlyHeader> parse() {
    std::string_view line;
    if (!next(line) || line != "ply")
      return slvm::Error{fmt::format("{}: not a PLY file: the first line must be 'ply'", name_)};
    while (next(line)) {
      const auto words = words_of(line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") return finished();
      if (std::string problem = statement(words); !problem.empty()) return wrong(problem);
    }
    return wrong("the header has no 'end_header', or a line of more than 4096 bytes");
  }

private:
  slvm::Error wrong(const std::string& problem) const {
    return slvm::Error{fmt::format("{}:{}: {}", name_, line_, problem)};
  }

  bool next(std::string_view& line) {
    const size_t end = text_.substr(0, at_ + kMostLine).find('\n', at_);
    if (end == text_.npos) return false;
    line = text_.substr(at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = end + 1;
    ++line_;
    return true;
  }

  slvm::Result<PlyHeader> finished() {
    if (!has_format_) return wrong("the header has no line 'format'");
    header_.bytes = at_;
    return std::move(header_);
  }

  std::string statement(const std::vector<std::string_view>& words) {
    if (words[0] == "format") return format(words);
    if (words[0] == "element") return element(words);
    if (words[0] == "property") return property(words);
    return fmt::format("unknown statement '{}'", words[0]);
  }

  std::string format(const std::vector<std::string_view>& words) {
    const std::string_view what = words.size() > 1 ? words[1] : "";
    if (words.size() != 3 || words[2] != "1.0")
      return "expected 'format ascii 1.0', or binary_little_endian or binary_big_endian";
    if (what == "ascii")
      header_.format = PlyFormat::kAscii;
    else if (what == "binary_little_endian")
      header_.format = PlyFormat::kLittleEndian;
    else if (what == "binary_big_endian")
      header_.format = PlyFormat::kBigEndian;
    else
      return fmt::format("unknown format '{}'", what);
    has_format_ = true;
    return {};
  }

  std::string element(const std::vector<std::string_view>& words) {
    uint64_t count = 0;
    if (words.size() != 3) return "expected 'element NAME COUNT'";
    const auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), count);
    if (error != std::errc() || end != words[2].data() + words[2].size() || count > kMostRows)
      return fmt::format("'{}' is no count between 0 and {}", words[2], kMostRows);
    if (header_.elements.size() >= kMostElements) return "more than 100 elements";
    header_.elements.push_back({std::string(words[1]), static_cast<size_t>(count), {}});
    return {};
  }

  std::string property(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) return "a property before the first element";
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    if (properties.size() >= kMostProperties) return "more than 1000 properties";
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (words.size() != (is_list ? 5 : 3))
      return "expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'";
    PlyProperty property;
    property.is_list = is_list;
    property.name = words.back();
    for (size_t i = is_list ? 2 : 1; i + 1 < words.size(); ++i) {
      const auto type = type_of(words[i]);
      if (!type) return fmt::format("unknown type '{}'", words[i]);
      if (is_list && i == 2) {
        if (*type >= PlyType::kFloat) return "the length of a list must be a whole number";
        property.count_type = *type;
      } else {
        property.type = *type;
      }
    }
    if (header_.elements.back().find(property.name))
      return fmt::format("a second property '{}'", property.name);
    properties.push_back(std::move(property));
    return {};
  }

  std::string_view text_;
  const std::string& name_;
  PlyHeader header_;
  size_t at_ = 0, line_ = 0;
  bool has_format_ = false;
};

} // namespace

size_t size_of(PlyType type) {
  constexpr size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

slvm::Result<PlyHeader> parse_ply_header(std::string_view text, const std::string& name) {
  return Parser(text, name).parse();
}

} // namespace subsurface
