// Bilinear and bicubic patches.
#include "render/prims/patches.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

/// Below this fraction of the product of the tangents' typical size, a cross product is noise.
constexpr float kCollapsed = 1e-6f;

/// Bernstein polynomials of degree order - 1 (1 or 3) and their slopes.
void bezier_weights(size_t order, double t, double (&w)[4], double (&slope)[4]) {
  double s = 1 - t;
  if (order == 2) {
    w[0] = s, w[1] = t;
    slope[0] = -1, slope[1] = 1;
    return;
  }
  w[0] = s * s * s, w[1] = 3 * s * s * t, w[2] = 3 * s * t * t, w[3] = t * t * t;
  slope[0] = -3 * s * s, slope[1] = 3 * s * s - 6 * s * t, slope[2] = 6 * s * t - 3 * t * t,
  slope[3] = 3 * t * t;
}

/// The unit normal where the tangents are parallel or vanish (collapsed edges and corners): its limit from
/// inside, by double precision so close to the point that the difference is below that of floats.
template <class Points> Vec3 limit_normal(const Points& p, size_t order, double u, double v) {
  using Vec3d = glm::dvec3;
  constexpr double kInwards = 1e-6;
  double wu[4], du[4], wv[4], dv[4];
  bezier_weights(order, u + (0.5 - u) * kInwards, wu, du);
  bezier_weights(order, v + (0.5 - v) * kInwards, wv, dv);
  Vec3d along_u(0.0), along_v(0.0);
  for (size_t j = 0; j < order; ++j)
    for (size_t i = 0; i < order; ++i) {
      Vec3d q = Vec3d(p[order * j + i]) - Vec3d(p[0]);
      along_u += q * (du[i] * wv[j]);
      along_v += q * (wu[i] * dv[j]);
    }
  Vec3d n = glm::cross(along_u, along_v);
  double length = glm::length(n);
  return length > 0 ? Vec3(n / length) : Vec3(0.0f);
}

