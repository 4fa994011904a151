#include "stdlib/subsurface/ply.h"

#include "stdlib/subsurface/ply_header.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace subsurface {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Numbers as text, between white space.
class TextNumbers {
public:
  explicit TextNumbers(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  bool next(PlyType, double& value) {
    while (at_ < end_ && (*at_ == ' ' || (*at_ >= '\t' && *at_ <= '\r')))
      ++at_;
    if (at_ < end_ && *at_ == '+') ++at_;
    const auto [end, error] = std::from_chars(at_, end_, value);
    const bool fine = error == std::errc() || (error == std::errc::result_out_of_range && end != at_);
    if (!fine) return false;
    if (error != std::errc()) value = 0; // too small to be told from it, or too large for anything
    at_ = end;
    return true;
  }
  size_t left() const { return static_cast<size_t>(end_ - at_); }
  /// The fewest bytes that a number takes, with the blank before it.
  static size_t least(PlyType) { return 1; }
  static constexpr size_t kBetween = 1;

private:
  const char *at_, *end_;
};

class BinaryNumbers {
public:
  BinaryNumbers(std::string_view bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

  bool next(PlyType type, double& value) {
    const size_t size = size_of(type);
    if (bytes_.size() < size) return false;
    char raw[8] = {};
    std::memcpy(raw, bytes_.data(), size);
    if (swapped_) std::reverse(raw, raw + size);
    bytes_.remove_prefix(size);
    switch (type) {
    case PlyType::kInt8: value = as<int8_t>(raw); break;
    case PlyType::kUint8: value = as<uint8_t>(raw); break;
    case PlyType::kInt16: value = as<int16_t>(raw); break;
    case PlyType::kUint16: value = as<uint16_t>(raw); break;
    case PlyType::kInt32: value = as<int32_t>(raw); break;
    case PlyType::kUint32: value = as<uint32_t>(raw); break;
    case PlyType::kFloat: value = static_cast<double>(as<float>(raw)); break;
    case PlyType::kDouble: value = as<double>(raw); break;
    }
    return true;
  }
  size_t left() const { return bytes_.size(); }
  static size_t least(PlyType type) { return size_of(type); }
  static constexpr size_t kBetween = 0;

private:
  template <class T> static T as(const char* raw) {
    T value;
    std::memcpy(&value, raw, sizeof value);
    return value;
  }

  std::string_view bytes_;
  bool swapped_;
};

/// A double as the nearest float: what is beyond the range of floats becomes infinite.
float to_float(double value) {
  constexpr double kMost = 0x1.fffffefp127;
  if (value > kMost) return HUGE_VALF;
  if (value < -kMost) return -HUGE_VALF;
  return static_cast<float>(value);
}

template <class Numbers> bool read_list(Numbers& numbers, PlyProperty& p) {
  double length = 0;
  if (!numbers.next(p.count_type, length)) return false;
  const double least = static_cast<double>(Numbers::least(p.type));
  if (!(length >= 0) || length * least > static_cast<double>(numbers.left())) return false;
  for (auto i = static_cast<size_t>(length); i > 0; --i) {
    double item = 0;
    if (!numbers.next(p.type, item)) return false;
    p.items.push_back(item);
  }
  p.ends.push_back(p.items.size());
  return true;
}

/// Whether there can be as many rows as the header says: asked before memory is taken.
template <class Numbers> bool can_hold(const Numbers& numbers, const PlyElement& element) {
  size_t row = 0;
  for (const PlyProperty& p : element.properties)
    row += Numbers::least(p.is_list ? p.count_type : p.type) + Numbers::kBetween;
  return numbers.left() + 1 >= row * element.count;
}

/// The number of the first row that cannot be read; the count of rows when all is well.
template <class Numbers> size_t read_rows(Numbers& numbers, PlyElement& element) {
  for (PlyProperty& p : element.properties)
    p.is_list ? p.ends.reserve(element.count) : p.values.reserve(element.count);
  for (size_t row = 0; row < element.count; ++row)
    for (PlyProperty& p : element.properties) {
      double value = 0;
      if (p.is_list ? !read_list(numbers, p) : !numbers.next(p.type, value)) return row;
      if (!p.is_list) p.values.push_back(to_float(value));
    }
  return element.count;
}

template <class Numbers>
slvm::Result<PlyFile> read_data(Numbers numbers, std::vector<PlyElement> elements, const std::string& name) {
  for (PlyElement& element : elements) {
    if (element.properties.empty()) continue;
    if (!can_hold(numbers, element))
      return slvm::Error{
          fmt::format("{}: too short for {} times '{}': damaged?", name, element.count, element.name)};
    if (size_t row = read_rows(numbers, element); row < element.count)
      return slvm::Error{fmt::format("{}: '{}' number {} is cut off, or has something else than numbers",
                                     name, element.name, row)};
  }
  return PlyFile{std::move(elements)};
}

template <class Rows> auto find_named(Rows& rows, std::string_view name) {
  auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

} // namespace

const PlyProperty* PlyElement::find(std::string_view property) const {
  return find_named(properties, property);
}

const PlyElement* PlyFile::find(std::string_view element) const {
  return find_named(elements, element);
}

slvm::Result<PlyFile> parse_ply(std::span<const std::byte> bytes, const std::string& name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  auto header = parse_ply_header(text, name);
  if (!header) return slvm::Error{header.error()};
  const std::string_view data = text.substr(header->bytes);
  if (header->format == PlyFormat::kAscii)
    return read_data(TextNumbers(data), std::move(header->elements), name);
  const bool swapped = header->format == PlyFormat::kBigEndian;
  return read_data(BinaryNumbers(data, swapped), std::move(header->elements), name);
}

} // namespace subsurface
