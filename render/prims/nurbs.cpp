// NURBS surfaces.
#include "render/prims/nurbs.h"

#include <fmt/format.h>

#include <cmath>

namespace render {

namespace {

using Vec4d = glm::dvec4;
using Vec3d = glm::dvec3;
using Vec2d = glm::dvec2;

} // namespace

slvm::Result<NurbsBasis> NurbsBasis::make(int points, int order, std::span<const float> knots, float min,
                                          float max, std::string_view name) {
  constexpr int kMostPoints = 1 << 20;
  if (order < 2 || order > NurbsWeights::kMaxOrder)
    return slvm::Error{
        fmt::format("{}order is {}; it must be from 2 to {}", name, order, NurbsWeights::kMaxOrder)};
  if (points < order || points > kMostPoints)
    return slvm::Error{
        fmt::format("n{} is {}; order {} takes at least {} points", name, points, order, order)};
  auto count = static_cast<size_t>(points + order);
  if (knots.size() != count)
    return slvm::Error{fmt::format("'{}knot' takes n{} + {}order = {} numbers, found {}", name, name, name,
                                   count, knots.size())};
  for (size_t i = 0; i < count; ++i)
    if (!std::isfinite(knots[i]) || (i > 0 && knots[i] < knots[i - 1]))
      return slvm::Error{fmt::format("'{}knot' must not decrease; {} follows {}", name, knots[i],
                                     i > 0 ? knots[i - 1] : knots[i])};
  auto low = static_cast<double>(std::max(min, knots[static_cast<size_t>(order - 1)])),
       high = static_cast<double>(std::min(max, knots[static_cast<size_t>(points)]));
  if (!(low < high))
    return slvm::Error{
        fmt::format("no part of the knots lies between {}min {} and {}max {}", name, min, name, max)};
  NurbsBasis out;
  out.points_ = points;
  out.order_ = order;
  for (float k : knots)
    out.knots_.push_back((static_cast<double>(k) - low) / (high - low));
  return out;
}

int NurbsBasis::interval(double t) const {
  auto begin = knots_.begin() + (order_ - 1), end = knots_.begin() + points_ + 1;
  auto above = std::upper_bound(begin, end, t);
  // At or beyond the last knot: the last interval that is not empty.
  if (above == end) above = std::lower_bound(begin, end, *(end - 1));
  if (above == begin) above = std::upper_bound(begin, end, *begin);
  return static_cast<int>(above - begin) - 1;
}

NurbsWeights NurbsBasis::at(double t, int interval) const {
  NurbsWeights out;
  out.first = interval;
  int degree = order_ - 1;
  const double* knot = &knots_[static_cast<size_t>(interval + degree)];
  double* w = out.w;
  double* slope = out.slope;
  w[0] = 1;
  for (int k = 1; k <= degree; ++k) {
    // slope needs the functions of one degree less.
    if (k == degree)
      for (int i = 0; i <= degree; ++i) {
        double from = i > 0 ? w[i - 1] / (knot[i] - knot[i - degree]) : 0;
        double to = i < degree ? w[i] / (knot[i + 1] - knot[i + 1 - degree]) : 0;
        slope[i] = degree * (from - to);
      }
    double carried = 0;
    for (int i = 0; i < k; ++i) {
      double right = knot[i + 1], left = knot[i + 1 - k];
      double share = w[i] / (right - left);
      w[i] = carried + (right - t) * share;
      carried = (t - left) * share;
    }
    w[k] = carried;
  }
  return out;
}

void NurbsBasis::restrict(int interval, double a, double b, Vec4d* values, size_t stride) const {
  int degree = order_ - 1;
  const double* knot = &knots_[static_cast<size_t>(interval + degree)];
  Vec4d out[NurbsWeights::kMaxOrder], d[NurbsWeights::kMaxOrder];
  // Bezier point j is the blossom with degree - j arguments a and j arguments b.
  for (int j = 0; j <= degree; ++j) {
    for (int i = 0; i <= degree; ++i)
      d[i] = values[static_cast<size_t>(i) * stride];
    for (int r = 1; r <= degree; ++r) {
      double t = r <= j ? b : a;
      for (int i = degree; i >= r; --i) {
        double left = knot[i - degree], right = knot[i + 1 - r];
        double alpha = (t - left) / (right - left);
        d[i] = d[i - 1] * (1 - alpha) + d[i] * alpha;
      }
    }
    out[j] = d[degree];
  }
  for (int j = 0; j <= degree; ++j)
    values[static_cast<size_t>(j) * stride] = out[j];
}

namespace {

/// From homogeneous values and their changes, by the quotient rule.
NurbsSurface::Point point_of(const Vec4d& sum, const Vec4d& du, const Vec4d& dv) {
  const double scale = 1 / sum.w;
  const Vec3d P = Vec3d(sum) * scale;
  return {P, (Vec3d(du) - P * du.w) * scale, (Vec3d(dv) - P * dv.w) * scale};
}

} // namespace

NurbsSurface::Curve NurbsSurface::row(const NurbsWeights& wv, int first, int count) const {
  Curve out{first, std::vector<Vec4d>(static_cast<size_t>(count), Vec4d(0.0)),
            std::vector<Vec4d>(static_cast<size_t>(count), Vec4d(0.0))};
  for (int j = 0; j < v.order(); ++j) {
    const Vec4d* row = &points[static_cast<size_t>(wv.first + j) * static_cast<size_t>(u.points())];
    for (size_t i = 0; i < out.points.size(); ++i) {
      const Vec4d& p = row[static_cast<size_t>(first) + i];
      out.points[i] += p * wv.w[j];
      out.change[i] += p * wv.slope[j];
    }
  }
  return out;
}

NurbsSurface::Point NurbsSurface::Curve::at(const NurbsWeights& wu, int order) const {
  Vec4d sum(0.0), du(0.0), dv(0.0);
  for (int i = 0; i < order; ++i) {
    const auto k = static_cast<size_t>(wu.first - first + i);
    sum += points[k] * wu.w[i];
    du += points[k] * wu.slope[i];
    dv += change[k] * wu.w[i];
  }
  return point_of(sum, du, dv);
}

NurbsSurface::Point NurbsSurface::at(const NurbsWeights& wu, const NurbsWeights& wv) const {
  Vec4d sum(0.0), du(0.0), dv(0.0);
  for (int j = 0; j < v.order(); ++j) {
    const Vec4d* row = &points[static_cast<size_t>(wv.first + j) * static_cast<size_t>(u.points())];
    Vec4d across(0.0), across_slope(0.0);
    for (int i = 0; i < u.order(); ++i) {
      across += row[wu.first + i] * wu.w[i];
      across_slope += row[wu.first + i] * wu.slope[i];
    }
    sum += across * wv.w[j];
    du += across_slope * wv.w[j];
    dv += across * wv.slope[j];
  }
  return point_of(sum, du, dv);
}

Box NurbsSurface::bound(double u0, double u1, double v0, double v1) const {
  Box box;
  auto rows = static_cast<size_t>(v.order()), columns = static_cast<size_t>(u.order());
  std::vector<Vec4d> net(rows * columns);
  for (int j = v.interval(v0), jend = v.interval(v1); j <= jend; ++j)
    for (int i = u.interval(u0), iend = u.interval(u1); i <= iend; ++i) {
      double ua = std::max(u0, u.knot(i)), ub = std::min(u1, u.knot(i + 1)), va = std::max(v0, v.knot(j)),
             vb = std::min(v1, v.knot(j + 1));
      if (u.knot(i) >= u.knot(i + 1) || v.knot(j) >= v.knot(j + 1)) continue;
      for (size_t r = 0; r < rows; ++r)
        for (size_t c = 0; c < columns; ++c)
          net[r * columns + c] = points[(static_cast<size_t>(j) + r) * static_cast<size_t>(u.points()) +
                                        static_cast<size_t>(i) + c];
      for (size_t r = 0; r < rows; ++r)
        u.restrict(i, ua, ub, &net[r * columns], 1);
      for (size_t c = 0; c < columns; ++c)
        v.restrict(j, va, vb, &net[c], columns);
      for (const Vec4d& p : net)
        box.add(Vec3(Vec3d(p) / p.w));
    }
  Vec3 size = box.max - box.min; // room for the rounding to floats
  box.grow(1e-6f * std::max({size.x, size.y, size.z, 1e-30f}));
  return box;
}

namespace {

class NurbsGeometry final : public Geometry {
public:
  explicit NurbsGeometry(const NurbsPiece& piece) : piece_(piece) {
    // A rectangle of the parameter square: weights can be shared by rows and columns.
    const Vec2d* c = piece.corners;
    straight_ = c[0].y == c[1].y && c[2].y == c[3].y && c[0].x == c[2].x && c[1].x == c[3].x;
  }

