// Polygons to bilinear patches.
#include "render/prims/polygons.h"

#include "render/prims/patches.h"
#include "render/prims/triangulate.h"
#include "render/prims/typed_vars.h"

#include <glm/common.hpp>

#include <cmath>
#include <numeric>

namespace render {

namespace {

/// All values at the corners of one face, corner by corner, `width` floats each.
struct CornerVar {
  PatchVar head;
  size_t width = 0;
  std::vector<float> values;
};

CornerVar corner_values(const TypedParam& source, const PolygonFace& face) {
  CornerVar out{var_head(source), 0, {}};
  out.width = out.head.width();
  for (size_t i = 0; i < face.vertices.size(); ++i) {
    bool per_corner = source.declaration.storage == StorageClass::kFaceVarying;
    append_value(source, per_corner ? face.first_corner + i : static_cast<size_t>(face.vertices[i]),
                 out.values);
  }
  return out;
}

/// A convex part of a face: which of its corners.
using Piece = std::vector<size_t>;

/// The face seen along the axis nearest to its normal (Newell's), so that no coordinate is rounded.
std::vector<glm::dvec2> flattened(const PolygonFace& face, std::span<const Vec3> P) {
  auto point = [&](size_t i) { return glm::dvec3(P[static_cast<size_t>(face.vertices[i])]); };
  size_t n = face.loops.empty() ? face.vertices.size() : static_cast<size_t>(face.loops[0]);
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

std::vector<Piece> convex_pieces(const PolygonFace& face, std::span<const Vec3> P) {
  bool holes = face.loops.size() > 1;
  Piece all(face.vertices.size());
  std::iota(all.begin(), all.end(), size_t{0});
  if (all.size() == 3 && !holes) return {all};
  std::vector<glm::dvec2> flat = flattened(face, P);
  if (!holes && is_convex(flat)) return {all};
  int whole = static_cast<int>(all.size());
  std::vector<Piece> out;
  for (const Triangle& t : triangulate(flat, holes ? face.loops : std::span<const int>(&whole, 1)))
    out.push_back({static_cast<size_t>(t[0]), static_cast<size_t>(t[1]), static_cast<size_t>(t[2])});
  return out;
}

/// Weights of a piece's corners at the four corners of sub-patch `k`, in the order (0,0), (1,0), (0,1),
/// (1,1).
void sub_patch_weights(size_t n, size_t k, std::vector<float> (&weights)[4]) {
  for (auto& w : weights)
    w.assign(n, 0.0f);
  if (n == 4) {
    weights[0][0] = weights[1][1] = weights[2][3] = weights[3][2] = 1;
    return;
  }
  weights[0][k] = 1;
  weights[1][k] = weights[1][(k + 1) % n] = 0.5f;
  weights[2][k] = weights[2][(k + n - 1) % n] = 0.5f;
  weights[3].assign(n, 1 / static_cast<float>(n));
}

/// 0.5 a + 0.5 b is the same float in either order, so the middle of a shared side is the same point in both
/// faces.
PatchVar mix_corners(const CornerVar& corners, const Piece& piece, const std::vector<float> (&weights)[4]) {
  PatchVar var = corners.head;
  var.interpolation = Interpolation::kBilinear;
  for (const auto& w : weights)
    for (size_t c = 0; c < corners.width; ++c) {
      float sum = 0;
      for (size_t i = 0; i < w.size(); ++i)
        if (w[i] != 0) sum += w[i] * corners.values[piece[i] * corners.width + c];
      var.values.push_back(sum);
    }
  return var;
}

CornerVar corner_points(std::string_view name, const PolygonFace& face, std::span<const Vec3> P,
                        size_t width) {
  CornerVar out;
  out.head.name = name;
  out.head.type = width == 3 ? slvm::Type::kPoint : slvm::Type::kFloat;
  out.head.elements = width == 3 ? 0 : 2;
  out.width = width;
  for (int v : face.vertices)
    for (size_t c = 0; c < width; ++c)
      out.values.push_back(P[static_cast<size_t>(v)][static_cast<int>(c)]);
  return out;
}

} // namespace

void add_polygon(const PolygonFace& face, std::span<const Vec3> P, std::span<const TypedParam> vars,
                 const std::shared_ptr<const PrimitiveState>& state, std::vector<Primitive>& out) {
  std::vector<PatchVar> constants;
  std::vector<CornerVar> corners;
  bool has_st = false;
  for (const TypedParam& var : vars) {
    const Declaration& d = var.declaration;
    has_st = has_st || d.name == "s" || d.name == "t" || d.name == "st";
    if (d.storage == StorageClass::kConstant)
      constants.push_back(constant_var(var, 0));
    else if (d.storage == StorageClass::kUniform)
      constants.push_back(constant_var(var, face.index));
    else
      corners.push_back(corner_values(var, face));
  }
  if (!has_st) corners.push_back(corner_points("st", face, P, 2));
  CornerVar positions = corner_points("P", face, P, 3);

  std::vector<float> weights[4];
  for (const Piece& piece : convex_pieces(face, P))
    for (size_t k = 0; k < (piece.size() == 4 ? 1 : piece.size()); ++k) {
      sub_patch_weights(piece.size(), k, weights);
      PatchVar p = mix_corners(positions, piece, weights);
      std::array<Vec3, 4> points;
      for (size_t i = 0; i < 4; ++i)
        points[i] = {p.values[3 * i], p.values[3 * i + 1], p.values[3 * i + 2]};
      Primitive& primitive = out.emplace_back();
      primitive.state = state;
      primitive.geometry = make_bilinear(points);
      primitive.vars = constants;
      for (const CornerVar& c : corners)
        primitive.vars.push_back(mix_corners(c, piece, weights));
    }
}

} // namespace render
