// Ear clipping (Meisters 1975) with bridges to holes (Eberly, "Triangulation by ear clipping").
#include "render/prims/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {

namespace {

using Point = glm::dvec2;

/// Twice the signed area of a triangle.
double cross(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Edges count as inside.
bool in_triangle(Point a, Point b, Point c, Point p) {
  return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
}

class EarClipper {
public:
  EarClipper(std::span<const Point> points, std::span<const int> loops)
      : points_(points.begin(), points.end()) {
    size_t first = 0;
    for (int count : loops) {
      loops_.push_back({first, static_cast<size_t>(count)});
      first += static_cast<size_t>(count);
    }
    std::span<const Point> outer(points_.data(), loops_[0].count);
    // A clockwise outline is counter-clockwise in a mirror, without a change of order.
    if (loop_area(outer) < 0)
      for (Point& p : points_)
        p.y = -p.y;
  }

  std::vector<Triangle> run() {
    size_t start = add_ring(loops_[0], true);
    join_holes(start);
    clip(start);
    return std::move(out_);
  }

private:
  struct Loop {
    size_t first, count;
  };
  struct Node {
    size_t point, previous, next;
  };
  const Point& at(size_t node) const { return points_[nodes_[node].point]; }

  /// A ring of nodes that turns counter-clockwise or clockwise. The last one is returned.
  size_t add_ring(Loop loop, bool counter_clockwise) {
    bool forwards = (loop_area({points_.data() + loop.first, loop.count}) >= 0) == counter_clockwise;
    size_t base = nodes_.size();
    for (size_t i = 0; i < loop.count; ++i)
      nodes_.push_back({loop.first + (forwards ? i : loop.count - 1 - i),
                        base + (i + loop.count - 1) % loop.count, base + (i + 1) % loop.count});
    return base + loop.count - 1;
  }

  void join_holes(size_t outline) {
    std::vector<size_t> rightmost;
    for (size_t k = 1; k < loops_.size(); ++k) {
      if (loops_[k].count < 3) continue;
      size_t start = add_ring(loops_[k], false), best = start;
      for (size_t n = nodes_[start].next; n != start; n = nodes_[n].next)
        if (at(n).x > at(best).x) best = n;
      rightmost.push_back(best);
    }
    std::stable_sort(rightmost.begin(), rightmost.end(),
                     [&](size_t a, size_t b) { return at(a).x > at(b).x; });
    for (size_t hole : rightmost)
      bridge(hole, visible_from(hole, outline));
  }

  /// A node of the outline that sees the hole's rightmost one: along +x the nearest edge is hit; its end, or
  /// the reflex corner nearest to the ray that hides this end.
  size_t visible_from(size_t hole, size_t outline) const {
    Point m = at(hole);
    double nearest = std::numeric_limits<double>::infinity();
    size_t end = outline, n = outline;
    do {
      Point a = at(n), b = at(nodes_[n].next);
      if (a.y <= m.y && b.y >= m.y && a.y != b.y) {
        double x = a.x + (m.y - a.y) / (b.y - a.y) * (b.x - a.x);
        if (x >= m.x && x < nearest) {
          nearest = x;
          end = a.x > b.x ? n : nodes_[n].next;
          if (m.y == a.y) end = n;
          if (m.y == b.y) end = nodes_[n].next;
        }
      }
      n = nodes_[n].next;
    } while (n != outline);
    if (nearest == m.x || at(end).y == m.y) return end;
    Point hit(nearest, m.y), corner = at(end);
    double best = std::numeric_limits<double>::infinity();
    size_t result = end;
    n = outline;
    do {
      Point p = at(n);
      bool above = corner.y > m.y;
      bool inside = above ? in_triangle(m, hit, corner, p) : in_triangle(m, corner, hit, p);
      if (n != end && p.x > m.x && inside) {
        double slope = std::abs(p.y - m.y) / (p.x - m.x);
        // Of several on one ray the nearest; of several nodes at one place the one the ray enters by.
        if (slope < best || (slope == best && p.x < at(result).x)) {
          best = slope;
          result = n;
        }
      }
      n = nodes_[n].next;
    } while (n != outline);
    return locally_open(result, m);
  }

  /// Bridges leave several nodes at one place; the one whose corner opens towards `m`.
  size_t locally_open(size_t node, Point m) const {
    size_t n = node;
    do {
      if (at(n) == at(node)) {
        Point a = at(nodes_[n].previous), b = at(n), c = at(nodes_[n].next);
        bool convex = cross(a, b, c) >= 0;
        bool left_in = cross(a, b, m) >= 0, left_out = cross(b, c, m) >= 0;
        if (convex ? left_in && left_out : left_in || left_out) return n;
      }
      n = nodes_[n].next;
    } while (n != node);
    return node;
  }

  void bridge(size_t hole, size_t outer) {
    size_t outer2 = nodes_.size(), hole2 = outer2 + 1;
    nodes_.push_back({nodes_[outer].point, hole2, nodes_[outer].next});
    nodes_.push_back({nodes_[hole].point, nodes_[hole].previous, outer2});
    nodes_[nodes_[outer].next].previous = outer2;
    nodes_[nodes_[hole].previous].next = hole2;
    nodes_[outer].next = hole;
    nodes_[hole].previous = outer;
  }

  bool is_ear(size_t n) {
    Point a = at(nodes_[n].previous), b = at(n), c = at(nodes_[n].next);
    if (!(cross(a, b, c) > 0)) return false;
    for (size_t k = nodes_[nodes_[n].next].next; k != nodes_[n].previous; k = nodes_[k].next) {
      ++tests_;
      Point p = at(k);
      if (p == a || p == b || p == c) continue;
      if (in_triangle(a, b, c, p) && cross(at(nodes_[k].previous), p, at(nodes_[k].next)) <= 0) return false;
    }
    return true;
  }

  void clip(size_t n) {
    size_t left = 0, k = n;
    do
      ++left;
    while ((k = nodes_[k].next) != n);
    size_t since_last = 0;
    while (left > 2) {
      size_t previous = nodes_[n].previous, next = nodes_[n].next;
      double area = cross(at(previous), at(n), at(next));
      // Corners without area go; so does, when nothing else is left or time is up, any corner.
      bool stuck = since_last > left || tests_ > kMostTests;
      if (area != 0 && !stuck && !is_ear(n)) {
        n = next;
        ++since_last;
        continue;
      }
      if (area > 0) out_.push_back({index(previous), index(n), index(next)});
      nodes_[previous].next = next;
      nodes_[next].previous = previous;
      --left;
      since_last = 0;
      n = nodes_[next].next;
    }
  }
  int index(size_t node) const { return static_cast<int>(nodes_[node].point); }

  static constexpr size_t kMostTests = 400'000'000; ///< about a second
  std::vector<Point> points_;
  std::vector<Loop> loops_;
  std::vector<Node> nodes_;
  std::vector<Triangle> out_;
  size_t tests_ = 0;
};

} // namespace

double loop_area(std::span<const glm::dvec2> loop) {
  double sum = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    Point a = loop[i], b = loop[(i + 1) % loop.size()];
    sum += (a.x - loop[0].x) * (b.y - loop[0].y) - (a.y - loop[0].y) * (b.x - loop[0].x);
  }
  return sum;
}

std::vector<Triangle> triangulate(std::span<const glm::dvec2> points, std::span<const int> loops) {
  if (loops.empty() || loops[0] < 3) return {};
  return EarClipper(points, loops).run();
}

} // namespace render