  Box bound(const UvRect& r) const override {
    Vec2d low(1.0), high(0.0);
    for (float b : {r.v0, r.v1})
      for (float a : {r.u0, r.u1}) {
        low = glm::min(low, piece_.uv(a, b));
        high = glm::max(high, piece_.uv(a, b));
      }
    return piece_.surface->bound(low.x, high.x, low.y, high.y);
  }

  void evaluate(const UvPoints& at, SurfaceLattice& out) const override {
    out.resize(at.size());
    const NurbsSurface& surface = *piece_.surface;
    if (!straight_ || at.paired) {
      at.for_each([&](size_t k, float a, float b) {
        Vec2d uv = piece_.uv(a, b);
        set(surface.at(piece_.uweights(uv.x), piece_.vweights(uv.y)), a, b, k, out);
      });
      return;
    }
    // Where all points of a row have the same v, it is a curve.
    auto column = [&](float a) { return std::pair(a, piece_.uweights(piece_.uv(a, 0).x)); };
    int first = surface.u.points(), end = 0;
    for (float a : at.u) {
      const int here = column(a).second.first;
      first = std::min(first, here);
      end = std::max(end, here + surface.u.order());
    }
    auto row = [&](float b) {
      return std::pair(b, surface.row(piece_.vweights(piece_.uv(0, b).y), first, end - first));
    };
    at.for_each(column, row, [&](size_t k, const auto& c, const auto& r) {
      set(r.second.at(c.second, surface.u.order()), c.first, r.first, k, out);
    });
  }

private:
  /// The piece's own tangents by the chain rule.
  void set(const NurbsSurface::Point& p, double a, double b, size_t k, SurfaceLattice& out) const {
    const Vec2d* c = piece_.corners;
    Vec2d along_a = (c[1] - c[0]) * (1 - b) + (c[3] - c[2]) * b;
    Vec2d along_b = (c[2] - c[0]) * (1 - a) + (c[3] - c[1]) * a;
    out.P.set(k, Vec3(p.P));
    out.dPdu.set(k, Vec3(p.dPdu * along_a.x + p.dPdv * along_a.y));
    out.dPdv.set(k, Vec3(p.dPdu * along_b.x + p.dPdv * along_b.y));
    Vec3d n = glm::cross(p.dPdu, p.dPdv);
    double scale = glm::dot(p.dPdu, p.dPdu) + glm::dot(p.dPdv, p.dPdv);
    if (glm::length(n) < 1e-9 * scale) {
      // Tangents that vanish or are parallel: the limit from inside the piece.
      constexpr double kInwards = 1e-6;
      Vec2d in = piece_.uv(a + (0.5 - a) * kInwards, b + (0.5 - b) * kInwards);
      NurbsSurface::Point q = piece_.surface->at(piece_.uweights(in.x), piece_.vweights(in.y));
      n = glm::cross(q.dPdu, q.dPdv);
    }
    double length = glm::length(n);
    out.N.set(k, length > 0 ? Vec3(n / length) : Vec3(0.0f));
  }

