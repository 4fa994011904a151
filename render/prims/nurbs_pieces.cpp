// NuPatch to pieces.
#include "render/prims/nurbs_pieces.h"

#include "render/prims/typed_vars.h"

namespace render {

namespace {

PatchVar piece_var(const TypedParam& source, const NurbsPiece& piece) {
  StorageClass storage = source.declaration.storage;
  const NurbsSurface& s = *piece.surface;
  bool whole = piece.uinterval < 0;
  if (storage == StorageClass::kConstant) return constant_var(source, 0);
  if (storage == StorageClass::kUniform && (!whole || source.declaration.type == slvm::Type::kString))
    return constant_var(source,
                        whole ? 0 : static_cast<size_t>(piece.vinterval * s.u.intervals() + piece.uinterval));
  PatchVar var = var_head(source);
  var.interpolation = Interpolation::kSurface;
  std::vector<float> values;
  for (size_t i = 0, n = source.numbers.size() / static_cast<size_t>(source.declaration.width()); i < n; ++i)
    append_value(source, i, values);
  var.surface =
      storage == StorageClass::kVertex
          ? make_nurbs_vertex_var(piece, std::move(values), var.width())
          : make_nurbs_corner_var(piece, std::move(values), var.width(), storage == StorageClass::kUniform);
  return var;
}

PatchVar corner_parameter(std::string_view name, int axis, const NurbsPiece& piece) {
  PatchVar var;
  var.name = name;
  var.interpolation = Interpolation::kBilinear;
  for (glm::dvec2 c : piece.corners)
    var.values.push_back(static_cast<float>(c[axis]));
  return var;
}

} // namespace

void add_nurbs(const std::shared_ptr<const NurbsSurface>& surface, const std::vector<UvQuad>* quads,
               std::span<const TypedParam> vars, const std::shared_ptr<const PrimitiveState>& state,
               PrimitiveList& out) {
  std::vector<Primitive> made;
  auto add = [&](const NurbsPiece& piece) -> Primitive& {
    Primitive& primitive = made.emplace_back();
    primitive.geometry = make_nurbs(piece);
    for (const TypedParam& v : vars)
      primitive.vars.push_back(piece_var(v, piece));
    return primitive;
  };
  if (quads) {
    for (const UvQuad& q : *quads) {
      NurbsPiece piece{surface, {q[0], q[1], q[2], q[3]}};
      Primitive& primitive = add(piece);
      primitive.vars.push_back(corner_parameter("u", 0, piece));
      primitive.vars.push_back(corner_parameter("v", 1, piece));
    }
    return out.add(state, std::move(made));
  }
  const NurbsBasis &u = surface->u, &v = surface->v;
  for (int j = 0; j < v.intervals(); ++j)
    for (int i = 0; i < u.intervals(); ++i) {
      double u0 = std::max(0.0, u.knot(i)), u1 = std::min(1.0, u.knot(i + 1)), v0 = std::max(0.0, v.knot(j)),
             v1 = std::min(1.0, v.knot(j + 1));
      if (u0 >= u1 || v0 >= v1) continue;
      Primitive& primitive = add({surface, {{u0, v0}, {u1, v0}, {u0, v1}, {u1, v1}}, i, j});
      primitive.uv = {static_cast<float>(u0), static_cast<float>(u1), static_cast<float>(v0),
                      static_cast<float>(v1)};
    }
  out.add(state, std::move(made));
}

} // namespace render
