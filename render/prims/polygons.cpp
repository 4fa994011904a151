// Polygons to bilinear patches.
#include "render/prims/polygons.h"

#include "render/prims/patches.h"
#include "render/prims/typed_vars.h"

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

/// Weights of the face's corners at the four corners of sub-patch `k`, in the order (0,0), (1,0), (0,1),
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
PatchVar mix_corners(const CornerVar& corners, const std::vector<float> (&weights)[4]) {
  PatchVar var = corners.head;
  var.interpolation = Interpolation::kBilinear;
  for (const auto& w : weights)
    for (size_t c = 0; c < corners.width; ++c) {
      float sum = 0;
      for (size_t i = 0; i < w.size(); ++i)
        if (w[i] != 0) sum += w[i] * corners.values[i * corners.width + c];
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

  size_t n = face.vertices.size();
  std::vector<float> weights[4];
  for (size_t k = 0; k < (n == 4 ? 1 : n); ++k) {
    sub_patch_weights(n, k, weights);
    PatchVar p = mix_corners(positions, weights);
    std::array<Vec3, 4> points;
    for (size_t i = 0; i < 4; ++i)
      points[i] = {p.values[3 * i], p.values[3 * i + 1], p.values[3 * i + 2]};
    Primitive& primitive = out.emplace_back();
    primitive.state = state;
    primitive.geometry = make_bilinear(points);
    primitive.vars = constants;
    for (const CornerVar& c : corners)
      primitive.vars.push_back(mix_corners(c, weights));
  }
}

} // namespace render
