// Patch meshes.
#include "render/prims/patch_mesh.h"

#include "render/prims/patches.h"
#include "render/prims/typed_vars.h"

namespace render {

namespace {

/// Patch (i, j) of a mesh: which values of each class are its own.
class MeshPatch {
public:
  MeshPatch(const MeshDirection& u, const MeshDirection& v, int i, int j) : u_(u), v_(v), i_(i), j_(j) {}

  size_t index() const { return static_cast<size_t>(j_ * u_.patches() + i_); }
  /// Control point (k, l) of the patch.
  size_t point(int k, int l) const {
    int column = (i_ * u_.step() + k) % u_.points, row = (j_ * v_.step() + l) % v_.points;
    return static_cast<size_t>(row * u_.points + column);
  }
  std::array<size_t, 4> bilinear_points() const {
    return {point(0, 0), point(1, 0), point(0, 1), point(1, 1)};
  }
  std::array<size_t, 16> bicubic_points() const {
    std::array<size_t, 16> out;
    for (int l = 0; l < 4; ++l)
      for (int k = 0; k < 4; ++k)
        out[static_cast<size_t>(4 * l + k)] = point(k, l);
    return out;
  }
  std::array<size_t, 4> corners() const {
    auto at = [this](int k, int l) {
      return static_cast<size_t>(((j_ + l) % v_.corners()) * u_.corners() + (i_ + k) % u_.corners());
    };
    return {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
  }
  UvRect uv() const {
    auto part = [](int k, int n) { return static_cast<float>(k) / static_cast<float>(n); };
    return {part(i_, u_.patches()), part(i_ + 1, u_.patches()), part(j_, v_.patches()),
            part(j_ + 1, v_.patches())};
  }

private:
  const MeshDirection &u_, &v_;
  int i_, j_;
};

PatchVar patch_var(const TypedParam& var, const MeshPatch& patch, const MeshDirection& u,
                   const MeshDirection& v) {
  switch (var.declaration.storage) {
  case StorageClass::kConstant: return constant_var(var, 0);
  case StorageClass::kUniform: return constant_var(var, patch.index());
  case StorageClass::kVertex:
    return u.cubic ? bicubic_var(var, patch.bicubic_points(), u.basis, v.basis)
                   : bilinear_var(var, patch.bilinear_points());
  case StorageClass::kVarying:
  case StorageClass::kFaceVarying: break;
  }
  return bilinear_var(var, patch.corners());
}

std::shared_ptr<const Geometry> patch_geometry(std::span<const Vec3> P, const MeshPatch& patch,
                                               const MeshDirection& u, const MeshDirection& v) {
  if (!u.cubic) {
    auto p = patch.bilinear_points();
    return make_bilinear({P[p[0]], P[p[1]], P[p[2]], P[p[3]]});
  }
  auto indices = patch.bicubic_points();
  std::array<Vec3, 16> control;
  for (size_t k = 0; k < 16; ++k)
    control[k] = P[indices[k]];
  for (int c = 0; c < 3; ++c)
    convert_to_bezier(u.basis, v.basis, &control[0][c], 3);
  return make_bicubic(control);
}

} // namespace

void add_patch_mesh(const MeshDirection& u, const MeshDirection& v, std::span<const Vec3> P,
                    std::span<const TypedParam> vars, const std::shared_ptr<const PrimitiveState>& state,
                    std::vector<Primitive>& out) {
  for (int j = 0; j < v.patches(); ++j)
    for (int i = 0; i < u.patches(); ++i) {
      MeshPatch patch(u, v, i, j);
      Primitive& primitive = out.emplace_back();
      primitive.state = state;
      primitive.geometry = patch_geometry(P, patch, u, v);
      primitive.uv = patch.uv();
      for (const TypedParam& var : vars)
        primitive.vars.push_back(patch_var(var, patch, u, v));
    }
}

} // namespace render
