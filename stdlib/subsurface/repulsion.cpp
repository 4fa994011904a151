#include "stdlib/subsurface/repulsion.h"

#include "stdlib/subsurface/parallel.h"
#include "stdlib/subsurface/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace subsurface {
namespace {

/// Random places, one in each of equal shares of the area.
std::vector<SurfacePoint> scatter(const MeshPlane& plane, size_t count, uint64_t seed) {
  const TriangleMesh& mesh = plane.mesh();
  std::vector<double> up_to;
  double total = 0;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto area = static_cast<double>(mesh.area(t));
    up_to.push_back(total += std::isfinite(area) ? area : 0);
  }
  std::vector<SurfacePoint> points;
  if (!(total > 0)) return points;
  Random random(seed);
  for (size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + random.unit()) / static_cast<double>(count) * total;
    const auto found = std::upper_bound(up_to.begin(), up_to.end() - 1, at);
    const auto triangle = static_cast<uint32_t>(found - up_to.begin());
    const FlatTriangle flat = plane.own(triangle);
    const auto root = static_cast<float>(std::sqrt(random.unit())), b = static_cast<float>(random.unit());
    points.push_back({triangle, flat.corner[1] * (root * (1 - b)) + flat.corner[2] * (root * b)});
  }
  return points;
}

