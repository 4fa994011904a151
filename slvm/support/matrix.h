// 4x4 matrices in the RenderMan convention: row vectors, p' = p * M, translation in elements 12-14. PUBLIC.
// For set-up work (coordinate systems); shading uses the wide matrices of slvm/wide.
#pragma once

#include <array>
#include <cstddef>

namespace slvm {

struct Matrix4 {
  /// Row by row: element (row, column) is m[4 * row + column].
  std::array<float, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

  float operator()(int row, int column) const { return m[static_cast<size_t>(4 * row + column)]; }
  float& operator()(int row, int column) { return m[static_cast<size_t>(4 * row + column)]; }
  bool operator==(const Matrix4&) const = default;
};

/// Transform by a first, then by b.
Matrix4 operator*(const Matrix4& a, const Matrix4& b);
/// Stores the inverse of m; false, and all zeros, when m is singular. Gauss-Jordan with pivoting, in double.
bool invert(const Matrix4& m, Matrix4& inverse);
/// Determinant of the upper 3x3 part: negative when the matrix mirrors.
float determinant3(const Matrix4& m);
/// p * M divided by the resulting w (left alone when w is 0).
std::array<float, 3> transform_point(const Matrix4& m, std::array<float, 3> p);
/// v times the upper 3x3 part.
std::array<float, 3> transform_vector(const Matrix4& m, std::array<float, 3> v);
/// n times the inverse transpose of the upper 3x3 part; not renormalised. Zero when that part is singular.
std::array<float, 3> transform_normal(const Matrix4& m, std::array<float, 3> n);

} // namespace slvm
