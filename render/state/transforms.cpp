// Matrices of the transformation requests.
#include "render/state/transforms.h"

#include <cmath>

namespace render {

Matrix4 translation(Vec3 by) {
  Matrix4 m;
  m.m[12] = by.x;
  m.m[13] = by.y;
  m.m[14] = by.z;
  return m;
}

Matrix4 scaling(Vec3 by) {
  Matrix4 m;
  m.m[0] = by.x;
  m.m[5] = by.y;
  m.m[10] = by.z;
  return m;
}

Matrix4 rotation(float angle, Vec3 axis) {
  float length = glm::length(axis);
  if (!(length > 0)) return {};
  Vec3 k = axis / length;
  float c = std::cos(radians(angle)), s = std::sin(radians(angle));
  // v' = v cos a + (k x v) sin a + k (k.v)(1 - cos a), applied to the three basis vectors.
  Matrix4 m;
  for (int row = 0; row < 3; ++row) {
    Vec3 e(0.0f);
    e[row] = 1;
    Vec3 r = e * c + glm::cross(k, e) * s + k * (k[row] * (1 - c));
    for (int column = 0; column < 3; ++column)
      m(row, column) = r[column];
  }
  return m;
}

std::optional<Matrix4> skew(float angle, Vec3 d1, Vec3 d2) {
  if (!(glm::length(d1) > 0) || !(glm::length(d2) > 0)) return {};
  Vec3 a = glm::normalize(d1), b = glm::normalize(d2);
  float between = std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
  float turn = radians(angle);
  if (turn >= between || turn <= between - kPi) return {};
  // In the plane of d1 and d2: along = the part of d1 across d2. A point at height h over the d2 axis is
  // shifted by h (cot(between - turn) - cot(between)) along d2.
  Vec3 across = a - b * glm::dot(a, b);
  float height = glm::length(across);
  if (!(height > 0)) return {};
  across /= height;
  float shift = 1 / std::tan(between - turn) - 1 / std::tan(between);
  Matrix4 m;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      m(row, column) += across[row] * shift * b[column];
  return m;
}

Matrix4 perspective_transform(float fov) {
  float t = std::tan(radians(fov) / 2);
  Matrix4 m = scaling({1 / t, 1 / t, 1});
  m(2, 3) = 1;
  m(3, 3) = 0;
  // z' = z - 1, w = z: depth order is kept in front of the eye.
  m(3, 2) = -1;
  return m;
}

Matrix4 matrix_from(std::span<const float> sixteen) {
  Matrix4 m;
  std::copy_n(sixteen.begin(), 16, m.m.begin());
  return m;
}

} // namespace render
