// Vectors, boxes and the few matrix helpers the renderer needs on top of slvm::Matrix4 (row vectors: p' = p *
// M).
#pragma once

#include "slvm/support/matrix.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>

namespace render {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Color = glm::vec3;
using slvm::Matrix4;

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kPi = 3.14159265358979323846f;

inline float radians(float degrees) {
  return degrees * (kPi / 180.0f);
}

/// slvm's functions, inline: they are called for every point there is.
inline Vec3 transform_point(const Matrix4& m, Vec3 p) {
  auto column = [&](int j) { return p.x * m(0, j) + p.y * m(1, j) + p.z * m(2, j) + m(3, j); };
  Vec3 out(column(0), column(1), column(2));
  float w = column(3);
  return w == 0 || w == 1 ? out : Vec3(out.x / w, out.y / w, out.z / w);
}
inline Vec3 transform_vector(const Matrix4& m, Vec3 v) {
  auto column = [&](int j) { return v.x * m(0, j) + v.y * m(1, j) + v.z * m(2, j); };
  return {column(0), column(1), column(2)};
}
inline bool is_affine(const Matrix4& m) {
  return m(0, 3) == 0 && m(1, 3) == 0 && m(2, 3) == 0 && m(3, 3) == 1;
}
/// The inverse, or the identity for a singular matrix (a scaling by zero in a scene must not stop the rest of
/// it).
inline Matrix4 inverse_or_identity(const Matrix4& m) {
  Matrix4 inverse;
  return slvm::invert(m, inverse) ? inverse : Matrix4{};
}

/// An axis-aligned box; empty when just made.
struct Box {
  Vec3 min{kInfinity};
  Vec3 max{-kInfinity};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void add(Vec3 p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void add(const Box& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  void grow(float by) {
    min -= by;
    max += by;
  }
  Vec3 corner(int i) const { return {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z}; }
};

/// The box of a box's eight transformed corners.
inline Box transform_box(const Matrix4& m, const Box& b) {
  Box out;
  if (is_affine(m)) { // the same, for the farthest corner is made of the farthest terms (Arvo, Graphics Gems)
    for (int c = 0; c < 3; ++c) {
      auto near = [&](int i) { return std::min(b.min[i] * m(i, c), b.max[i] * m(i, c)); };
      auto far = [&](int i) { return std::max(b.min[i] * m(i, c), b.max[i] * m(i, c)); };
      out.min[c] = near(0) + near(1) + near(2) + m(3, c);
      out.max[c] = far(0) + far(1) + far(2) + m(3, c);
    }
    return out;
  }
  for (int i = 0; i < 8; ++i)
    out.add(transform_point(m, b.corner(i)));
  return out;
}

} // namespace render
