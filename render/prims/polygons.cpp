// Polygons to bilinear patches.
#include "render/prims/polygons.h"

#include "render/prims/patches.h"
#include "render/prims/triangulate.h"
#include "render/prims/typed_vars.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace render {

namespace {

/// A face: its part of the vertex numbers, and of the loops.
struct Face {
  std::span<const int> vertices, loops;
};

/// The face seen along the axis nearest to its normal (Newell's), so that no coordinate is rounded.
std::vector<glm::dvec2> flattened(const Face& face, std::span<const Vec3> P) {
  auto point = [&](size_t i) { return glm::dvec3(P[static_cast<size_t>(face.vertices[i])]); };
  auto n = static_cast<size_t>(face.loops[0]);
  glm::dvec3 normal(0.0);
  for (size_t i = 0; i < n; ++i)
    normal += glm::cross(point(i) - point(0), point((i + 1) % n) - point(0));
  glm::dvec3 size = glm::abs(normal);
  int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  std::vector<glm::dvec2> out;
  for (size_t i = 0; i < face.vertices.size(); ++i) {
    glm::dvec3 p = point(i);
    out.emplace_back(p[(drop + 1) % 3], p[(drop + 2) % 3]);
  }
  return out;
}

/// Whether every corner turns the way the whole outline does, give or take rounding.
bool is_convex(std::span<const glm::dvec2> loop) {
  double area = loop_area(loop), slack = 1e-6 * std::abs(area);
  for (size_t i = 0, n = loop.size(); i < n; ++i) {
    glm::dvec2 a = loop[(i + 1) % n] - loop[i], b = loop[(i + 2) % n] - loop[(i + 1) % n];
    double turn = a.x * b.y - a.y * b.x;
    if (area > 0 ? turn < -slack : turn > slack) return false;
  }
  return true;
}

/// Patches of a convex part with n corners.
size_t patches_of(size_t n) {
  return n <= 4 ? 1 : n;
}

/// Of a corner of the unit square, in the order (0,0), (1,0), (0,1), (1,1): that of the polygon which is
/// there.
constexpr size_t kOfTriangle[] = {0, 1, 2, 2}, kOfQuadrilateral[] = {0, 1, 3, 2};

class PolygonMesh;

/// One patch of a mesh.
class PolygonPatch final : public Geometry {
public:
  PolygonPatch(const PolygonMesh& mesh, uint32_t face, uint32_t part, uint32_t turn)
      : mesh_(&mesh), face_(face), part_(part & kMostParts), turn_(turn & 3) {}
  Box bound(const UvRect& r) const override { return patch().bound(r); }
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override { patch().evaluate(at, out); }
  void find_points(const UvPoints& at, SurfaceLattice& out) const override { patch().find_points(at, out); }
  bool ruled() const override { return true; }
  uint32_t face() const { return face_; }
  uint32_t part() const { return part_; }
  uint32_t turn() const { return turn_; }

private:
  static constexpr uint32_t kMostParts = (1u << 30) - 1;
  BilinearPatch patch() const;

  const PolygonMesh* mesh_;
  uint32_t face_;
  uint32_t part_ : 30; ///< which patch of the face
  uint32_t turn_ : 2;  ///< of a triangle: the corner it begins with
};

class PolygonMesh final : public VarSource {
public:
  PolygonMesh(PolygonFaces faces, std::vector<Vec3> P, std::vector<TypedParam> vars);

  std::span<const PolygonPatch> patches() const { return patches_; }
  std::array<Vec3, 4> points(const PolygonPatch& patch) const;
  size_t count() const override { return vars_.size() + (default_st_ ? 1 : 0); }
  bool differs_by_piece() const override { return differs_; }
  PatchVar make(size_t var, uint32_t piece) const override;

private:
  /// Corners of the convex part of a face that a patch belongs to.
  struct Part {
    size_t n = 0;                  ///< corners
    size_t patch = 0;              ///< of its patches
    size_t first = 0;              ///< corner 0 among all corners of the mesh
    const Triangle* cut = nullptr; ///< which corners of the face, if it was cut
    size_t turn = 0;               ///< of a triangle
    size_t corner(size_t i) const {
      if (n == 3) i = (i + turn) % 3;
      return first + (cut ? static_cast<size_t>((*cut)[i]) : i);
    }
  };
  Part part(const PolygonPatch& patch) const { return part(patch.face(), patch.part(), patch.turn()); }
  Part part(uint32_t face, uint32_t part, uint32_t turn) const;
  void add_face(uint32_t face, const Face& corners);
  uint32_t shortest_side(const Part& triangle) const;
  size_t vertex(size_t corner) const { return static_cast<size_t>(vertices_[corner]); }

  /// Calls add(corner, weight) for what makes up corner `q` of a patch, in the order (0,0), (1,0), (0,1),
  /// (1,1). 0.5 a + 0.5 b is the same float in either order, so the middle of a shared side is the same point
  /// in both faces.
  template <class Add> static void mix(const Part& p, size_t q, Add&& add) {
    if (p.n <= 4) {
      add(p.corner(p.n == 3 ? kOfTriangle[q] : kOfQuadrilateral[q]), 1.0f);
    } else if (q == 0) {
      add(p.corner(p.patch), 1.0f);
    } else if (q == 3) {
      for (size_t i = 0; i < p.n; ++i)
        add(p.corner(i), 1 / static_cast<float>(p.n));
    } else {
      add(p.corner(p.patch), 0.5f);
      add(p.corner((p.patch + (q == 1 ? 1 : p.n - 1)) % p.n), 0.5f);
    }
  }

