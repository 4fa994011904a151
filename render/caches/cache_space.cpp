#include "render/caches/cache_space.h"

#include <cmath>

namespace render {

CacheSpace::CacheSpace(const Matrix4& to)
    : to_(to), from_(inverse_or_identity(to)), scale_(std::cbrt(std::abs(slvm::determinant3(to)))) {}

/// What gradients and normals are to be multiplied by, when points are by the inverse of m.
Vec3 CacheSpace::times_transposed(const Matrix4& m, Vec3 v) {
  auto row = [&](int i) { return m(i, 0) * v.x + m(i, 1) * v.y + m(i, 2) * v.z; };
  return {row(0), row(1), row(2)};
}

HemisphereSample CacheSpace::moved(const HemisphereSample& s, const Matrix4& m, const Matrix4& back,
                                   float scale) {
  HemisphereSample out = s;
  for (size_t c = 0; c < HemisphereSample::kGradients; ++c) {
    out.move[c] = times_transposed(back, s.move[c]);
    // Turns are about axes: lengths do not count, and a mirror turns them round.
    out.turn[c] = times_transposed(back, s.turn[c]) * std::copysign(scale, slvm::determinant3(m));
  }
  const Vec3 direction = transform_vector(m, Vec3(s.value[7], s.value[8], s.value[9])) / scale;
  for (int c = 0; c < 3; ++c)
    out.value[static_cast<size_t>(7 + c)] = direction[c];
  out.distance = s.distance * scale;
  return out;
}

} // namespace render
