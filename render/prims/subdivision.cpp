// Subdivision meshes.
#include "render/prims/subdivision.h"

#include "render/prims/limit_mesh.h"
#include "render/prims/patches.h"
#include "render/prims/typed_vars.h"

#include <algorithm>
#include <map>

namespace render {

namespace {

using Vec3d = glm::dvec3;

/// The part of a face that is a primitive: a quarter of the face from a corner to the centre, or all of it;
/// of a triangle always a third.
struct FacePart {
  FaceDomain domain;
  int quarter = -1;

  bool of_triangle() const { return domain.kind == FaceDomain::Kind::kTriangle; }
  /// The face's coordinates of (u,v) in the part.
  void locate(double u, double v, double (&out)[2]) const {
    out[0] = u;
    out[1] = v;
    if (quarter < 0) return;
    if (of_triangle()) {
      double q[4][2];
      corners_in_triangle(q);
      for (int c = 0; c < 2; ++c)
        out[c] = (q[0][c] * (1 - u) + q[1][c] * u) * (1 - v) + (q[2][c] * (1 - u) + q[3][c] * u) * v;
      return;
    }
    if (domain.kind == FaceDomain::Kind::kSubFaces) {
      const int row = quarter / domain.columns, column = quarter % domain.columns;
      out[0] = column + 0.5 * u;
      out[1] = row + 0.5 * v;
      return;
    }
    // Corner `quarter` of the unit square, turned so that u runs along the face's own edge.
    constexpr double kCorner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                     kAlong[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int c = 0; c < 2; ++c)
      out[c] = kCorner[quarter][c] + 0.5 * (u * kAlong[quarter][c] + v * kAlong[(quarter + 1) % 4][c]);
  }

private:
  /// A corner of the triangle, the middles of its two sides, the centre.
  void corners_in_triangle(double (&q)[4][2]) const {
    constexpr double kCorner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    for (int c = 0; c < 2; ++c) {
      double own = kCorner[quarter][c], next = kCorner[(quarter + 1) % 3][c],
             last = kCorner[(quarter + 2) % 3][c];
      q[0][c] = own;
      q[1][c] = 0.5 * (own + next);
      q[2][c] = 0.5 * (own + last);
      q[3][c] = 1 / 3.0;
    }
  }
};

using Surface = std::shared_ptr<const LimitSurface>;

/// Tangents of a part from those of its face.
struct Chain {
  double uu, uv, vu, vv; ///< d(face u, face v)/d(part u), the same for part v

  /// At a place of the part, along whose two axes the map from part to face is straight.
  Chain(const FacePart& part, double u, double v) {
    double o[2], x[2], y[2], z[2];
    part.locate(0.25, v, o);
    part.locate(0.75, v, x);
    part.locate(u, 0.25, y);
    part.locate(u, 0.75, z);
    uu = 2 * (x[0] - o[0]), uv = 2 * (x[1] - o[1]);
    vu = 2 * (z[0] - y[0]), vv = 2 * (z[1] - y[1]);
  }
};

/// The sixteen Bezier values of a part of a regular face, u fastest, from value, slopes and twist at its
/// corners.
std::vector<float> bezier_values(const LimitSurface& face, const FacePart& part) {
  auto width = static_cast<size_t>(face.width());
  std::vector<float> out(16 * width);
  std::vector<double> p(width), fu(width), fv(width), fuv(width);
  Chain chain(part, 0.5, 0.5);
  for (size_t j = 0; j < 2; ++j)
    for (size_t i = 0; i < 2; ++i) {
      double uv[2];
      part.locate(static_cast<double>(i), static_cast<double>(j), uv);
      face.at(uv, p.data(), fu.data(), fv.data(), fuv.data());
      double su = i == 0 ? 1 / 3.0 : -1 / 3.0, sv = j == 0 ? 1 / 3.0 : -1 / 3.0;
      for (size_t c = 0; c < width; ++c) {
        double du = fu[c] * chain.uu + fv[c] * chain.uv, dv = fu[c] * chain.vu + fv[c] * chain.vv;
        // Parts are scaled and turned by right angles: one of the two products of the chain is zero.
        double duv = fuv[c] * (chain.uu * chain.vv + chain.uv * chain.vu);
        auto set = [&](size_t k, size_t l, double value) {
          out[(4 * (j == 0 ? l : 3 - l) + (i == 0 ? k : 3 - k)) * width + c] = static_cast<float>(value);
        };
        set(0, 0, p[c]);
        set(1, 0, p[c] + su * du);
        set(0, 1, p[c] + sv * dv);
        set(1, 1, p[c] + su * du + sv * dv + su * sv * duv);
      }
    }
  return out;
}

/// A face near an extraordinary vertex, a sharp edge or the like.
class IrregularFace final : public Geometry {
public:
  IrregularFace(Surface face, const FacePart& part, int coarsest)
      : face_(std::move(face)), part_(part), coarsest_(coarsest) {
    const std::span<const double> points = face_->control_points();
    for (size_t i = 0; i < points.size(); i += 3)
      hull_.add(Vec3(Vec3d(points[i], points[i + 1], points[i + 2])));
  }

