// Bilinear and bicubic patches.
#include "render/prims/patches.h"

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

struct Weights {
  float u;
  std::array<float, 4> value, slope;
};
/// A row of a patch is a cubic of u, and so is its change along v.
struct Row {
  float v;
  Vec3 points[4], change[4];
};

Vec3 combine(const Vec3* p, size_t stride, const std::array<float, 4>& w) {
  return p[0] * w[0] + p[stride] * w[1] + p[2 * stride] * w[2] + p[3 * stride] * w[3];
}

} // namespace

Box BilinearPatch::bound(const UvRect& r) const {
  Box box;
  for (float v : {r.v0, r.v1})
    for (float u : {r.u0, r.u1})
      box.add(point(u, v));
  return box;
}

void BilinearPatch::evaluate(const UvPoints& at, SurfaceLattice& out) const {
  struct Column {
    float u;
    Vec3 first, last, dv; ///< its ends on the rows v = 0 and v = 1
  };
  struct Row {
    float v;
    Vec3 du;
  };
  const float scale = glm::dot(p_[3] - p_[0], p_[3] - p_[0]) + glm::dot(p_[2] - p_[1], p_[2] - p_[1]),
              collapsed = kCollapsed * scale;
  out.resize(at.size());
  auto column = [&](float u) {
    return Column{u, p_[0] * (1 - u) + p_[1] * u, p_[2] * (1 - u) + p_[3] * u, dv(u)};
  };
  at.for_each(
      column,
      [&](float v) {
        return Row{v, du(v)};
      },
      [&](size_t k, const Column& c, const Row& r) {
        out.P[k] = c.first * (1 - r.v) + c.last * r.v;
        out.dPdu[k] = r.du;
        out.dPdv[k] = c.dv;
        const Vec3 n = glm::cross(r.du, c.dv);
        out.N[k] = glm::dot(n, n) > collapsed * collapsed ? n : limit_normal(p_, 2, c.u, r.v);
      });
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
  const float collapsed =
      kCollapsed * (glm::dot(p_[15] - p_[0], p_[15] - p_[0]) + glm::dot(p_[12] - p_[3], p_[12] - p_[3]));
  out.resize(at.size());
  auto column = [](float u) { return Weights{u, bernstein(u), bernstein_slope(u)}; };
  auto row = [&](float v) {
    Row r{v, {}, {}};
    const std::array<float, 4> weight = bernstein(v), slope = bernstein_slope(v);
    for (size_t i = 0; i < 4; ++i) {
      r.points[i] = combine(&p_[i], 4, weight);
      r.change[i] = combine(&p_[i], 4, slope);
    }
    return r;
  };
  at.for_each(column, row, [&](size_t k, const Weights& c, const Row& r) {
    out.P[k] = combine(r.points, 1, c.value);
    out.dPdu[k] = combine(r.points, 1, c.slope);
    out.dPdv[k] = combine(r.change, 1, c.value);
    out.N[k] = glm::cross(out.dPdu[k], out.dPdv[k]);
    if (!(glm::dot(out.N[k], out.N[k]) > collapsed * collapsed)) out.N[k] = limit_normal(p_, 4, c.u, r.v);
  });
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
