// 4x4 matrix arithmetic for set-up work.
#include "slvm/support/matrix.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace slvm {

Matrix4 operator*(const Matrix4& a, const Matrix4& b) {
  Matrix4 out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      double sum = 0;
      for (int k = 0; k < 4; ++k)
        sum += static_cast<double>(a(i, k)) * static_cast<double>(b(k, j));
      out(i, j) = static_cast<float>(sum);
    }
  return out;
}

bool invert(const Matrix4& m, Matrix4& inverse) {
  double a[4][8];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      a[i][j] = static_cast<double>(m(i, j));
      a[i][4 + j] = i == j ? 1.0 : 0.0;
    }
  for (int column = 0; column < 4; ++column) {
    int pivot = column;
    for (int i = column + 1; i < 4; ++i)
      if (std::fabs(a[i][column]) > std::fabs(a[pivot][column])) pivot = i;
    if (!(std::fabs(a[pivot][column]) > 0) || !std::isfinite(a[pivot][column])) {
      inverse.m.fill(0);
      return false;
    }
    for (int j = 0; j < 8; ++j)
      std::swap(a[column][j], a[pivot][j]);
    double scale = 1 / a[column][column];
    for (int j = 0; j < 8; ++j)
      a[column][j] *= scale;
    for (int i = 0; i < 4; ++i) {
      if (i == column) continue;
      double factor = a[i][column];
      for (int j = 0; j < 8; ++j)
        a[i][j] -= factor * a[column][j];
    }
  }
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      inverse(i, j) = static_cast<float>(a[i][4 + j]);
  return true;
}

float determinant3(const Matrix4& m) {
  return m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
         m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
         m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
}

std::array<float, 3> transform_point(const Matrix4& m, std::array<float, 3> p) {
  float out[4];
  for (int j = 0; j < 4; ++j)
    out[j] = p[0] * m(0, j) + p[1] * m(1, j) + p[2] * m(2, j) + m(3, j);
  if (out[3] == 0 || out[3] == 1) return {out[0], out[1], out[2]};
  return {out[0] / out[3], out[1] / out[3], out[2] / out[3]};
}

std::array<float, 3> transform_vector(const Matrix4& m, std::array<float, 3> v) {
  std::array<float, 3> out;
  for (int j = 0; j < 3; ++j)
    out[static_cast<size_t>(j)] = v[0] * m(0, j) + v[1] * m(1, j) + v[2] * m(2, j);
  return out;
}

std::array<float, 3> transform_normal(const Matrix4& m, std::array<float, 3> n) {
  Matrix4 upper = m, inverse;
  for (int i = 0; i < 3; ++i)
    upper(i, 3) = upper(3, i) = 0;
  upper(3, 3) = 1;
  if (!invert(upper, inverse)) return {0, 0, 0};
  std::array<float, 3> out;
  for (int j = 0; j < 3; ++j)
    out[static_cast<size_t>(j)] = n[0] * inverse(j, 0) + n[1] * inverse(j, 1) + n[2] * inverse(j, 2);
  return out;
}

} // namespace slvm