  std::array<int, 2> coarsest() const override { return {coarsest_, coarsest_}; }

  /// A lattice of points and room for what bulges between them, at most the hull of the control points.
  Box bound(const UvRect& r) const override {
    constexpr int kSteps = 4;
    Box box;
    for (int j = 0; j <= kSteps; ++j)
      for (int i = 0; i <= kSteps; ++i) {
        float u = r.u0 + (r.u1 - r.u0) * static_cast<float>(i) / kSteps,
              v = r.v0 + (r.v1 - r.v0) * static_cast<float>(j) / kSteps;
        double uv[2], p[3];
        part_.locate(u, v, uv);
        face_->at(uv, p);
        box.add(Vec3(Vec3d(p[0], p[1], p[2])));
      }
    box.grow(0.2f * glm::length(box.max - box.min));
    box.min = glm::max(box.min, hull_.min);
    box.max = glm::min(box.max, hull_.max);
    return box;
  }

  void evaluate(const UvPoints& at, SurfaceLattice& out) const override {
    out.resize(at.size());
    at.for_each([&](size_t k, float ui, float vj) {
      Vec3d p, du, dv;
      point(ui, vj, p, du, dv);
      out.P.set(k, Vec3(p));
      out.dPdu.set(k, Vec3(du));
      out.dPdv.set(k, Vec3(dv));
      Vec3d n = glm::cross(du, dv);
      if (glm::length(n) <= 1e-9 * (glm::dot(du, du) + glm::dot(dv, dv))) {
        // Tangents that vanish or fall together: the limit from inside.
        point(ui + (0.5 - ui) * 1e-4, vj + (0.5 - vj) * 1e-4, p, du, dv);
        n = glm::cross(du, dv);
      }
      double length = glm::length(n);
      out.N.set(k, length > 0 ? Vec3(n / length) : Vec3(0.0f));
    });
  }

private:
  void point(double u, double v, Vec3d& p, Vec3d& du, Vec3d& dv) const {
    double uv[2];
    Vec3d fu, fv;
    part_.locate(u, v, uv);
    face_->at(uv, &p.x, &fu.x, &fv.x);
    Chain chain(part_, u, v);
    du = fu * chain.uu + fv * chain.uv;
    dv = fu * chain.vu + fv * chain.vv;
  }

  Surface face_;
  FacePart part_;
  Box hull_;
  int coarsest_;
};

class FaceVar final : public VarSurface {
public:
  FaceVar(Surface face, const FacePart& part) : face_(std::move(face)), part_(part) {}
  void evaluate(float u, float v, std::span<float> out) const override {
    double uv[2];
    std::vector<double> value(out.size());
    part_.locate(u, v, uv);
    face_->at(uv, value.data());
    for (size_t c = 0; c < out.size(); ++c)
      out[c] = static_cast<float>(value[c]);
  }

private:
  Surface face_;
  FacePart part_;
};

/// A variable's values in the mesh.
struct MeshVar {
  const TypedParam* source = nullptr;
  PatchVar head;
  std::vector<double> values;
  std::vector<int> indices; ///< facevarying: the value of each corner
  int channel = -1;
};

/// Facevarying values come corner by corner. Where those at one vertex are equal, the faces join.
void join_corners(std::span<const int> vertices, MeshVar& var) {
  size_t width = var.head.width();
  std::map<std::pair<int, std::vector<double>>, int> known;
  std::vector<double> values;
  for (size_t c = 0; c < vertices.size(); ++c) {
    std::vector<double> value(var.values.begin() + static_cast<std::ptrdiff_t>(c * width),
                              var.values.begin() + static_cast<std::ptrdiff_t>((c + 1) * width));
    auto [it, fresh] = known.try_emplace({vertices[c], value}, static_cast<int>(known.size()));
    if (fresh) values.insert(values.end(), value.begin(), value.end());
    var.indices.push_back(it->second);
  }
  var.values = std::move(values);
}

class MeshBuilder {
public:
  MeshBuilder(const SubdivisionMesh& mesh, std::span<const Vec3> P, std::span<const TypedParam> vars)
      : mesh_(mesh), point_count_(P.size()) {
    for (Vec3 p : P)
      positions_.insert(positions_.end(), {p.x, p.y, p.z});
    for (const TypedParam& v : vars)
      add_var(v);
  }

