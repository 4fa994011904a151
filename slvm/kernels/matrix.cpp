// Matrices: arithmetic, construction, and points, vectors and normals transformed by them. Row vectors: a
// point p is transformed as p * M, and "a followed by b" is the product a * b (RISpec 3.2, 15.2 and 15.3).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/matrix.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"
#include "slvm/wide/transcendental.h"

#include "slvm/kernels/rows.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

// ---- Helpers
/// The matrix whose elements are element(row, column).
template <class Element> HWY_INLINE Mat4 make_matrix(const Element& element) {
  Mat4 r;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      r.m[i][j] = element(i, j);
  return r;
}
HWY_INLINE Mat4 identity() {
  return make_matrix([](int i, int j) HWY_ATTR { return Float(i == j ? 1.0f : 0.0f); });
}
/// The 12 determinants of two rows and two columns from which cofactors are made: of the upper and lower two
/// rows.
struct Minors {
  Float upper[6], lower[6];
};
HWY_INLINE Minors minors_of(const Mat4& a) {
  static constexpr int kColumns[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  Minors r;
  for (int k = 0; k < 6; ++k) {
    int i = kColumns[k][0], j = kColumns[k][1];
    r.upper[k] = a.m[0][i] * a.m[1][j] - a.m[1][i] * a.m[0][j];
    r.lower[k] = a.m[2][i] * a.m[3][j] - a.m[3][i] * a.m[2][j];
  }
  return r;
}
HWY_INLINE Float determinant(const Minors& n) {
  return n.upper[0] * n.lower[5] - n.upper[1] * n.lower[4] + n.upper[2] * n.lower[3] +
         n.upper[3] * n.lower[2] - n.upper[4] * n.lower[1] + n.upper[5] * n.lower[0];
}
/// A 3x3 determinant, expanded along one row a, b, c whose minors are x, y, z.
HWY_INLINE Float expand(Float a, Float x, Float b, Float y, Float c, Float z) {
  return a * x - b * y + c * z;
}

/// Inverse by cofactors; all zeros when the matrix is singular.
HWY_INLINE Mat4 inverse(const Mat4& a) {
  Minors n = minors_of(a);
  const auto &u = n.upper, &l = n.lower;
  const auto& m = a.m;
  Float det = determinant(n);
  Float s = keep_if(det != 0.0f, 1.0f / det);
  Mat4 r;
  r.m[0][0] = expand(m[1][1], l[5], m[1][2], l[4], m[1][3], l[3]) * s;
  r.m[0][1] = -expand(m[0][1], l[5], m[0][2], l[4], m[0][3], l[3]) * s;
  r.m[0][2] = expand(m[3][1], u[5], m[3][2], u[4], m[3][3], u[3]) * s;
  r.m[0][3] = -expand(m[2][1], u[5], m[2][2], u[4], m[2][3], u[3]) * s;
  r.m[1][0] = -expand(m[1][0], l[5], m[1][2], l[2], m[1][3], l[1]) * s;
  r.m[1][1] = expand(m[0][0], l[5], m[0][2], l[2], m[0][3], l[1]) * s;
  r.m[1][2] = -expand(m[3][0], u[5], m[3][2], u[2], m[3][3], u[1]) * s;
  r.m[1][3] = expand(m[2][0], u[5], m[2][2], u[2], m[2][3], u[1]) * s;
  r.m[2][0] = expand(m[1][0], l[4], m[1][1], l[2], m[1][3], l[0]) * s;
  r.m[2][1] = -expand(m[0][0], l[4], m[0][1], l[2], m[0][3], l[0]) * s;
  r.m[2][2] = expand(m[3][0], u[4], m[3][1], u[2], m[3][3], u[0]) * s;
  r.m[2][3] = -expand(m[2][0], u[4], m[2][1], u[2], m[2][3], u[0]) * s;
  r.m[3][0] = -expand(m[1][0], l[3], m[1][1], l[1], m[1][2], l[0]) * s;
  r.m[3][1] = expand(m[0][0], l[3], m[0][1], l[1], m[0][2], l[0]) * s;
  r.m[3][2] = -expand(m[3][0], u[3], m[3][1], u[1], m[3][2], u[0]) * s;
  r.m[3][3] = expand(m[2][0], u[3], m[2][1], u[1], m[2][2], u[0]) * s;
  return r;
}

// ---- Operators
inline Mat4 mul_mm(const Mat4& a, const Mat4& b) {
  return make_matrix([&](int i, int j) HWY_ATTR {
    return a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] + a.m[i][3] * b.m[3][j];
  });
}
inline Mat4 mul_mf(const Mat4& a, Float b) {
  return make_matrix([&](int i, int j) HWY_ATTR { return a.m[i][j] * b; });
}
inline Mat4 mul_fm(Float a, const Mat4& b) {
  return mul_mf(b, a);
}
inline Mat4 div_mm(const Mat4& a, const Mat4& b) {
  return mul_mm(a, inverse(b));
}
inline Mat4 div_fm(Float a, const Mat4& b) {
  return mul_mf(inverse(b), a);
}
inline Mat4 div_mf(const Mat4& a, Float b) {
  return make_matrix([&](int i, int j) HWY_ATTR { return a.m[i][j] / b; });
}
inline Mat4 neg_m(const Mat4& a) {
  return make_matrix([&](int i, int j) HWY_ATTR { return -a.m[i][j]; });
}