  std::vector<int> vertices_;
  std::vector<uint32_t> first_corner_;                      ///< of each face, and the end
  std::unordered_map<uint32_t, std::vector<Triangle>> cut_; ///< faces that are not convex
  std::vector<Vec3> P_;
  std::vector<TypedParam> vars_;
  bool default_st_ = true, turns_, differs_;
  std::vector<PolygonPatch> patches_;
};

BilinearPatch PolygonPatch::patch() const {
  return BilinearPatch(mesh_->points(*this));
}

PolygonMesh::PolygonMesh(PolygonFaces faces, std::vector<Vec3> P, std::vector<TypedParam> vars)
    : vertices_(std::move(faces.vertices)), P_(std::move(P)), vars_(std::move(vars)),
      turns_(!faces.one_of_several), differs_(has_own(vars_, StorageClass::kUniform)) {
  std::stable_partition(vars_.begin(), vars_.end(),
                        [](const TypedParam& v) { return !interpolates(v.declaration.storage); });
  for (const TypedParam& v : vars_)
    if (v.declaration.name == "s" || v.declaration.name == "t" || v.declaration.name == "st")
      default_st_ = false;
  size_t count = faces.loops_of_face.empty() ? faces.loops.size() : faces.loops_of_face.size();
  first_corner_.reserve(count + 1);
  first_corner_.push_back(0);
  patches_.reserve(count);
  size_t loop = 0, first = 0;
  for (size_t f = 0; f < count; ++f) {
    size_t loops = faces.loops_of_face.empty() ? 1 : static_cast<size_t>(faces.loops_of_face[f]), n = 0;
    std::span<const int> own(faces.loops.data() + loop, loops);
    for (int corners : own)
      n += static_cast<size_t>(corners);
    first_corner_.push_back(static_cast<uint32_t>(first + n));
    add_face(static_cast<uint32_t>(f), {std::span<const int>(vertices_).subspan(first, n), own});
    first += n;
    loop += loops;
  }
}

void PolygonMesh::add_face(uint32_t f, const Face& face) {
  size_t n = face.vertices.size(), patches = patches_of(n);
  bool holes = face.loops.size() > 1;
  if (n < 3) return; // a point or an edge
  if (n != 3 || holes) {
    std::vector<glm::dvec2> flat = flattened(face, P_);
    if (holes || !is_convex(flat)) {
      std::vector<Triangle> cut = triangulate(flat, face.loops);
      n = 3;
      patches = cut.size();
      cut_.emplace(f, std::move(cut));
    }
  }
  for (uint32_t i = 0; i < patches; ++i)
    patches_.emplace_back(*this, f, i, n == 3 && turns_ ? shortest_side(part(f, i, 0)) : 0);
}

PolygonMesh::Part PolygonMesh::part(uint32_t face, uint32_t part, uint32_t turn) const {
  size_t first = first_corner_[face];
  if (auto it = cut_.empty() ? cut_.end() : cut_.find(face); it != cut_.end())
    return {3, 0, first, &it->second[part], turn};
  return {first_corner_[face + 1] - first, part, first, nullptr, turn};
}

/// The corner it begins at.
uint32_t PolygonMesh::shortest_side(const Part& triangle) const {
  float length[3];
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 side = P_[vertex(triangle.corner((i + 1) % 3))] - P_[vertex(triangle.corner(i))];
    length[i] = glm::dot(side, side);
  }
  return static_cast<uint32_t>(std::min_element(length, length + 3) - length);
}

std::array<Vec3, 4> PolygonMesh::points(const PolygonPatch& patch) const {
  Part p = part(patch);
  std::array<Vec3, 4> out;
  for (size_t q = 0; q < 4; ++q) {
    Vec3 sum(0.0f);
    mix(p, q, [&](size_t corner, float weight) { sum += weight * P_[vertex(corner)]; });
    out[q] = sum;
  }
  return out;
}

PatchVar PolygonMesh::make(size_t index, uint32_t piece) const {
  const PolygonPatch& patch = patches_[piece];
  Part p = part(patch);
  if (index == vars_.size()) {
    PatchVar st{"st", slvm::Type::kFloat, 2, Interpolation::kBilinear, {}, {}};
    for (Vec3 point : points(patch)) {
      st.values.push_back(point.x);
      st.values.push_back(point.y);
    }
    return st;
  }
  const TypedParam& source = vars_[index];
  StorageClass storage = source.declaration.storage;
  if (!interpolates(storage))
    return constant_var(source, storage == StorageClass::kUniform ? patch.face() : 0);
  PatchVar var = var_head(source);
  var.interpolation = Interpolation::kBilinear;
  std::vector<float> value;
  for (size_t q = 0; q < 4; ++q) {
    size_t at = var.values.size();
    var.values.resize(at + var.width());
    mix(p, q, [&](size_t corner, float weight) {
      value.clear();
      append_value(source, storage == StorageClass::kFaceVarying ? corner : vertex(corner), value);
      for (size_t c = 0; c < value.size(); ++c)
        var.values[at + c] += weight * value[c];
    });
  }
  return var;
}

} // namespace

std::shared_ptr<const Pieces> make_polygons(PolygonFaces faces, std::vector<Vec3> P,
                                            std::vector<TypedParam> vars) {
  return pieces_of(std::make_shared<PolygonMesh>(std::move(faces), std::move(P), std::move(vars)));
}

} // namespace render
