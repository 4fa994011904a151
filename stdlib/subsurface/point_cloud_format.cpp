// A point cloud as the bytes of a PLY file. Reading: point_cloud.cpp.
#include "stdlib/subsurface/point_cloud.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <set>

namespace subsurface {
namespace {

/// One property to be written: where its values stand in memory, `stride` floats apart.
struct Column {
  std::string name;
  const float* data;
  size_t stride;
  bool as_byte;
};

constexpr const char* kOwnNames[] = {
    "x",        "y",        "z",   "nx",    "ny",   "nz",           "area",         "albedo_r",
    "albedo_g", "albedo_b", "red", "green", "blue", "irradiance_r", "irradiance_g", "irradiance_b"};

void add(std::vector<Column>& columns, const std::vector<Vec3>& values,
         std::initializer_list<const char*> names, bool as_byte = false) {
  static_assert(sizeof(Vec3) == 3 * sizeof(float));
  size_t component = 0;
  if (!values.empty())
    for (const char* name : names)
      columns.push_back({name, &values[0].x + component++, 3, as_byte});
}

std::vector<Column> columns_of(const PointCloud& cloud) {
  std::vector<Column> columns;
  if (cloud.size() == 0)
    return {{"x", nullptr, 0, false}, {"y", nullptr, 0, false}, {"z", nullptr, 0, false}};
  add(columns, cloud.position, {"x", "y", "z"});
  add(columns, cloud.normal, {"nx", "ny", "nz"});
  if (!cloud.area.empty()) columns.push_back({"area", cloud.area.data(), 1, false});
  add(columns, cloud.irradiance, {"irradiance_r", "irradiance_g", "irradiance_b"});
  add(columns, cloud.albedo, {"albedo_r", "albedo_g", "albedo_b"});
  add(columns, cloud.albedo, {"red", "green", "blue"}, true);
  for (const Channel& c : cloud.channels)
    columns.push_back({c.name, c.values.data(), 1, false});
  return columns;
}

std::string bad_channel_name(const PointCloud& cloud) {
  std::set<std::string_view> used(std::begin(kOwnNames), std::end(kOwnNames));
  for (const Channel& c : cloud.channels) {
    const bool plain =
        !c.name.empty() && c.name.size() < 1000 &&
        std::all_of(c.name.begin(), c.name.end(), [](unsigned char ch) { return ch > ' ' && ch < 127; });
    if (!plain)
      return fmt::format("'{}' cannot be the name of a channel: it must be one word of ASCII", c.name);
    if (!used.insert(c.name).second)
      return fmt::format(
          "'{}' cannot be the name of a channel: there is one, or the cloud's own data have it", c.name);
  }
  return {};
}

uint8_t to_byte(float value) {
  return static_cast<uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f);
}

void put_binary(std::string& out, const Column& column, float value) {
  if (column.as_byte) return out.push_back(static_cast<char>(to_byte(value)));
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  out.append(raw, sizeof value);
}

void put_text(std::string& out, const Column& column, float value) {
  char text[32];
  const auto end =
      column.as_byte ? std::to_chars(text, text + 32, to_byte(value)) : std::to_chars(text, text + 32, value);
  out.append(text, end.ptr);
}

} // namespace

slvm::Result<std::vector<std::byte>> format_point_cloud(const PointCloud& cloud, PlyEncoding encoding) {
  std::string problem = check(cloud);
  if (problem.empty()) problem = bad_channel_name(cloud);
  if (!problem.empty()) return slvm::Error{problem};
  const bool binary = encoding == PlyEncoding::kBinary;
  const std::vector<Column> columns = columns_of(cloud);
  std::string out = fmt::format("ply\nformat {} 1.0\ncomment point cloud of Anemone\nelement vertex {}\n",
                                binary ? "binary_little_endian" : "ascii", cloud.size());
  for (const Column& c : columns)
    out += fmt::format("property {} {}\n", c.as_byte ? "uchar" : "float", c.name);
  out += "end_header\n";
  out.reserve(out.size() + cloud.size() * columns.size() * (binary ? 4 : 10));
  for (size_t i = 0; i < cloud.size(); ++i)
    for (const Column& c : columns) {
      const float value = c.data[i * c.stride];
      if (binary)
        put_binary(out, c, value);
      else
        put_text(out, c, value), out.push_back(&c == &columns.back() ? '\n' : ' ');
    }
  const auto bytes = std::as_bytes(std::span(out));
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

} // namespace subsurface