std::array<float, 4> bernstein_slope(float t) {
  float s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

/// De Casteljau: control values of the part [t0, t1] of a cubic.
void restrict_cubic(Vec3* p, size_t stride, float t0, float t1) {
  // Blossoms: f(t0,t0,t0), f(t0,t0,t1), f(t0,t1,t1), f(t1,t1,t1).
  auto blossom = [&](float a, float b, float c) {
    Vec3 q0 = glm::mix(p[0], p[stride], a), q1 = glm::mix(p[stride], p[2 * stride], a),
         q2 = glm::mix(p[2 * stride], p[3 * stride], a);
    return glm::mix(glm::mix(q0, q1, b), glm::mix(q1, q2, b), c);
  };
  Vec3 r[4] = {blossom(t0, t0, t0), blossom(t0, t0, t1), blossom(t0, t1, t1), blossom(t1, t1, t1)};
  for (size_t i = 0; i < 4; ++i)
    p[i * stride] = r[i];
}

/// The basis functions of one axis, of as many points as are worked out together, and their slopes.
template <size_t kOrder> struct AxisWeights {
  static constexpr size_t kBlock = 64;
  float value[kOrder][kBlock], slope[kOrder][kBlock];

  void set(size_t k, float t) {
    const std::array<float, kOrder> values = basis(t), slopes = basis_slope(t);
    for (size_t i = 0; i < kOrder; ++i) {
      value[i][k] = values[i];
      slope[i][k] = slopes[i];
    }
  }

private:
  static std::array<float, kOrder> basis(float t) {
    if constexpr (kOrder == 4)
      return bernstein(t);
    else
      return {1 - t, t};
  }
  static std::array<float, kOrder> basis_slope(float t) {
    if constexpr (kOrder == 4)
      return bernstein_slope(t);
    else
      return {-1, 1};
  }
};

/// Sums of `values`, a component of kOrder control points, by weights, for `count` points.
template <size_t kOrder>
void combine(const std::array<float, kOrder>& values, const float (&weights)[kOrder][64], size_t first,
             size_t count, float* __restrict out) {
  for (size_t n = 0; n < count; ++n) {
    float sum = values[0] * weights[0][first + n];
    for (size_t i = 1; i < kOrder; ++i)
      sum += values[i] * weights[i][first + n];
    out[n] = sum;
  }
}

/// Control points u fastest.
template <size_t kOrder> class TensorProduct {
public:
  using Points = std::array<Vec3, kOrder * kOrder>;

  TensorProduct(const Points& p, SurfaceLattice& out) : p_(p), out_(out) {
    const Vec3 one = p[kOrder * kOrder - 1] - p[0], other = p[kOrder * (kOrder - 1)] - p[kOrder - 1];
    const float collapsed = kCollapsed * (glm::dot(one, one) + glm::dot(other, other));
    least_ = collapsed * collapsed;
  }

  void run(const UvPoints& at) {
    out_.resize(at.size());
    each_row(at, [&](const auto& columns, size_t first, size_t count, const float* u, auto& row, float v,
                     size_t k) { add_row(columns, first, count, u, row, v, k); });
  }
  void find_points(const UvPoints& at) {
    out_.P.resize(at.size());
    each_row(at, [&](const auto& columns, size_t first, size_t count, const float*, auto& row, float v,
                     size_t k) { add_points(columns, first, count, row, v, k); });
  }

private:
  static constexpr size_t kBlock = AxisWeights<kOrder>::kBlock;

  template <class F> void each_row(const UvPoints& at, F&& f) {
    const size_t width = at.u.size();
    AxisWeights<kOrder> columns, rows;
    for (size_t u = 0; u < width; u += kBlock) {
      const size_t count = std::min(kBlock, width - u);
      for (size_t i = 0; i < count; ++i)
        columns.set(i, at.u[u + i]);
      if (at.paired)
        for (size_t i = 0; i < count; ++i)
          f(columns, i, size_t{1}, &at.u[u + i], rows, at.v[u + i], u + i);
      else
        for (size_t j = 0; j < at.v.size(); ++j)
          f(columns, size_t{0}, count, &at.u[u], rows, at.v[j], j * width + u);
    }
  }

  /// `count` points from k on, of as many columns from `first` on. A row of a patch is a curve of u, and so
  /// is its change along v.
  void add_row(const AxisWeights<kOrder>& columns, size_t first, size_t count, const float* u,
               AxisWeights<kOrder>& row, float v, size_t k) {
    row.set(0, v);
    for (size_t c = 0; c < 3; ++c) {
      const auto component = static_cast<glm::length_t>(c);
      std::array<float, kOrder> points, change;
      for (size_t i = 0; i < kOrder; ++i) {
        points[i] = change[i] = 0;
        for (size_t j = 0; j < kOrder; ++j) {
          const float value = p_[j * kOrder + i][component];
          points[i] += value * row.value[j][0];
          change[i] += value * row.slope[j][0];
        }
      }
      combine(points, columns.value, first, count, out_.P.plane(c) + k);
      combine(points, columns.slope, first, count, out_.dPdu.plane(c) + k);
      combine(change, columns.value, first, count, out_.dPdv.plane(c) + k);
    }
    add_normals(u, v, count, k);
  }

  void add_points(const AxisWeights<kOrder>& columns, size_t first, size_t count, AxisWeights<kOrder>& row,
                  float v, size_t k) {
    row.set(0, v);
    for (size_t c = 0; c < 3; ++c) {
      std::array<float, kOrder> points{};
      for (size_t i = 0; i < kOrder; ++i)
        for (size_t j = 0; j < kOrder; ++j)
          points[i] += p_[j * kOrder + i][static_cast<glm::length_t>(c)] * row.value[j][0];
      combine(points, columns.value, first, count, out_.P.plane(c) + k);
    }
  }

  void add_normals(const float* u, float v, size_t count, size_t k) {
    const Vec3Planes &a = out_.dPdu, &b = out_.dPdv;
    float* N[3] = {out_.N.plane(0) + k, out_.N.plane(1) + k, out_.N.plane(2) + k};
    for (size_t c = 0; c < 3; ++c) {
      const float *ay = a.plane((c + 1) % 3) + k, *az = a.plane((c + 2) % 3) + k,
                  *by = b.plane((c + 1) % 3) + k, *bz = b.plane((c + 2) % 3) + k;
      float* __restrict own = N[c];
      for (size_t n = 0; n < count; ++n)
        own[n] = ay[n] * bz[n] - by[n] * az[n];
    }
    const float *x = N[0], *y = N[1], *z = N[2], least = least_;
    int collapsed = 0;
    for (size_t n = 0; n < count; ++n)
      collapsed |= !(x[n] * x[n] + y[n] * y[n] + z[n] * z[n] > least);
    for (size_t n = 0; collapsed && n < count; ++n)
      if (!(x[n] * x[n] + y[n] * y[n] + z[n] * z[n] > least))
        out_.N.set(k + n, limit_normal(p_, kOrder, u[n], v));
  }

  const Points& p_;
  SurfaceLattice& out_;
  float least_; ///< squared length of cross products that are no noise
};

} // namespace