  NurbsPiece piece_;
  bool straight_;
};

class VertexVar final : public VarSurface {
public:
  VertexVar(const NurbsPiece& piece, std::vector<float> values, size_t width)
      : piece_(piece), values_(std::move(values)), width_(width) {}

  void evaluate(float a, float b, std::span<float> out) const override {
    const NurbsSurface& s = *piece_.surface;
    Vec2d at = piece_.uv(a, b);
    NurbsWeights wu = piece_.uweights(at.x), wv = piece_.vweights(at.y);
    double total = 0;
    std::vector<double> sum(width_);
    for (int j = 0; j < s.v.order(); ++j)
      for (int i = 0; i < s.u.order(); ++i) {
        auto k = static_cast<size_t>((wv.first + j) * s.u.points() + wu.first + i);
        double w = wu.w[i] * wv.w[j] * s.points[k].w;
        total += w;
        for (size_t c = 0; c < width_; ++c)
          sum[c] += w * static_cast<double>(values_[k * width_ + c]);
      }
    for (size_t c = 0; c < width_; ++c)
      out[c] = static_cast<float>(sum[c] / total);
  }

private:
  NurbsPiece piece_;
  std::vector<float> values_;
  size_t width_;
};

class CornerVar final : public VarSurface {
public:
  CornerVar(const NurbsPiece& piece, std::vector<float> values, size_t width, bool steps)
      : piece_(piece), values_(std::move(values)), width_(width), steps_(steps) {}

  void evaluate(float a, float b, std::span<float> out) const override {
    const NurbsBasis &u = piece_.surface->u, &v = piece_.surface->v;
    Vec2d at = piece_.uv(a, b);
    int i = piece_.uinterval < 0 ? u.interval(at.x) : piece_.uinterval;
    int j = piece_.vinterval < 0 ? v.interval(at.y) : piece_.vinterval;
    double x = (at.x - u.knot(i)) / (u.knot(i + 1) - u.knot(i)),
           y = (at.y - v.knot(j)) / (v.knot(j + 1) - v.knot(j));
    auto columns = static_cast<size_t>(u.intervals() + (steps_ ? 0 : 1));
    size_t k = static_cast<size_t>(j) * columns + static_cast<size_t>(i);
    for (size_t c = 0; c < width_; ++c) {
      auto value = [&](size_t index) { return static_cast<double>(values_[index * width_ + c]); };
      double result = steps_ ? value(k)
                             : (value(k) * (1 - x) + value(k + 1) * x) * (1 - y) +
                                   (value(k + columns) * (1 - x) + value(k + columns + 1) * x) * y;
      out[c] = static_cast<float>(result);
    }
  }

private:
  NurbsPiece piece_;
  std::vector<float> values_;
  size_t width_;
  bool steps_;
};

} // namespace

std::shared_ptr<const Geometry> make_nurbs(const NurbsPiece& piece) {
  return std::make_shared<NurbsGeometry>(piece);
}

std::shared_ptr<const VarSurface> make_nurbs_vertex_var(const NurbsPiece& piece, std::vector<float> values,
                                                        size_t width) {
  return std::make_shared<VertexVar>(piece, std::move(values), width);
}

std::shared_ptr<const VarSurface> make_nurbs_corner_var(const NurbsPiece& piece, std::vector<float> values,
                                                        size_t width, bool steps) {
  return std::make_shared<CornerVar>(piece, std::move(values), width, steps);
}

} // namespace render
