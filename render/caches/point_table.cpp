// The bytes of a table of points.
#include "render/caches/point_table.h"

#include "slvm/format/slo.h"
#include "slvm/support/files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <set>

namespace render {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers go to files as they are in memory");

/// PNG's idea: a byte that is no text, and line ends that careless copying would change.
constexpr unsigned char kMagic[8] = {0x89, 'S', 'L', 'P', '\r', '\n', 0x1a, '\n'};
constexpr uint32_t kVersion = 1;
constexpr uint32_t kMostColumns = 64, kMostComponents = 64, kMostName = 64;
constexpr const char* kRemedy = "make it anew with the scene that writes it";

struct Header {
  unsigned char magic[8];
  uint32_t version = kVersion;
  uint32_t columns = 0;
  uint64_t points = 0;
  uint64_t checksum = 0; ///< of all that follows
};
static_assert(sizeof(Header) == 32);

void put(std::vector<std::byte>& out, const void* data, size_t bytes) {
  const size_t before = out.size();
  out.resize(before + bytes);
  if (bytes) std::memcpy(out.data() + before, data, bytes);
}

void put_text(std::vector<std::byte>& out, std::string_view text) {
  const auto length = static_cast<uint32_t>(text.size());
  put(out, &length, sizeof length);
  put(out, text.data(), text.size());
}

/// Words: letters, digits, spaces, '_'.
bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= kMostName && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' || c == '_';
  });
}

/// Takes what a file should have, as long as it has it.
class Reader {
public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  uint32_t number() {
    uint32_t n = 0;
    if (const auto raw = take(sizeof n); raw.size() == sizeof n) std::memcpy(&n, raw.data(), sizeof n);
    return n;
  }
  /// A name, or "" where there is none.
  std::string name() {
    const uint32_t length = number();
    if (length > kMostName) return "";
    const auto raw = take(length);
    std::string text(reinterpret_cast<const char*>(raw.data()), raw.size());
    return is_name(text) ? text : "";
  }
  std::span<const std::byte> take(size_t bytes) {
    if (bytes > rest_.size()) return {};
    const auto out = rest_.first(bytes);
    rest_ = rest_.subspan(bytes);
    return out;
  }
  size_t left() const { return rest_.size(); }

private:
  std::span<const std::byte> rest_;
};

/// What is wrong with a header, or "".
std::string check_header(std::span<const std::byte> bytes, Header& header) {
  if (bytes.size() < sizeof kMagic || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    return "this is neither an irradiance cache nor a photon map of Anemone";
  if (bytes.size() < sizeof header) return fmt::format("the file is cut off; {}", kRemedy);
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.version != kVersion)
    return fmt::format("the file has version {} of the format, this program reads version {}; {}",
                       header.version, kVersion, kRemedy);
  if (slvm::hash_bytes(bytes.subspan(sizeof header)) != header.checksum)
    return fmt::format("the file is cut off or damaged: its contents do not match their checksum; {}",
                       kRemedy);
  return "";
}

bool read_table(Reader& r, const Header& header, PointTable& table) {
  table.kind = r.name();
  if (table.kind.empty() || header.columns > kMostColumns) return false;
  uint64_t numbers = 0; // of a point
  std::set<std::string> names;
  for (uint32_t i = 0; i < header.columns; ++i) {
    PointColumn& column = table.columns.emplace_back();
    column.name = r.name();
    column.components = r.number();
    if (column.name.empty() || column.components == 0 || column.components > kMostComponents) return false;
    if (!names.insert(column.name).second) return false;
    numbers += column.components;
  }
  const size_t all = r.left() / sizeof(float);
  if (r.left() % sizeof(float) != 0 || header.points > (numbers ? all / numbers : 0)) return false;
  if (header.points * numbers != all) return false;
  table.points = header.points;
  for (PointColumn& column : table.columns) {
    column.values.resize(table.points * column.components);
    const auto raw = r.take(column.values.size() * sizeof(float));
    if (!raw.empty()) std::memcpy(column.values.data(), raw.data(), raw.size());
    for (float x : column.values)
      if (!std::isfinite(x)) return false;
  }
  return true;
}

} // namespace

const PointColumn* PointTable::find(std::string_view name, uint32_t components) const {
  for (const PointColumn& c : columns)
    if (c.name == name && c.components == components) return &c;
  return nullptr;
}

std::vector<float>& PointTable::add(std::string name, uint32_t components) {
  columns.push_back({std::move(name), components, std::vector<float>(points * components)});
  return columns.back().values;
}

std::vector<std::byte> format_point_table(const PointTable& table) {
  std::vector<std::byte> body;
  put_text(body, table.kind);
  for (const PointColumn& c : table.columns) {
    put_text(body, c.name);
    put(body, &c.components, sizeof c.components);
  }
  for (const PointColumn& c : table.columns)
    put(body, c.values.data(), c.values.size() * sizeof(float));
  Header header;
  std::copy(std::begin(kMagic), std::end(kMagic), header.magic);
  header.columns = static_cast<uint32_t>(table.columns.size());
  header.points = table.points;
  header.checksum = slvm::hash_bytes(body);
  std::vector<std::byte> out;
  out.reserve(sizeof header + body.size());
  put(out, &header, sizeof header);
  put(out, body.data(), body.size());
  return out;
}

slvm::Result<PointTable> parse_point_table(std::span<const std::byte> bytes, const std::string& name) {
  Header header;
  if (std::string problem = check_header(bytes, header); !problem.empty())
    return slvm::Error{fmt::format("{}: {}", name, problem)};
  Reader reader(bytes.subspan(sizeof header));
  PointTable table;
  if (!read_table(reader, header, table))
    return slvm::Error{fmt::format("{}: the file is damaged: it contradicts itself; {}", name, kRemedy)};
  return table;
}

slvm::Result<PointTable> read_point_table(const std::string& path) {
  auto bytes = slvm::read_file(path, kMostTableBytes);
  if (!bytes) return slvm::Error{bytes.error()};
  return parse_point_table(*bytes, path);
}

slvm::Result<bool> write_point_table(const std::string& path, const PointTable& table) {
  return slvm::write_file(path, format_point_table(table));
}

} // namespace render
