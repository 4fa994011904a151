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

class MeshOfPatches;

/// Patch (i, j) of a mesh that is not rational.
class MeshPiece final : public Geometry {
public:
  MeshPiece(const MeshOfPatches& mesh, int i, int j) : mesh_(&mesh), i_(i), j_(j) {}
  Box bound(const UvRect& r) const override;
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override;
  void find_points(const UvPoints& at, SurfaceLattice& out) const override;
  bool ruled() const override;
  int i() const { return i_; }
  int j() const { return j_; }

private:
  const MeshOfPatches* mesh_;
  int i_, j_;
};

class MeshOfPatches final : public VarSource {
public:
  MeshOfPatches(const MeshDirection& u, const MeshDirection& v, std::span<const Vec3> P,
                std::span<const TypedParam> vars)
      : u_(u), v_(v), P_(P.begin(), P.end()), vars_(vars.begin(), vars.end()),
        u_to_bezier_(to_bezier(u.basis)), v_to_bezier_(to_bezier(v.basis)),
        differs_(has_own(vars, StorageClass::kUniform)) {
    patches_.reserve(static_cast<size_t>(u.patches()) * static_cast<size_t>(v.patches()));
    for (int j = 0; j < v.patches(); ++j)
      for (int i = 0; i < u.patches(); ++i)
        patches_.emplace_back(*this, i, j);
  }

  std::span<const MeshPiece> patches() const { return patches_; }
  MeshPatch patch(const MeshPiece& p) const { return {u_, v_, p.i(), p.j()}; }
  bool cubic() const { return u_.cubic; }
  BilinearPatch bilinear(const MeshPiece& piece) const {
    auto p = patch(piece).bilinear_points();
    return BilinearPatch({P_[p[0]], P_[p[1]], P_[p[2]], P_[p[3]]});
  }
  BicubicPatch bicubic(const MeshPiece& piece) const {
    auto indices = patch(piece).bicubic_points();
    std::array<Vec3, 16> control;
    for (size_t k = 0; k < 16; ++k)
      control[k] = P_[indices[k]];
    for (int c = 0; c < 3; ++c)
      convert_to_bezier(u_to_bezier_, v_to_bezier_, &control[0][c], 3);
    return BicubicPatch(control);
  }

  bool differs_by_piece() const override { return differs_; }
  size_t count() const override { return vars_.size(); }
  PatchVar make(size_t index, uint32_t piece) const override {
    const TypedParam& var = vars_[index];
    MeshPatch p = patch(patches_[piece]);
    switch (var.declaration.storage) {
    case StorageClass::kConstant: return constant_var(var, 0);
    case StorageClass::kUniform: return constant_var(var, p.index());
    case StorageClass::kVertex:
      return u_.cubic ? bicubic_var(var, p.bicubic_points(), u_.basis, v_.basis)
                      : bilinear_var(var, p.bilinear_points());
    case StorageClass::kVarying:
    case StorageClass::kFaceVarying: break;
    }
    return bilinear_var(var, p.corners());
  }

private:
  MeshDirection u_, v_;
  std::vector<Vec3> P_;
  std::vector<TypedParam> vars_;
  Matrix4 u_to_bezier_, v_to_bezier_;
  bool differs_;
  std::vector<MeshPiece> patches_;
};

Box MeshPiece::bound(const UvRect& r) const {
  return mesh_->cubic() ? mesh_->bicubic(*this).bound(r) : mesh_->bilinear(*this).bound(r);
}

void MeshPiece::evaluate(const UvPoints& at, SurfaceLattice& out) const {
  if (mesh_->cubic())
    mesh_->bicubic(*this).evaluate(at, out);
  else
    mesh_->bilinear(*this).evaluate(at, out);
}

void MeshPiece::find_points(const UvPoints& at, SurfaceLattice& out) const {
  if (mesh_->cubic())
    mesh_->bicubic(*this).find_points(at, out);
  else
    mesh_->bilinear(*this).find_points(at, out);
}

bool MeshPiece::ruled() const {
  return !mesh_->cubic();
}

} // namespace

void add_patch_mesh(const MeshDirection& u, const MeshDirection& v, std::span<const Vec3> P,
                    std::span<const TypedParam> vars, const std::shared_ptr<const PrimitiveState>& state,
                    PrimitiveList& out, std::span<const float> weights) {
  bool rational = std::any_of(weights.begin(), weights.end(), [&](float w) { return w != weights[0]; });
  auto mesh = std::make_shared<MeshOfPatches>(u, v, P, vars);
  std::vector<std::shared_ptr<const Geometry>> weighted; // null: its weights are all the same
  for (size_t k = 0; rational && k < mesh->patches().size(); ++k)
    weighted.push_back(rational_geometry(P, weights, mesh->patch(mesh->patches()[k]), u, v));
  out.add(state, pieces_of(mesh, [at = mesh.get(), weighted](uint32_t k, Primitive& primitive) {
            primitive.uv = at->patch(at->patches()[k]).uv();
            if (!weighted.empty() && weighted[k]) primitive.geometry = unowned(weighted[k].get());
          }));
}

} // namespace render
