#include "stdlib/subsurface/point_cloud.h"

#include "slvm/support/files.h"
#include "stdlib/subsurface/ply.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <tuple>

namespace subsurface {
namespace {

/// Takes columns of a file by their names, and remembers which were taken.
class Columns {
public:
  explicit Columns(const PlyElement& vertex) : vertex_(vertex), taken_(vertex.properties.size()) {}

  const PlyProperty* take(std::string_view name) {
    for (size_t i = 0; i < taken_.size(); ++i)
      if (vertex_.properties[i].name == name && !vertex_.properties[i].is_list) {
        taken_[i] = true;
        return &vertex_.properties[i];
      }
    return nullptr;
  }

  /// Three columns as one; empty unless all are there. Bytes are divided by 255 if they are colours.
  std::vector<Vec3> take(std::string_view x, std::string_view y, std::string_view z, bool colour = false) {
    const PlyProperty* c[3] = {take(x), take(y), take(z)};
    std::vector<Vec3> out;
    if (!c[0] || !c[1] || !c[2]) return out;
    out.reserve(vertex_.count);
    const float scale = colour && c[0]->type == PlyType::kUint8 ? 1 / 255.0f : 1;
    for (size_t i = 0; i < vertex_.count; ++i)
      out.push_back(Vec3{c[0]->values[i], c[1]->values[i], c[2]->values[i]} * scale);
    return out;
  }

  std::vector<Channel> rest() const {
    std::vector<Channel> channels;
    for (size_t i = 0; i < taken_.size(); ++i)
      if (!taken_[i] && !vertex_.properties[i].is_list)
        channels.push_back({vertex_.properties[i].name, vertex_.properties[i].values});
    return channels;
  }

private:
  const PlyElement& vertex_;
  std::vector<char> taken_;
};

template <class T, class F>
std::string check_column(const std::vector<T>& column, size_t size, const char* name, F fine) {
  if (column.empty()) return {};
  if (column.size() != size)
    return fmt::format("there are {} positions, but {} times '{}'", size, column.size(), name);
  auto bad = std::find_if_not(column.begin(), column.end(), fine);
  return bad == column.end()
             ? ""
             : fmt::format("the {} of point {} is not a usable number", name, bad - column.begin());
}

} // namespace

const Channel* PointCloud::find(std::string_view channel) const {
  for (const Channel& c : channels)
    if (c.name == channel) return &c;
  return nullptr;
}

double PointCloud::total_area() const {
  double sum = 0;
  for (float a : area)
    sum += static_cast<double>(a);
  return sum;
}

std::string check(const PointCloud& cloud) {
  const size_t n = cloud.size();
  auto number = [](float v) { return std::isfinite(v); };
  auto area = [](float v) { return std::isfinite(v) && v >= 0; };
  std::string problem = check_column(cloud.position, n, "position", is_finite);
  if (problem.empty()) problem = check_column(cloud.normal, n, "normal", is_finite);
  if (problem.empty()) problem = check_column(cloud.area, n, "area", area);
  if (problem.empty()) problem = check_column(cloud.irradiance, n, "irradiance", is_finite);
  if (problem.empty()) problem = check_column(cloud.albedo, n, "albedo", is_finite);
  for (const Channel& c : cloud.channels) {
    if (problem.empty()) problem = check_column(c.values, n, c.name.c_str(), number);
    if (problem.empty() && c.values.size() != n) problem = fmt::format("the channel '{}' is empty", c.name);
  }
  return problem;
}

void append(PointCloud& to, const PointCloud& from) {
  if (from.size() == 0) return;
  if (to.size() == 0) {
    to = from;
    return;
  }
  auto add = [](auto& column, const auto& more) { column.insert(column.end(), more.begin(), more.end()); };
  add(to.position, from.position);
  add(to.normal, from.normal);
  add(to.area, from.area);
  add(to.irradiance, from.irradiance);
  add(to.albedo, from.albedo);
  for (size_t i = 0; i < to.channels.size(); ++i)
    add(to.channels[i].values, from.channels[i].values);
}

void sort_points(PointCloud& cloud) {
  std::vector<size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), size_t{0});
  auto key = [&](size_t i) {
    const Vec3 p = cloud.position[i], n = cloud.normal.empty() ? Vec3() : cloud.normal[i];
    return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, cloud.area.empty() ? 0.0f : cloud.area[i]);
  };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
  auto arrange = [&](auto& column) {
    if (column.empty()) return;
    const auto before = column;
    for (size_t i = 0; i < order.size(); ++i)
      column[i] = before[order[i]];
  };
  arrange(cloud.position);
  arrange(cloud.normal);
  arrange(cloud.area);
  arrange(cloud.irradiance);
  arrange(cloud.albedo);
  for (Channel& c : cloud.channels)
    arrange(c.values);
}

slvm::Result<PointCloud> parse_point_cloud(std::span<const std::byte> bytes, const std::string& name) {
  auto file = parse_ply(bytes, name);
  if (!file) return slvm::Error{file.error()};
  const PlyElement* vertex = file->find("vertex");
  if (!vertex) return slvm::Error{fmt::format("{}: there is no element 'vertex'", name)};
  Columns columns(*vertex);
  PointCloud cloud;
  cloud.position = columns.take("x", "y", "z");
  if (cloud.position.size() != vertex->count)
    return slvm::Error{fmt::format("{}: 'vertex' needs the properties x, y and z", name)};
  cloud.normal = columns.take("nx", "ny", "nz");
  if (const PlyProperty* area = columns.take("area")) cloud.area = area->values;
  cloud.irradiance = columns.take("irradiance_r", "irradiance_g", "irradiance_b");
  cloud.albedo = columns.take("albedo_r", "albedo_g", "albedo_b");
  std::vector<Color> painted = columns.take("red", "green", "blue", true);
  if (cloud.albedo.empty()) cloud.albedo = std::move(painted);
  cloud.channels = columns.rest();
  if (std::string problem = check(cloud); !problem.empty())
    return slvm::Error{fmt::format("{}: {}", name, problem)};
  return cloud;
}

slvm::Result<PointCloud> read_point_cloud(const std::string& path) {
  auto bytes = slvm::read_file(path, kMostPlyBytes);
  if (!bytes) return slvm::Error{bytes.error()};
  return parse_point_cloud(*bytes, path);
}

slvm::Result<bool> write_point_cloud(const std::string& path, const PointCloud& cloud, PlyEncoding encoding) {
  auto bytes = format_point_cloud(cloud, encoding);
  if (!bytes) return slvm::Error{fmt::format("cannot write '{}': {}", path, bytes.error())};
  return slvm::write_file(path, *bytes);
}

} // namespace subsurface