  slvm::Result<std::vector<Primitive>> run() {
    if (mesh_.loop &&
        std::any_of(mesh_.nvertices.begin(), mesh_.nvertices.end(), [](int n) { return n != 3; }))
      return slvm::Error{"the scheme \"loop\" takes triangles only"};
    const SubdivisionModule& module = subdivision_module();
    if (!module.make) return slvm::Error{module.problem};
    const std::unique_ptr<const LimitMesh> limit = module.make(mesh_, point_count_, corner_values());
    if (!limit)
      return slvm::Error{
          "the faces do not make a mesh: one has too many corners, or a vertex too many edges"};
    bool all_quads = !mesh_.loop && std::all_of(mesh_.nvertices.begin(), mesh_.nvertices.end(),
                                                [](int n) { return n == 4; });
    std::vector<Primitive> made;
    for (size_t face = 0; face < mesh_.nvertices.size(); ++face) {
      const Surface surface =
          limit->surface(static_cast<int>(face), LimitMesh::Values::kVertex, positions_, 3, -1);
      if (!surface) continue;
      const std::vector<Surface> surfaces = var_surfaces(*limit, static_cast<int>(face));
      FacePart part{surface->domain()};
      // Neighbours must halve their common side alike: one face in quarters, all in quarters.
      const int parts = all_quads ? 1 : mesh_.nvertices[face];
      for (int q = 0; q < parts; ++q) {
        if (!all_quads) part.quarter = q;
        add(surface, part, surfaces, face, made);
      }
    }
    return made;
  }

private:
  void add_var(const TypedParam& source) {
    MeshVar& var = vars_.emplace_back();
    var.source = &source;
    var.head = var_head(source);
    StorageClass storage = source.declaration.storage;
    if (!interpolates(storage)) return;
    std::vector<float> values;
    for (size_t i = 0, n = source.numbers.size() / static_cast<size_t>(source.declaration.width()); i < n;
         ++i)
      append_value(source, i, values);
    var.values.assign(values.begin(), values.end());
    if (storage != StorageClass::kFaceVarying) return;
    join_corners(mesh_.vertices, var);
    var.channel = channels_++;
  }

  std::vector<CornerValues> corner_values() const {
    std::vector<CornerValues> out;
    for (const MeshVar& v : vars_)
      if (v.channel >= 0) out.push_back({static_cast<int>(v.values.size() / v.head.width()), v.indices});
    return out;
  }

  /// In the order of the variables; null for constant and uniform ones.
  std::vector<Surface> var_surfaces(const LimitMesh& limit, int face) const {
    std::vector<Surface> out;
    using Values = LimitMesh::Values;
    for (const MeshVar& v : vars_) {
      Surface& s = out.emplace_back();
      const StorageClass storage = v.source->declaration.storage;
      if (!interpolates(storage)) continue;
      const Values kind = storage == StorageClass::kVertex    ? Values::kVertex
                          : storage == StorageClass::kVarying ? Values::kVarying
                                                              : Values::kFaceVarying;
      s = limit.surface(face, kind, v.values, static_cast<int>(v.head.width()), v.channel);
    }
    return out;
  }

  /// The shape of a mesh of many faces is in its faces; few of them are curved much and cut like patches.
  int coarsest() const {
    constexpr size_t kMany = 128;
    return mesh_.nvertices.size() < kMany ? 4 : 1;
  }

  void add(const Surface& surface, const FacePart& part, const std::vector<Surface>& surfaces, size_t face,
           std::vector<Primitive>& out) const {
    Primitive& primitive = out.emplace_back();
    if (surface->polynomial()) {
      std::vector<float> b = bezier_values(*surface, part);
      std::array<Vec3, 16> points;
      for (size_t k = 0; k < 16; ++k)
        points[k] = {b[3 * k], b[3 * k + 1], b[3 * k + 2]};
      primitive.geometry = make_bicubic(points, coarsest());
    } else {
      primitive.geometry = std::make_shared<IrregularFace>(surface, part, coarsest());
    }
    for (size_t i = 0; i < vars_.size(); ++i) {
      const MeshVar& v = vars_[i];
      if (!interpolates(v.source->declaration.storage))
        primitive.vars.push_back(
            constant_var(*v.source, v.source->declaration.storage == StorageClass::kConstant ? 0 : face));
      else if (surfaces[i])
        primitive.vars.push_back(part_var(v.head, surfaces[i], part));
    }
  }

  static PatchVar part_var(PatchVar var, const Surface& surface, const FacePart& part) {
    if (surface->polynomial()) {
      var.interpolation = Interpolation::kBicubic;
      var.values = bezier_values(*surface, part);
      return var;
    }
    FaceVar values(surface, part);
    if (surface->linear()) {
      var.interpolation = Interpolation::kBilinear;
      std::vector<float> value(var.width());
      for (float v : {0.0f, 1.0f})
        for (float u : {0.0f, 1.0f}) {
          values.evaluate(u, v, value);
          var.values.insert(var.values.end(), value.begin(), value.end());
        }
      return var;
    }
    var.interpolation = Interpolation::kSurface;
    var.surface = std::make_shared<FaceVar>(values);
    return var;
  }

  const SubdivisionMesh& mesh_;
  size_t point_count_;
  std::vector<double> positions_;
  std::vector<MeshVar> vars_;
  int channels_ = 0;
};

} // namespace

slvm::Result<std::shared_ptr<const Pieces>>
make_subdivision(const SubdivisionMesh& mesh, std::span<const Vec3> P, std::span<const TypedParam> vars) {
  auto made = MeshBuilder(mesh, P, vars).run();
  if (!made) return slvm::Error{made.error()};
  return std::shared_ptr<const Pieces>(std::make_shared<ListedPieces>(std::move(*made)));
}

} // namespace render
