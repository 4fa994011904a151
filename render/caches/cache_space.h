// The space that a cache is kept in, which is not that of the frame: an object takes what is kept in its own
// space with it.
#pragma once

#include "render/rays/hemisphere_sample.h"

namespace render {

class CacheSpace {
public:
  /// From "current". `to` must not be singular.
  explicit CacheSpace(const Matrix4& to);

  Vec3 point_to(Vec3 p) const { return transform_point(to_, p); }
  /// Length 1.
  Vec3 normal_to(Vec3 n) const { return glm::normalize(times_transposed(from_, n)); }
  /// A length in any direction; exact where the space is scaled alike in all.
  float length_to(float x) const { return x * scale_; }
  HemisphereSample sample_to(const HemisphereSample& s) const { return moved(s, to_, from_, scale_); }
  HemisphereSample sample_from(const HemisphereSample& s) const { return moved(s, from_, to_, 1 / scale_); }

private:
  static Vec3 times_transposed(const Matrix4& m, Vec3 v);
  static HemisphereSample moved(const HemisphereSample& s, const Matrix4& m, const Matrix4& back,
                                float scale);

  Matrix4 to_, from_;
  float scale_ = 1;
};

} // namespace render