/// The points by where they are: triangle, row of the triangle's own plane, x.
class Index {
public:
  Index(std::span<const SurfacePoint> points, float row_height) : height_(row_height) {
    entries_.reserve(points.size());
    for (uint32_t i = 0; i < points.size(); ++i) {
      // Places in triangles without extent may be no numbers, which have no order.
      Vec2 at = points[i].at;
      if (!std::isfinite(at.x + at.y)) at = {0, 0};
      entries_.push_back({points[i].triangle, row_of(at.y), at, i});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls f(index, place in the triangle's own plane) for the points of a triangle not farther from `at`
  /// than a row is high, and some more.
  template <class F> void near(uint32_t triangle, Vec2 at, F&& f) const {
    for (int row = row_of(at.y - height_); row <= row_of(at.y + height_); ++row) {
      const Entry low{triangle, row, {at.x - height_, 0}, 0};
      for (auto e = std::lower_bound(entries_.begin(), entries_.end(), low);
           e != entries_.end() && e->triangle == triangle && e->row == row && e->at.x <= at.x + height_; ++e)
        f(e->index, e->at);
    }
  }

private:
  struct Entry {
    uint32_t triangle;
    int row;
    Vec2 at;
    uint32_t index;
    bool operator<(const Entry& b) const {
      return std::tie(triangle, row, at.x, index) < std::tie(b.triangle, b.row, b.at.x, b.index);
    }
  };

  /// What is not a number goes to the first row.
  int row_of(float y) const {
    const float row = std::floor(y / height_);
    return static_cast<int>(std::min(std::max(-1e9f, row), 1e9f));
  }

  float height_;
  std::vector<Entry> entries_;
};

float distance_to_edge(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 side = b - a;
  const float size = dot(side, side);
  const float t = size > 0 ? std::clamp(dot(p - a, side) / size, 0.0f, 1.0f) : 0;
  const Vec2 off = p - a - side * t;
  return std::sqrt(dot(off, off));
}

/// Finds the neighbourhood of points. One for each thread.
class Neighbourhood {
public:
  Neighbourhood(const MeshPlane& plane, const Index& index, float radius)
      : plane_(plane), index_(index), radius_(radius), seen_(plane.mesh().triangles.size(), 0) {}

  /// The sum of the pushes that a point gets, in its triangle's own plane.
  Vec2 push(uint32_t self, const SurfacePoint& point) {
    constexpr size_t kMostTriangles = 5000; // of meshes far finer than the points
    Vec2 sum;
    ++stamp_;
    todo_.assign(1, {0, plane_.own(point.triangle)});
    for (size_t count = 0; !todo_.empty() && count < kMostTriangles; ++count) {
      // The nearest first, so that each triangle lies as the shortest way to it unfolds it.
      std::pop_heap(todo_.begin(), todo_.end(), farther);
      const FlatTriangle flat = todo_.back().flat;
      todo_.pop_back();
      if (seen_[flat.triangle] == stamp_) continue;
      seen_[flat.triangle] = stamp_;
      push_from(self, point.at, flat, sum);
      for (int k = 0; k < 3; ++k)
        open(point.at, flat, k);
    }
    return sum;
  }

private:
  struct Open {
    float distance;
    FlatTriangle flat;
  };
  static bool farther(const Open& a, const Open& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.flat.triangle > b.flat.triangle;
  }

  void push_from(uint32_t self, Vec2 at, const FlatTriangle& flat, Vec2& sum) const {
    index_.near(flat.triangle, plane_.to_own(flat, at), [&](uint32_t other, Vec2 own) {
      if (other == self) return;
      const Vec2 away = at - plane_.from_own(flat, own);
      const float d = std::sqrt(dot(away, away));
      if (d >= radius_) return;
      // Points at the same place part in directions of their own.
      const float angle = 2.399963f * static_cast<float>(self % 1000);
      const Vec2 direction = d > 0 ? away * (1 / d) : Vec2{std::cos(angle), std::sin(angle)};
      sum = sum + direction * (radius_ - d);
    });
  }

  void open(Vec2 at, const FlatTriangle& flat, int k) {
    const Vec2 a = flat.corner[static_cast<size_t>(k)], b = flat.corner[static_cast<size_t>((k + 1) % 3)];
    FlatTriangle beyond;
    const float distance = distance_to_edge(at, a, b);
    if (distance >= radius_ || !plane_.across(flat, k, beyond) || seen_[beyond.triangle] == stamp_) return;
    todo_.push_back({distance, beyond});
    std::push_heap(todo_.begin(), todo_.end(), farther);
  }

  const MeshPlane& plane_;
  const Index& index_;
  float radius_;
  std::vector<uint32_t> seen_;
  std::vector<Open> todo_; // a heap
  uint32_t stamp_ = 0;
};

} // namespace

std::vector<SurfacePoint> repel(const MeshPlane& plane, const RepulsionOptions& options) {
  constexpr float kStep = 0.15f;
  std::vector<SurfacePoint> points = scatter(plane, options.points, options.seed);
  if (points.empty()) return points;
  const auto radius =
      static_cast<float>(2 * std::sqrt(plane.mesh().total_area() / static_cast<double>(points.size())));
  std::vector<SurfacePoint> moved(points.size());
  for (int pass = 0; pass < options.passes; ++pass) {
    const Index index(points, radius);
    parallel_ranges(points.size(), options.threads, [&](size_t begin, size_t end) {
      Neighbourhood around(plane, index, radius);
      for (size_t i = begin; i < end; ++i) {
        Vec2 way = around.push(static_cast<uint32_t>(i), points[i]) * kStep;
        const float length = std::sqrt(dot(way, way));
        if (length > radius / 2) way = way * (radius / 2 / length);
        moved[i] = plane.walk(points[i], way);
      }
    });
    points.swap(moved);
  }
  return points;
}

PointCloud cloud_of(const MeshPlane& plane, std::span<const SurfacePoint> points) {
  PointCloud cloud;
  const auto area =
      static_cast<float>(plane.mesh().total_area() / static_cast<double>(std::max<size_t>(points.size(), 1)));
  for (const SurfacePoint& p : points) {
    cloud.position.push_back(plane.position(p));
    cloud.normal.push_back(normalize(plane.mesh().wide_normal(p.triangle)));
    cloud.area.push_back(area);
  }
  return cloud;
}

size_t sample_count(double area, double mean_free_path) {
  const double count = std::ceil(area / (std::numbers::pi * mean_free_path * mean_free_path));
  return count >= 1 && count < 2e9 ? static_cast<size_t>(count) : count >= 2e9 ? size_t{2'000'000'000} : 1;
}

} // namespace subsurface
