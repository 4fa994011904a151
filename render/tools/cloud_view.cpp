#include "render/tools/cloud_view.h"

#include "render/rays/hemisphere_pattern.h"
#include "render/state/math.h"
#include "slvm/support/files.h"
#include "stdlib/subsurface/ply.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace render::tools {

namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr const char* kColours[] = {"r", "g", "b"};

Vec3 triple_at(const PointColumn& c, size_t i) {
  return {c.values[3 * i], c.values[3 * i + 1], c.values[3 * i + 2]};
}

void add_triples(PointTable& to, const char* name, const std::vector<subsurface::Vec3>& from) {
  if (from.empty()) return;
  std::vector<float>& values = to.add(name, 3);
  for (size_t i = 0; i < from.size(); ++i)
    for (int c = 0; c < 3; ++c)
      values[3 * i + static_cast<size_t>(c)] = from[i][c];
}

PointTable table_of_cloud(const subsurface::PointCloud& cloud) {
  PointTable table;
  table.kind = "point cloud";
  table.points = cloud.size();
  if (cloud.size() == 0) table.add("P", 3);
  add_triples(table, "P", cloud.position);
  add_triples(table, "N", cloud.normal);
  if (!cloud.area.empty()) {
    std::vector<float>& radius = table.add("radius", 1);
    for (size_t i = 0; i < radius.size(); ++i)
      radius[i] = std::sqrt(cloud.area[i] / kPi);
  }
  add_triples(table, "irradiance", cloud.irradiance);
  add_triples(table, "albedo", cloud.albedo);
  for (const subsurface::Channel& c : cloud.channels)
    table.add(c.name, 1) = c.values;
  return table;
}

Box bounds_of(const PointTable& table) {
  Box box;
  const PointColumn& P = *table.find("P", 3);
  for (size_t i = 0; i < table.points; ++i)
    box.add(triple_at(P, i));
  return box;
}

/// What is shown. Null, with a reason: there is nothing of that name, or nothing that has a colour.
slvm::Result<const PointColumn*> shown_column(const PointTable& table, const std::string& name) {
  auto find = [&](std::string_view wanted) -> const PointColumn* {
    const PointColumn* colour = table.find(wanted, 3);
    return colour ? colour : table.find(wanted, 1);
  };
  if (name.empty()) {
    for (const char* usual : {"radiance", "irradiance", "occlusion", "power", "albedo"})
      if (const PointColumn* c = find(usual)) return c;
    return nullptr;
  }
  if (const PointColumn* c = find(name)) return c;
  std::string there;
  for (const PointColumn& c : table.columns)
    if (c.components == 1 || c.components == 3) there += fmt::format(" {}", c.name);
  return slvm::Error{fmt::format("there is no '{}' to be shown; there is{}", name, there)};
}

Vec3 colour_at(const PointColumn* c, size_t i) {
  if (!c) return Vec3(1);
  return c->components == 3 ? triple_at(*c, i) : Vec3(c->values[i]);
}

/// How far apart points are, about: half of what caches say, whose records reach to their neighbours.
float spacing_at(const PointTable& table, const PointColumn* radius, size_t i, float otherwise) {
  if (!radius || !(radius->values[i] > 0)) return otherwise;
  return table.kind == "point cloud" ? radius->values[i] : 0.3f * radius->values[i];
}

std::string points_of(const PointTable& table, const PointColumn* shown, const ViewSettings& s, float size) {
  std::string P = "Points \"P\" [", colours = "\"Cs\" [";
  for (size_t i = 0; i < table.points; ++i) {
    const Vec3 p = triple_at(*table.find("P", 3), i), c = s.gain * colour_at(shown, i);
    P += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    colours += fmt::format("{} {} {}\n", c.x, c.y, c.z);
  }
  return fmt::format("{}]\n{}] \"constantwidth\" [{}]\n", P, colours, size * s.scale);
}

/// Faces of eight sides.
slvm::Result<std::string> discs_of(const PointTable& table, const PointColumn* shown, const ViewSettings& s,
                                   float size) {
  constexpr int kSides = 8;
  const PointColumn *P = table.find("P", 3), *N = table.find("N", 3), *radius = table.find("radius", 1);
  if (!N) return slvm::Error{"the points have no normals, which discs need"};
  std::string counts, corners, places, colours;
  for (size_t i = 0; i < table.points; ++i) {
    const Vec3 p = triple_at(*P, i), c = s.gain * colour_at(shown, i);
    Vec3 n = triple_at(*N, i), x, y;
    n = glm::dot(n, n) > 0 ? glm::normalize(n) : Vec3(0, 0, 1);
    basis_about(n, x, y);
    counts += fmt::format("{} ", kSides);
    colours += fmt::format("{} {} {}\n", c.x, c.y, c.z);
    const float r = s.scale * spacing_at(table, radius, i, size);
    for (int k = 0; k < kSides; ++k) {
      const float a = 2 * kPi * static_cast<float>(k) / kSides;
      const Vec3 corner = p + r * (std::cos(a) * x + std::sin(a) * y);
      corners += fmt::format("{} ", kSides * i + static_cast<size_t>(k));
      places += fmt::format("{} {} {}\n", corner.x, corner.y, corner.z);
    }
  }
  return fmt::format("PointsPolygons [{}]\n[{}]\n\"P\" [{}]\n\"uniform color Cs\" [{}]\n", counts, corners,
                     places, colours);
}

