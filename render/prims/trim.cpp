// Trim regions to quadrilaterals.
#include "render/prims/trim.h"

#include "render/prims/triangulate.h"

namespace render {

namespace {

using Vec2d = glm::dvec2;
using Outline = std::vector<Vec2d>;

/// Chords deviate at most this far from their curve, in a square of side 1.
constexpr double kDeviation = 1e-4;
constexpr int kDeepest = 9;

class Flattener {
public:
  Flattener(const TrimCurve& curve, const NurbsBasis& basis, Vec2d low, Vec2d high, Outline& out)
      : curve_(curve), basis_(basis), low_(low), high_(high), out_(out) {}

  void run() {
    out_.push_back(at(0, basis_.interval(0)));
    for (int i = basis_.interval(0); i <= basis_.interval(1); ++i) {
      double a = std::max(0.0, basis_.knot(i)), b = std::min(1.0, basis_.knot(i + 1));
      if (a < b) divide(i, a, at(a, i), b, at(b, i), basis_.order() > 2 ? 0 : kDeepest);
    }
  }

private:
  Vec2d at(double t, int interval) const {
    NurbsWeights w = basis_.at(t, interval);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < basis_.order(); ++i)
      sum += curve_.points[static_cast<size_t>(w.first + i)] * w.w[i];
    Vec2d p = (Vec2d(sum) / sum.z - low_) / (high_ - low_);
    return glm::clamp(p, Vec2d(0.0), Vec2d(1.0));
  }
  /// Appends the points after `from` up to `to`.
  void divide(int interval, double a, Vec2d from, double b, Vec2d to, int depth) {
    double middle = (a + b) / 2;
    Vec2d p = at(middle, interval);
    bool flat = depth >= 2 && glm::distance(p, (from + to) / 2.0) <= kDeviation;
    if (depth >= kDeepest || flat) {
      out_.push_back(to);
      return;
    }
    divide(interval, a, from, middle, p, depth + 1);
    divide(interval, middle, p, b, to, depth + 1);
  }

  const TrimCurve& curve_;
  const NurbsBasis& basis_;
  Vec2d low_, high_;
  Outline& out_;
};

Outline flatten(const TrimLoop& loop, Vec2d low, Vec2d high) {
  Outline all;
  for (const TrimCurve& curve : loop) {
    auto basis = NurbsBasis::make(static_cast<int>(curve.points.size()), curve.order, curve.knots, curve.min,
                                  curve.max, "t");
    if (basis) Flattener(curve, *basis, low, high, all).run();
  }
  Outline out;
  for (Vec2d p : all)
    if (out.empty() || glm::distance(p, out.back()) > 1e-9) out.push_back(p);
  while (out.size() > 1 && glm::distance(out.front(), out.back()) <= 1e-9)
    out.pop_back();
  return out;
}

bool contains(const Outline& outline, Vec2d p) {
  bool inside = false;
  for (size_t i = 0; i < outline.size(); ++i) {
    Vec2d a = outline[i], b = outline[(i + 1) % outline.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/// Some point inside, not on the outline; the outline has area.
Vec2d inner_point(const Outline& outline) {
  int count = static_cast<int>(outline.size());
  double largest = -1;
  Vec2d best(0.0);
  for (const Triangle& t : triangulate(outline, {&count, 1})) {
    Vec2d a = outline[static_cast<size_t>(t[0])], b = outline[static_cast<size_t>(t[1])],
          c = outline[static_cast<size_t>(t[2])];
    double area = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    if (area > largest) {
      largest = area;
      best = (a + b + c) / 3.0;
    }
  }
  return best;
}

/// The three quadrilaterals of a counter-clockwise triangle, each from a corner to the centre.
void add_triangle(const Vec2d (&p)[3], std::vector<UvQuad>& out) {
  Vec2d centre = (p[0] + p[1] + p[2]) / 3.0;
  for (size_t k = 0; k < 3; ++k)
    out.push_back({p[k], (p[k] + p[(k + 1) % 3]) / 2.0, (p[k] + p[(k + 2) % 3]) / 2.0, centre});
}

/// An outline with its holes.
void add_area(Outline outer, const std::vector<const Outline*>& holes, std::vector<UvQuad>& out) {
  if (loop_area(outer) < 0) std::reverse(outer.begin(), outer.end());
  std::vector<int> loops{static_cast<int>(outer.size())};
  for (const Outline* h : holes) {
    loops.push_back(static_cast<int>(h->size()));
    outer.insert(outer.end(), h->begin(), h->end());
  }
  for (const Triangle& t : triangulate(outer, loops))
    add_triangle({outer[static_cast<size_t>(t[0])], outer[static_cast<size_t>(t[1])],
                  outer[static_cast<size_t>(t[2])]},
                 out);
}

} // namespace

std::vector<UvQuad> trimmed_square(const TrimRegion& region, Vec2d low, Vec2d high, bool outside) {
  std::vector<Outline> outlines;
  if (outside) outlines.push_back({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  for (const TrimLoop& loop : region.loops) {
    Outline outline = flatten(loop, low, high);
    if (outline.size() >= 3 && loop_area(outline) != 0) outlines.push_back(std::move(outline));
  }
  // In how many others each lies: an even number makes an outer edge, an odd one a hole.
  std::vector<std::vector<size_t>> parents(outlines.size());
  for (size_t i = 0; i < outlines.size(); ++i) {
    Vec2d p = inner_point(outlines[i]);
    for (size_t k = 0; k < outlines.size(); ++k)
      if (k != i && contains(outlines[k], p)) {
        // Two loops around the same point: the smaller one is inside.
        double own = std::abs(loop_area(outlines[i])), other = std::abs(loop_area(outlines[k]));
        if (own < other || (own == other && k < i)) parents[i].push_back(k);
      }
  }
  std::vector<UvQuad> out;
  for (size_t i = 0; i < outlines.size(); ++i) {
    if (parents[i].size() % 2 == 1) continue;
    std::vector<const Outline*> holes;
    for (size_t k = 0; k < outlines.size(); ++k)
      if (parents[k].size() == parents[i].size() + 1 &&
          std::find(parents[k].begin(), parents[k].end(), i) != parents[k].end())
        holes.push_back(&outlines[k]);
    add_area(outlines[i], holes, out);
  }
  return out;
}

} // namespace render
