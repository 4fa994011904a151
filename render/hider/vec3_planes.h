// Triples of numbers, a plane for each component: what loops in vectors read.
#pragma once

#include "render/state/math.h"

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

/// Any number of triples. Each plane is kPadding longer; what is there is of no consequence.
class Vec3Planes {
public:
  static constexpr size_t kPadding = 16;

  Vec3Planes() = default;
  /// Of no particular values.
  explicit Vec3Planes(size_t size) : size_(size), values_(3 * pitch()) {}
  Vec3Planes(size_t size, const Vec3& all) : Vec3Planes(size) {
    for (size_t k = 0; k < size; ++k)
      set(k, all);
  }

  bool empty() const { return size_ == 0; }
  size_t size() const { return size_; }
  float* plane(size_t component) { return values_.data() + component * pitch(); }
  const float* plane(size_t component) const { return values_.data() + component * pitch(); }
  Vec3 operator[](size_t k) const {
    const float* at = values_.data() + k;
    return {at[0], at[pitch()], at[2 * pitch()]};
  }
  void set(size_t k, const Vec3& v) {
    for (size_t c = 0; c < 3; ++c)
      plane(c)[k] = v[static_cast<glm::length_t>(c)];
  }

private:
  size_t pitch() const { return size_ + kPadding; }

  size_t size_ = 0;
  std::vector<float, Uninitialized<float>> values_;
};

} // namespace render
