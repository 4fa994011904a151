// Triples of numbers, a plane for each component: what loops in vectors read.
#pragma once

#include "render/state/math.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace render {

/// For vectors whose values are written before they are read.
template <class T> struct Uninitialized : std::allocator<T> {
  template <class U> struct rebind { using other = Uninitialized<U>; };
  template <class U> void construct(U* at) noexcept { ::new (static_cast<void*>(at)) U; }
};

/// Any number of triples. Each plane is at least kPadding longer; what is there is of no consequence.
class Vec3Planes {
public:
  static constexpr size_t kPadding = 16;

  Vec3Planes() = default;
  /// Of no particular values.
  explicit Vec3Planes(size_t size) { resize(size); }
  Vec3Planes(size_t size, const Vec3& all) : Vec3Planes(size) {
    for (size_t c = 0; c < 3; ++c)
      std::fill_n(plane(c), size, all[static_cast<glm::length_t>(c)]);
  }

  bool empty() const { return size_ == 0; }
  size_t size() const { return size_; }
  /// What there was is lost.
  void resize(size_t size) {
    size_ = size;
    if (size + kPadding <= pitch_) return;
    pitch_ = size + kPadding;
    values_.resize(3 * pitch_);
  }
  /// Adds those of `more` at the end.
  void append(const Vec3Planes& more);

  float* plane(size_t component) { return values_.data() + component * pitch_; }
  const float* plane(size_t component) const { return values_.data() + component * pitch_; }
  Vec3 operator[](size_t k) const {
    const float* at = values_.data() + k;
    return {at[0], at[pitch_], at[2 * pitch_]};
  }
  void set(size_t k, const Vec3& v) {
    float* at = values_.data() + k;
    at[0] = v.x;
    at[pitch_] = v.y;
    at[2 * pitch_] = v.z;
  }

  friend bool operator==(const Vec3Planes& a, const Vec3Planes& b) {
    if (a.size() != b.size()) return false;
    for (size_t c = 0; c < 3; ++c)
      if (!std::equal(a.plane(c), a.plane(c) + a.size(), b.plane(c))) return false;
    return true;
  }

private:
  size_t size_ = 0, pitch_ = 0;
  std::vector<float, Uninitialized<float>> values_;
};

inline void Vec3Planes::append(const Vec3Planes& more) {
  const size_t before = size_, size = before + more.size();
  if (size + kPadding > pitch_) {
    Vec3Planes larger(std::max(size, 2 * before));
    for (size_t c = 0; c < 3; ++c)
      std::copy_n(plane(c), before, larger.plane(c));
    *this = std::move(larger);
  }
  size_ = size;
  for (size_t c = 0; c < 3; ++c)
    std::copy_n(more.plane(c), more.size(), plane(c) + before);
}

} // namespace render