/// Of a column: numbers apart by spaces, one for each component.
template <class F> std::string by_component(const PointColumn& c, F&& f) {
  std::string out;
  for (uint32_t k = 0; k < c.components; ++k)
    out += fmt::format("{}{:.4g}", k ? " " : "", f(k));
  return out;
}

} // namespace

slvm::Result<PointTable> read_cloud(const std::string& path) {
  auto bytes = slvm::read_file(path, kMostTableBytes);
  if (!bytes) return slvm::Error{bytes.error()};
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  if (std::string_view(text, bytes->size()).starts_with("ply")) {
    auto cloud = subsurface::parse_point_cloud(*bytes, path);
    if (!cloud) return slvm::Error{cloud.error()};
    return table_of_cloud(*cloud);
  }
  auto table = parse_point_table(*bytes, path);
  if (table && !table->find("P", 3)) return slvm::Error{fmt::format("{}: the points have no places", path)};
  return table;
}

std::string describe(const PointTable& table, const std::string& name) {
  std::string out = fmt::format("{}: {}, {} points\n", name, table.kind, table.points);
  if (table.points == 0) return out;
  for (const PointColumn& c : table.columns) {
    auto over = [&](float first, auto&& join) {
      return by_component(c, [&](uint32_t k) {
        auto value = static_cast<double>(first);
        for (size_t i = 0; i < table.points; ++i)
          value = join(value, static_cast<double>(c.values[i * c.components + k]));
        return value;
      });
    };
    const auto count = static_cast<double>(table.points);
    out += fmt::format("  {:<22} {} .. {}, mean {}\n", c.name,
                       over(kInfinity, [](double a, double b) { return std::min(a, b); }),
                       over(-kInfinity, [](double a, double b) { return std::max(a, b); }),
                       over(0, [&](double a, double b) { return a + b / count; }));
  }
  return out;
}

slvm::Result<std::string> scene_of(const PointTable& table, const ViewSettings& s,
                                   const std::string& display) {
  auto shown = shown_column(table, s.show);
  if (!shown) return slvm::Error{shown.error()};
  const Box box = table.points ? bounds_of(table) : Box{Vec3(-1), Vec3(1)};
  const Vec3 middle = 0.5f * (box.min + box.max);
  const float reach = std::max(0.5f * glm::length(box.max - box.min), 1e-6f);
  // The sphere round all fills a view of 30 degrees.
  constexpr float kView = 30;
  const float distance = 1.02f * reach / std::sin(radians(kView / 2));
  const float view = 2 / radians(1) * std::atan(std::tan(radians(kView / 2)) / s.zoom);
  const float pixel = 2 * reach / static_cast<float>(std::min(s.width, s.height));
  std::string points;
  if (table.points && s.discs) {
    auto discs = discs_of(table, *shown, s, 2 * pixel);
    if (!discs) return slvm::Error{discs.error()};
    points = std::move(*discs);
  } else if (table.points) {
    points = points_of(table, *shown, s, 3 * pixel);
  }
  return fmt::format(
      "Display \"{}\" \"file\" \"rgba\"\nFormat {} {} 1\nPixelSamples 3 3\n"
      "Projection \"perspective\" \"fov\" [{}]\nExposure 1 {}\n"
      "Translate 0 0 {}\nRotate {} 1 0 0\nRotate {} 0 1 0\nTranslate {} {} {}\n"
      "Imager \"background\" \"color bgcolor\" [.02 .02 .03]\nWorldBegin\nSurface \"constant\"\n{}WorldEnd\n",
      display, s.width, s.height, view, display.ends_with(".exr") ? 1.0 : 2.2, distance, -s.tilt, s.turn,
      -middle.x, -middle.y, -middle.z, points);
}

subsurface::PointCloud cloud_of(const PointTable& table) {
  subsurface::PointCloud out;
  auto take = [&](const PointColumn& c) {
    std::vector<subsurface::Vec3> values(table.points);
    for (size_t i = 0; i < table.points; ++i)
      values[i] = {c.values[3 * i], c.values[3 * i + 1], c.values[3 * i + 2]};
    return values;
  };
  for (const PointColumn& c : table.columns) {
    const bool three = c.components == 3;
    if (three && c.name == "P")
      out.position = take(c);
    else if (three && c.name == "N")
      out.normal = take(c);
    else if (three && c.name == "irradiance")
      out.irradiance = take(c);
    else if (three && c.name == "albedo")
      out.albedo = take(c);
    else if (!three && c.name == "radius")
      for (float r : c.values)
        out.area.push_back(kPi * r * r);
    else
      for (uint32_t k = 0; k < c.components; ++k) {
        const bool direction = c.name == "environmentdir" || c.name == "direction";
        std::string name = c.components == 1 ? c.name
                           : three           ? fmt::format("{}_{}", c.name, (direction ? kAxes : kColours)[k])
                                             : fmt::format("{}_{}", c.name, k);
        subsurface::Channel& channel = out.channels.emplace_back();
        channel.name = std::move(name);
        for (size_t i = 0; i < table.points; ++i)
          channel.values.push_back(c.values[i * c.components + k]);
      }
  }
  return out;
}

} // namespace render::tools
