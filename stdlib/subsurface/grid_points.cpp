#include "stdlib/subsurface/grid_points.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace subsurface {
namespace {

/// From the mean of four corners, which lies below a surface that bulges, to the surface itself: half of how
/// far the corners stand out, each along its own normal; exact to second order. Not more than a part of the
/// cell, as shading normals may be anything.
Vec3 bulge(Vec3 mean, const Vec3 (&corner)[4], const Vec3 (&normal)[4], Vec3 outward) {
  constexpr float kMost = 0.2f;
  float out = 0, size = 0;
  for (int k = 0; k < 4; ++k) {
    out += dot(corner[k] - mean, normalize(normal[k])) / 8;
    size = std::max(size, length(corner[k] - mean));
  }
  return outward * std::clamp(out, -kMost * size, kMost * size);
}

} // namespace

void append_grid(PointCloud& cloud, const GridView& grid) {
  assert(grid.position.size() >= grid.nu * grid.nv);
  for (size_t v = 0; v + 1 < grid.nv; ++v)
    for (size_t u = 0; u + 1 < grid.nu; ++u) {
      const size_t a = v * grid.nu + u, b = a + 1, c = a + grid.nu, d = c + 1;
      auto mean = [&](const auto& column) { return (column[a] + column[b] + column[c] + column[d]) * 0.25f; };
      const auto& p = grid.position;
      const float area =
          0.5f * (length(cross(p[b] - p[a], p[d] - p[a])) + length(cross(p[d] - p[a], p[c] - p[a])));
      if (!(area > 0) || !std::isfinite(area)) continue;
      const Vec3 outward =
          normalize(grid.normal.empty() ? cross(p[d] - p[a], p[c] - p[b]) : mean(grid.normal));
      Vec3 middle = mean(p);
      if (const auto& n = grid.normal; !n.empty())
        middle += bulge(middle, {p[a], p[b], p[c], p[d]}, {n[a], n[b], n[c], n[d]}, outward);
      cloud.position.push_back(middle);
      cloud.area.push_back(area);
      cloud.normal.push_back(outward);
      if (!grid.irradiance.empty()) cloud.irradiance.push_back(mean(grid.irradiance));
      if (!grid.albedo.empty()) cloud.albedo.push_back(mean(grid.albedo));
    }
}

namespace {

/// Halves a cloud and takes a point of each part.
class Thinning {
public:
  Thinning(const PointCloud& from, PointCloud& to) : from_(from), to_(to) {
    for (const Channel& c : from.channels)
      to.channels.push_back({c.name, {}});
  }

  void run(size_t count) {
    for (uint32_t i = 0; i < from_.size(); ++i)
      if (from_.area[i] > 0) order_.push_back(i);
    std::vector<Part> todo{{0, order_.size(), count}};
    while (!todo.empty()) {
      const Part part = todo.back();
      todo.pop_back();
      if (part.begin == part.end) continue;
      if (part.count <= 1 || part.end - part.begin == 1) {
        take(part);
        continue;
      }
      const size_t first = part.count / 2;
      const size_t middle = split(part, static_cast<double>(first) / static_cast<double>(part.count));
      todo.push_back({middle, part.end, part.count - first});
      todo.push_back({part.begin, middle, first});
    }
  }

private:
  struct Part {
    size_t begin, end, count;
  };

  double area_of(const Part& part) const {
    double sum = 0;
    for (size_t i = part.begin; i < part.end; ++i)
      sum += static_cast<double>(from_.area[order_[i]]);
    return sum;
  }

  int longest_side(const Part& part) const {
    Vec3 low = from_.position[order_[part.begin]], high = low;
    for (size_t i = part.begin; i < part.end; ++i)
      for (int c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], from_.position[order_[i]][c]);
        high[c] = std::max(high[c], from_.position[order_[i]][c]);
      }
    const Vec3 size = high - low;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  /// Sorts the part along its longest side and returns where `share` of its area is full; neither half is
  /// empty.
  size_t split(const Part& part, double share) {
    const int side = longest_side(part);
    auto at = [&](size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::sort(at(part.begin), at(part.end), [&](uint32_t a, uint32_t b) {
      const float x = from_.position[a][side], y = from_.position[b][side];
      return x != y ? x < y : a < b;
    });
    const double wanted = share * area_of(part);
    double sum = 0;
    size_t middle = part.begin;
    while (middle < part.end - 1) {
      const auto next = static_cast<double>(from_.area[order_[middle]]);
      if (middle > part.begin && sum + next / 2 > wanted) break;
      sum += next;
      ++middle;
    }
    return middle;
  }

  void take(const Part& part) {
    const double area = area_of(part);
    auto mean = [&](const auto& column) {
      auto sum = column[order_[part.begin]] * 0.0f;
      for (size_t i = part.begin; i < part.end; ++i)
        sum += column[order_[i]] * static_cast<float>(static_cast<double>(from_.area[order_[i]]) / area);
      return sum;
    };
    const Vec3 centre = mean(from_.position);
    uint32_t best = order_[part.begin];
    for (size_t i = part.begin; i < part.end; ++i)
      if (length2(from_.position[order_[i]] - centre) < length2(from_.position[best] - centre))
        best = order_[i];
    to_.position.push_back(from_.position[best]);
    to_.area.push_back(static_cast<float>(area));
    if (!from_.normal.empty()) to_.normal.push_back(from_.normal[best]);
    if (!from_.irradiance.empty()) to_.irradiance.push_back(mean(from_.irradiance));
    if (!from_.albedo.empty()) to_.albedo.push_back(mean(from_.albedo));
    for (size_t c = 0; c < from_.channels.size(); ++c)
      to_.channels[c].values.push_back(mean(from_.channels[c].values));
  }

  const PointCloud& from_;
  PointCloud& to_;
  std::vector<uint32_t> order_;
};

} // namespace

PointCloud thin(const PointCloud& cloud, size_t count) {
  PointCloud out;
  if (count > 0 && !cloud.area.empty()) Thinning(cloud, out).run(count);
  return out;
}

} // namespace subsurface