Box BilinearPatch::bound(const UvRect& r) const {
  Box box;
  for (float v : {r.v0, r.v1})
    for (float u : {r.u0, r.u1})
      box.add(point(u, v));
  return box;
}

void BilinearPatch::evaluate(const UvPoints& at, SurfaceLattice& out) const {
  TensorProduct<2>(p_, out).run(at);
}

void BilinearPatch::find_points(const UvPoints& at, SurfaceLattice& out) const {
  TensorProduct<2>(p_, out).find_points(at);
}

Box BicubicPatch::bound(const UvRect& r) const {
  std::array<Vec3, 16> q = p_;
  for (size_t row = 0; row < 4; ++row)
    restrict_cubic(&q[4 * row], 1, r.u0, r.u1);
  for (size_t column = 0; column < 4; ++column)
    restrict_cubic(&q[column], 4, r.v0, r.v1);
  Box box;
  for (Vec3 p : q)
    box.add(p);
  return box;
}

void BicubicPatch::evaluate(const UvPoints& at, SurfaceLattice& out) const {
  TensorProduct<4>(p_, out).run(at);
}

void BicubicPatch::find_points(const UvPoints& at, SurfaceLattice& out) const {
  TensorProduct<4>(p_, out).find_points(at);
}

std::array<float, 4> bernstein(float t) {
  float s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

std::shared_ptr<const Geometry> make_bilinear(const std::array<Vec3, 4>& points) {
  return std::make_shared<BilinearPatch>(points);
}

std::shared_ptr<const Geometry> make_bicubic(const std::array<Vec3, 16>& points, int coarsest) {
  return std::make_shared<BicubicPatch>(points, coarsest);
}

void convert_to_bezier(const CubicBasis& u, const CubicBasis& v, float* values, size_t stride) {
  convert_to_bezier(to_bezier(u), to_bezier(v), values, stride);
}

Matrix4 to_bezier(const CubicBasis& basis) {
  return inverse_or_identity(bezier_basis().matrix) * basis.matrix;
}

void convert_to_bezier(const Matrix4& u, const Matrix4& v, float* values, size_t stride) {
  // [t^3 t^2 t 1] M p = [t^3 t^2 t 1] B b, so b = B^-1 M p: along rows for u, along columns for v.
  auto convert = [&](const Matrix4& m, float* at, size_t step) {
    float in[4], out[4] = {};
    for (int i = 0; i < 4; ++i)
      in[i] = at[static_cast<size_t>(i) * step];
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        out[i] += m(i, j) * in[j];
    for (int i = 0; i < 4; ++i)
      at[static_cast<size_t>(i) * step] = out[i];
  };
  for (size_t k = 0; k < 4; ++k)
    convert(u, values + 4 * k * stride, stride);
  for (size_t k = 0; k < 4; ++k)
    convert(v, values + k * stride, 4 * stride);
}

} // namespace render
