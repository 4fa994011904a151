// Patch meshes.
#include "render/prims/patch_mesh.h"

#include "render/prims/nurbs.h"
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

/// A rational patch is a NURBS of one knot interval. Null: a weight of its Bezier form is not positive.
std::shared_ptr<const Geometry> rational_geometry(std::span<const Vec3> P, std::span<const float> weights,
                                                  const MeshPatch& patch, const MeshDirection& u,
                                                  const MeshDirection& v) {
  std::vector<size_t> indices;
  if (u.cubic)
    for (size_t i : patch.bicubic_points())
      indices.push_back(i);
  else
    for (size_t i : patch.bilinear_points())
      indices.push_back(i);
  std::vector<glm::vec4> control;
  for (size_t i : indices)
    control.emplace_back(P[i] * weights[i], weights[i]);
  for (int c = 0; u.cubic && c < 4; ++c)
    convert_to_bezier(u.basis, v.basis, &control[0][c], 4);
  int order = u.order();
  constexpr float kKnots[] = {0, 0, 0, 0, 1, 1, 1, 1};
  std::span<const float> knots(kKnots + 4 - order, static_cast<size_t>(2 * order));
  auto basis = NurbsBasis::make(order, order, knots, 0, 1, "u");
  auto surface = std::make_shared<NurbsSurface>();
  surface->u = surface->v = *basis;
  for (glm::vec4 p : control) {
    if (!(p.w > 0)) return nullptr;
    surface->points.emplace_back(p);
  }
  return make_nurbs({surface, {{0, 0}, {1, 0}, {0, 1}, {1, 1}}, 0, 0});
}

} // namespace

void add_patch_mesh(const MeshDirection& u, const MeshDirection& v, std::span<const Vec3> P,
                    std::span<const TypedParam> vars, const std::shared_ptr<const PrimitiveState>& state,
                    std::vector<Primitive>& out, std::span<const float> weights) {
  bool rational = std::any_of(weights.begin(), weights.end(), [&](float w) { return w != weights[0]; });
  for (int j = 0; j < v.patches(); ++j)
    for (int i = 0; i < u.patches(); ++i) {
      MeshPatch patch(u, v, i, j);
      Primitive& primitive = out.emplace_back();
      primitive.state = state;
      if (rational) primitive.geometry = rational_geometry(P, weights, patch, u, v);
      if (!primitive.geometry) primitive.geometry = patch_geometry(P, patch, u, v);
      primitive.uv = patch.uv();
      for (const TypedParam& var : vars)
        primitive.vars.push_back(patch_var(var, patch, u, v));
    }
}

} // namespace render
