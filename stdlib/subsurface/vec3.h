// Three floats: points, normals and linear colours of the subsurface library. Which it is, and in which
// space, says the name of the variable.
#pragma once

#include <cmath>

namespace subsurface {

struct Vec3 {
  float x = 0, y = 0, z = 0;

  float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  float& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  bool operator==(const Vec3&) const = default;

  Vec3& operator+=(Vec3 b) { return x += b.x, y += b.y, z += b.z, *this; }
  Vec3& operator*=(float s) { return x *= s, y *= s, z *= s, *this; }
};

/// Linear red, green and blue.
using Color = Vec3;

inline Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(Vec3 a) {
  return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(Vec3 a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline Vec3 operator*(float s, Vec3 a) {
  return a * s;
}
/// By component.
inline Vec3 operator*(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline float dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length2(Vec3 a) {
  return dot(a, a);
}
inline float length(Vec3 a) {
  return std::sqrt(length2(a));
}
/// Unit length; the zero vector stays zero.
inline Vec3 normalize(Vec3 a) {
  const float l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{};
}
inline bool is_finite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Two unit vectors at right angles to the unit vector n and to each other, with cross(u, v) = n. Without a
/// seam where n meets an axis (Duff et al., "Building an Orthonormal Basis, Revisited", 2017).
struct Frame {
  Vec3 u, v, n;

  explicit Frame(Vec3 unit) : n(unit) {
    const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    v = {b, sign + n.y * n.y * a, -n.y};
  }
  Vec3 to_world(Vec3 local) const { return u * local.x + v * local.y + n * local.z; }
};

} // namespace subsurface
