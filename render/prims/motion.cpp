// Interpolation of matrices and shapes in time.
#include "render/prims/motion.h"

#include <algorithm>

namespace render {

namespace {

Matrix4 blend(const Matrix4& a, const Matrix4& b, float weight) {
  Matrix4 out;
  for (size_t i = 0; i < 16; ++i)
    out.m[i] = a.m[i] + (b.m[i] - a.m[i]) * weight;
  return out;
}

/// Halfway, or any other part of the way, between two surfaces with the same parameters.
class BlendedGeometry : public Geometry {
public:
  BlendedGeometry(std::shared_ptr<const Geometry> a, std::shared_ptr<const Geometry> b, float weight)
      : a_(std::move(a)), b_(std::move(b)), weight_(weight) {}

  Box bound(const UvRect& rect) const override {
    Box box = a_->bound(rect);
    box.add(b_->bound(rect));
    return box;
  }
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override {
    SurfaceLattice other;
    a_->evaluate(at, out);
    b_->evaluate(at, other);
    auto blend = [&](Vec3Planes& to, const Vec3Planes& from) {
      for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < to.size(); ++k)
          to.plane(c)[k] += (from.plane(c)[k] - to.plane(c)[k]) * weight_;
    };
    blend(out.P, other.P);
    blend(out.dPdu, other.dPdu);
    blend(out.dPdv, other.dPdv);
    blend(out.N, other.N);
  }
  bool ruled() const override { return a_->ruled() && b_->ruled(); }
  std::array<int, 2> coarsest() const override {
    const std::array<int, 2> a = a_->coarsest(), b = b_->coarsest();
    return {std::max(a[0], b[0]), std::max(a[1], b[1])};
  }

private:
  std::shared_ptr<const Geometry> a_, b_;
  float weight_;
};

template <class T, class At>
std::vector<TimedValue<T>> clipped(const std::vector<TimedValue<T>>& keys, float open, float close, At&& at) {
  std::vector<TimedValue<T>> out;
  if (keys.size() < 2 || !(close > open) || keys.front().time >= close || keys.back().time <= open)
    return out;
  out.push_back({0, at(keys, open)});
  for (const auto& key : keys)
    if (key.time > open && key.time < close) out.push_back({(key.time - open) / (close - open), key.value});
  out.push_back({1, at(keys, close)});
  return out;
}

} // namespace

Matrix4 matrix_at(const MotionMatrices& keys, float time) {
  auto [first, weight] = find_key(keys, time);
  return weight == 0 ? keys[first].value : blend(keys[first].value, keys[first + 1].value, weight);
}

std::shared_ptr<const Geometry> shape_at(const MotionShapes& keys, float time) {
  auto [first, weight] = find_key(keys, time);
  if (weight == 0) return keys[first].value;
  return std::make_shared<BlendedGeometry>(keys[first].value, keys[first + 1].value, weight);
}

MotionMatrices clip_to_shutter(const MotionMatrices& keys, float open, float close) {
  return clipped(keys, open, close, matrix_at);
}

MotionShapes clip_to_shutter(const MotionShapes& keys, float open, float close) {
  return clipped(keys, open, close, shape_at);
}

namespace {

/// A run of surfaces of the first shape, and what they become.
class DeformingPieces final : public Pieces {
public:
  using Shapes = std::vector<TimedValue<PrimitiveList>>;

  DeformingPieces(std::shared_ptr<const Shapes> shapes, uint32_t first, uint32_t count, float open,
                  float close)
      : shapes_(std::move(shapes)), first_(first), count_(count), open_(open), close_(close),
        deforms_(!clip_to_shutter(keys(0), open, close).empty()) {}
  uint32_t count() const override { return count_; }
  Primitive piece(uint32_t k) const override {
    const MotionShapes keys = this->keys(k);
    Primitive p = shapes_->front().value[first_ + k];
    p.geometry = shape_at(keys, open_);
    p.deformation = clip_to_shutter(keys, open_, close_);
    return p;
  }
  bool deforms() const override { return deforms_; }

private:
  MotionShapes keys(uint32_t k) const {
    MotionShapes out;
    for (const auto& shape : *shapes_)
      out.push_back({shape.time, shape.value[first_ + k].geometry});
    return out;
  }

  std::shared_ptr<const Shapes> shapes_;
  uint32_t first_, count_;
  float open_, close_;
  bool deforms_;
};

} // namespace

void add_deforming(std::vector<TimedValue<PrimitiveList>> shapes, float open, float close,
                   PrimitiveList& out) {
  auto all = std::make_shared<const DeformingPieces::Shapes>(std::move(shapes));
  for (const PrimitiveList::Run& r : all->front().value.runs())
    out.add(r.state, std::make_shared<DeformingPieces>(all, r.first, r.count, open, close));
}

std::vector<float> motion_times(const Primitive& primitive) {
  std::vector<float> out;
  for (const auto& key : primitive.state->motion)
    out.push_back(key.time);
  for (const auto& key : primitive.deformation)
    out.push_back(key.time);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Primitive primitive_at(const Primitive& primitive, float time) {
  Primitive out = primitive;
  if (!primitive.deformation.empty()) out.geometry = shape_at(primitive.deformation, time);
  out.deformation.clear();
  if (primitive.state->motion.empty()) return out;
  auto state = std::make_shared<PrimitiveState>(*primitive.state);
  state->object_to_camera = matrix_at(primitive.state->motion, time);
  state->camera_to_object = inverse_or_identity(state->object_to_camera);
  state->motion.clear();
  out.state = std::move(state);
  return out;
}

} // namespace render
