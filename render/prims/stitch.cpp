// Outlines of grids.
#include "render/prims/stitch.h"

namespace render {

namespace {

/// Point i of side s of a grid.
size_t side_point(size_t s, size_t i, size_t nu, size_t nv) {
  switch (s) {
  case 0: return i;
  case 1: return (nv - 1) * nu + i;
  case 2: return i * nu;
  default: return i * nu + nu - 1;
  }
}

class SideFinder {
public:
  SideFinder(const std::vector<Vec2>& points, float interval, float longest, std::vector<uint8_t>& keep)
      : points_(points), segment_(interval / static_cast<float>(points.size() - 1)), longest_(longest),
        keep_(keep) {}

  void run(size_t from, size_t to) {
    keep_[from] = keep_[to] = 1;
    if (to - from < 2) return;
    bool wide = segment_ * static_cast<float>(to - from) > kOutlineInterval;
    size_t middle = (from + to) / 2;
    // The ends of an arc that turns back at the silhouette may be close together: its middle tells.
    float length = std::max({glm::distance(points_[from], points_[to]),
                             2 * glm::distance(points_[from], points_[middle]),
                             2 * glm::distance(points_[middle], points_[to])});
    if (!wide && length <= longest_) return;
    run(from, middle);
    run(middle, to);
  }

private:
  const std::vector<Vec2>& points_;
  float segment_; ///< parameter interval between two points
  float longest_;
  std::vector<uint8_t>& keep_;
};

} // namespace

GridOutline find_outline(const slvm::Grid& grid, const UvRect& rect, const Camera& camera, float step) {
  GridOutline out;
  const slvm::Planes& P = grid.variable(slvm::Global::kP);
  auto nu = static_cast<size_t>(grid.nu()), nv = static_cast<size_t>(grid.nv());
  std::vector<Vec2> points;
  for (size_t s = 0; s < 4; ++s) {
    size_t count = s < 2 ? nu : nv;
    points.resize(count);
    for (size_t i = 0; i < count; ++i) {
      size_t k = side_point(s, i, nu, nv);
      points[i] = camera.project({P.get(0, k), P.get(1, k), P.get(2, k)});
    }
    out.sides[s].assign(count, 0);
    float interval = s < 2 ? rect.u1 - rect.u0 : rect.v1 - rect.v0;
    SideFinder(points, interval, kOutlineStep * step, out.sides[s]).run(0, count - 1);
  }
  return out;
}

void snap_to_outline(const GridOutline& outline, int nu, int nv, std::span<float> values) {
  auto columns = static_cast<size_t>(nu), rows = static_cast<size_t>(nv);
  for (size_t s = 0; s < 4; ++s) {
    const std::vector<uint8_t>& keep = outline.sides[s];
    size_t last = 0;
    for (size_t i = 1; i < keep.size(); ++i) {
      if (!keep[i]) continue;
      float a = values[side_point(s, last, columns, rows)], b = values[side_point(s, i, columns, rows)];
      for (size_t j = last + 1; j < i; ++j)
        values[side_point(s, j, columns, rows)] =
            a + (b - a) * (static_cast<float>(j - last) / static_cast<float>(i - last));
      last = i;
    }
  }
}

} // namespace render