// ---- Construction and elements
inline Mat4 diagonal_m(Float x) {
  return make_matrix([&](int i, int j) HWY_ATTR { return i == j ? x : Float(0.0f); });
}
/// Raw, for its sixteen arguments.
inline void sixteen_m(const Operand* operands, uint32_t, size_t lanes, const KernelContext& context) {
  for (size_t lane = context.begin; lane < lanes; lane += kWidth) {
    Mat4 r;
    for (size_t i = 0; i < 16; ++i)
      r.m[i / 4][i % 4] = loaded<Float>(operands[1 + i], lane);
    store(operands[0], lane, r);
  }
}
/// Element (row, column) counted from 0, both truncated; 0 where there is none.
inline Float comp_mff(const Mat4& a, Float row, Float column) {
  Float i = trunc(row), j = trunc(column), sum = 0.0f;
  for (int k = 0; k < 16; ++k) {
    Bool here = (i == static_cast<float>(k / 4)) & (j == static_cast<float>(k % 4));
    sum = sum + keep_if(here, a.m[k / 4][k % 4]);
  }
  return sum;
}
inline Mat4 setcomp_mfff(const Mat4& a, Float row, Float column, Float value) {
  Float r = trunc(row), c = trunc(column);
  return make_matrix([&](int i, int j) HWY_ATTR {
    return select((r == static_cast<float>(i)) & (c == static_cast<float>(j)), value, a.m[i][j]);
  });
}

// ---- m followed by another transformation
inline Mat4 translate_mv(const Mat4& m, Vec3 t) {
  Mat4 by = identity();
  by.m[3][0] = t.x, by.m[3][1] = t.y, by.m[3][2] = t.z;
  return mul_mm(m, by);
}
inline Mat4 scale_mv(const Mat4& m, Vec3 s) {
  Mat4 by = identity();
  by.m[0][0] = s.x, by.m[1][1] = s.y, by.m[2][2] = s.z;
  return mul_mm(m, by);
}
/// Rotation about an axis through the origin: z turns x towards y. No rotation when the axis is 0.
inline Mat4 rotate_mfv(const Mat4& m, Float angle, Vec3 axis) {
  Vec3 k = normalized(axis);
  Float c = cos(angle), s = sin(angle);
  Vec3 k1 = k * (1.0f - c), ks = k * s;
  Mat4 by = identity();
  by.m[0][0] = k.x * k1.x + c, by.m[0][1] = k.x * k1.y + ks.z, by.m[0][2] = k.x * k1.z - ks.y;
  by.m[1][0] = k.y * k1.x - ks.z, by.m[1][1] = k.y * k1.y + c, by.m[1][2] = k.y * k1.z + ks.x;
  by.m[2][0] = k.z * k1.x + ks.y, by.m[2][1] = k.z * k1.y - ks.x, by.m[2][2] = k.z * k1.z + c;
  Bool turns = dot(k, k) > 0.0f;
  Mat4 turned = mul_mm(m, by);
  return make_matrix([&](int i, int j) HWY_ATTR { return select(turns, turned.m[i][j], m.m[i][j]); });
}

// ---- Properties
inline Float determinant_m(const Mat4& m) {
  return determinant(minors_of(m));
}
inline Float isperspective_m(const Mat4& m) {
  Bool affine = (m.m[0][3] == 0.0f) & (m.m[1][3] == 0.0f) & (m.m[2][3] == 0.0f) & (m.m[3][3] == 1.0f);
  return truth(!affine);
}

// ---- Points, vectors, normals
inline Vec3 transform_mv(const Mat4& m, Vec3 p) {
  auto column = [&](int j)
                    HWY_ATTR { return p.x * m.m[0][j] + p.y * m.m[1][j] + p.z * m.m[2][j] + m.m[3][j]; };
  Vec3 moved{column(0), column(1), column(2)};
  return moved / column(3);
}
inline Vec3 vtransform_mv(const Mat4& m, Vec3 v) {
  auto column = [&](int j) HWY_ATTR { return v.x * m.m[0][j] + v.y * m.m[1][j] + v.z * m.m[2][j]; };
  return {column(0), column(1), column(2)};
}
/// Inverse transpose of the upper 3x3 part: its cofactors over its determinant; zeros when singular.
inline Mat4 normalmatrix_m(const Mat4& m) {
  auto row = [&](int i) HWY_ATTR { return Vec3(m.m[i][0], m.m[i][1], m.m[i][2]); };
  Vec3 x = row(0), y = row(1), z = row(2);
  Vec3 c0 = cross(y, z), c1 = cross(z, x), c2 = cross(x, y);
  Float det = dot(x, c0);
  Float s = keep_if(det != 0.0f, 1.0f / det);
  Mat4 r = identity();
  r.m[0][0] = c0.x * s, r.m[0][1] = c0.y * s, r.m[0][2] = c0.z * s;
  r.m[1][0] = c1.x * s, r.m[1][1] = c1.y * s, r.m[1][2] = c1.z * s;
  r.m[2][0] = c2.x * s, r.m[2][1] = c2.y * s, r.m[2][2] = c2.z * s;
  return r;
}

#define SL_FAMILY fill_matrix
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
