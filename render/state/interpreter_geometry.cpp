// Geometry requests: checks of arguments and variables, then one Primitive for each patch.
#include "render/state/interpreter.h"

#include "render/prims/patches.h"
#include "render/prims/polygons.h"
#include "render/prims/quadrics.h"

#include <fmt/format.h>

#include <cmath>

namespace render {

namespace {

size_t class_size(const ClassSizes& sizes, StorageClass c) {
  switch (c) {
  case StorageClass::kConstant: return 1;
  case StorageClass::kUniform: return sizes.uniform;
  case StorageClass::kVarying: return sizes.varying;
  case StorageClass::kVertex: return sizes.vertex;
  case StorageClass::kFaceVarying: return sizes.facevarying;
  }
  return 1;
}

bool interpolates(StorageClass c) {
  return c != StorageClass::kConstant && c != StorageClass::kUniform;
}

GeometryResult make_quadric(const RequestCall& c) {
  switch (c.id) {
  case RequestId::kSphere: return make_sphere(c.number(0), c.number(1), c.number(2), c.number(3));
  case RequestId::kCone: return make_cone(c.number(0), c.number(1), c.number(2));
  case RequestId::kCylinder: return make_cylinder(c.number(0), c.number(1), c.number(2), c.number(3));
  case RequestId::kHyperboloid:
    return make_hyperboloid({c.number(0), c.number(1), c.number(2)}, {c.number(3), c.number(4), c.number(5)},
                            c.number(6));
  case RequestId::kParaboloid: return make_paraboloid(c.number(0), c.number(1), c.number(2), c.number(3));
  case RequestId::kDisk: return make_disk(c.number(0), c.number(1), c.number(2));
  default: return make_torus(c.number(0), c.number(1), c.number(2), c.number(3), c.number(4));
  }
}

} // namespace

std::vector<TypedParam> Interpreter::primitive_vars(const RequestCall& call, const ClassSizes& sizes) {
  std::vector<TypedParam> out;
  for (const Param& p : call.params) {
    auto declared = declarations_.resolve(p.token);
    if (!declared) {
      error_at(p.where, call, declared.error());
      continue;
    }
    const Declaration& d = *declared;
    bool text = d.type == slvm::Type::kString;
    size_t have = text ? p.strings.size() : p.numbers.size();
    size_t want = class_size(sizes, d.storage) * static_cast<size_t>(d.width());
    if (have != want) {
      error_at(p.where, call,
               fmt::format("\"{}\" ({} {}) takes {} {}, found {}", d.name, storage_class_name(d.storage),
                           slvm::type_name(d.type), want, text ? "strings" : "numbers", have));
      continue;
    }
    if (text && interpolates(d.storage)) {
      error_at(p.where, call,
               fmt::format("\"{}\" is a string and cannot be {}", d.name, storage_class_name(d.storage)));
      continue;
    }
    out.push_back({d, p.numbers, p.strings, p.where});
  }
  return out;
}

/// Takes P (or Pw) out of the variables. False, with a message: there is none.
bool Interpreter::take_positions(const RequestCall& call, std::vector<TypedParam>& vars,
                                 std::vector<Vec3>& P) {
  for (size_t i = 0; i < vars.size(); ++i) {
    const Declaration& d = vars[i].declaration;
    bool weighted = d.name == "Pw" && d.hpoint;
    if (!weighted && !(d.name == "P" && d.type == slvm::Type::kPoint)) continue;
    const std::vector<float>& n = vars[i].numbers;
    for (size_t k = 0; k < n.size(); k += weighted ? 4 : 3) {
      float w = weighted ? n[k + 3] : 1;
      P.emplace_back(n[k] / w, n[k + 1] / w, n[k + 2] / w);
    }
    vars.erase(vars.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
  }
  // A wrong count was reported with the variable.
  if (!call.find_param("P") && !call.find_param("Pw")) error(call, "\"P\" is missing");
  return false;
}

std::shared_ptr<const PrimitiveState> Interpreter::primitive_state() {
  auto state = std::make_shared<PrimitiveState>();
  state->attributes = attributes_;
  state->object_to_camera = ctm_;
  state->motion = clip_to_shutter(motion_, scene_.options.shutter_open, scene_.options.shutter_close);
  state->camera_to_object = inverse_or_identity(ctm_);
  state->mirrored = slvm::determinant3(ctm_) < 0;
  if (attributes_->displacement_sphere > 0) {
    const std::string& name = attributes_->displacement_space;
    const auto& displacement = attributes_->displacement;
    Matrix4 m = ctm_;
    if (name == "shader" && displacement)
      m = displacement->shader_to_camera;
    else if (auto space = find_space(name))
      m = *space;
    float longest = 0;
    for (Vec3 axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      longest = std::max(longest, glm::length(transform_vector(m, axis)));
    state->displacement_bound = attributes_->displacement_sphere * longest;
  }
  return state;
}

bool is_primitive(RequestId id) {
  return id >= RequestId::kSphere && id <= RequestId::kGeometry && id != RequestId::kBasis &&
         id != RequestId::kTrimCurve;
}

/// A patch whose varying and vertex variables have four values.
void Interpreter::add_patch(std::shared_ptr<const Geometry> geometry, std::span<const TypedParam> vars) {
  Primitive& primitive = scene_.primitives.emplace_back();
  primitive.state = primitive_state();
  primitive.geometry = std::move(geometry);
  for (const TypedParam& v : vars) {
    bool varies = interpolates(v.declaration.storage);
    primitive.vars.push_back(varies ? bilinear_var(v, {0, 1, 2, 3}) : constant_var(v, 0));
  }
}

void Interpreter::quadric(const RequestCall& call) {
  auto geometry = make_quadric(call);
  if (!geometry) {
    error(call, geometry.error());
    return;
  }
  std::vector<TypedParam> vars = primitive_vars(call, {});
  add_patch(*geometry, vars);
}

void Interpreter::patch(const RequestCall& call) {
  bool cubic = call.text(0) == "bicubic";
  if (!cubic && call.text(0) != "bilinear") {
    error_at(call.arguments[0].where, call,
             fmt::format("unknown type \"{}\"; expected \"bilinear\" or \"bicubic\"", call.text(0)));
    return;
  }
  size_t points = cubic ? 16 : 4;
  std::vector<TypedParam> vars = primitive_vars(call, {1, 4, points, 4});
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  if (!cubic) {
    add_patch(make_bilinear({P[0], P[1], P[2], P[3]}), vars);
    return;
  }
  const CubicBasis &ubasis = attributes_->ubasis, &vbasis = attributes_->vbasis;
  std::array<Vec3, 16> control;
  std::copy_n(P.begin(), 16, control.begin());
  for (int c = 0; c < 3; ++c)
    convert_to_bezier(ubasis, vbasis, &control[0][c], 3);
  std::vector<TypedParam> simple;
  std::vector<PatchVar> vertex;
  for (const TypedParam& v : vars) {
    if (v.declaration.storage != StorageClass::kVertex) {
      simple.push_back(v);
      continue;
    }
    PatchVar var = constant_var(v, 0);
    size_t width = var.width();
    for (size_t i = 1; i < 16; ++i) {
      PatchVar next = constant_var(v, i);
      var.values.insert(var.values.end(), next.values.begin(), next.values.end());
    }
    for (size_t c = 0; c < width; ++c)
      convert_to_bezier(ubasis, vbasis, &var.values[c], width);
    var.interpolation = Interpolation::kBicubic;
    vertex.push_back(std::move(var));
  }
  add_patch(make_bicubic(control), simple);
  auto& all = scene_.primitives.back().vars;
  all.insert(all.end(), vertex.begin(), vertex.end());
}

void Interpreter::polygon(const RequestCall& call) {
  const Param* p = call.find_param("P");
  size_t n = p ? p->numbers.size() / 3 : 0;
  if (!p && (p = call.find_param("Pw"))) n = p->numbers.size() / 4;
  std::vector<TypedParam> vars = primitive_vars(call, {1, n, n, n});
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  if (n < 3) {
    error(call, fmt::format("a polygon has at least 3 vertices, found {}", n));
    return;
  }
  std::vector<int> vertices(n);
  for (size_t i = 0; i < n; ++i)
    vertices[i] = static_cast<int>(i);
  add_polygon({vertices, 0, 0}, P, vars, primitive_state(), scene_.primitives);
}

void Interpreter::points_polygons(const RequestCall& call) {
  auto counts = call.integers(0), vertices = call.integers(1);
  size_t corners = 0;
  for (int n : counts) {
    if (n < 3) {
      error_at(call.arguments[0].where, call, fmt::format("a polygon has at least 3 vertices, found {}", n));
      return;
    }
    corners += static_cast<size_t>(n);
  }
  if (corners != vertices.size()) {
    error_at(call.arguments[1].where, call,
             fmt::format("'nvertices' asks for {} vertex numbers, found {}", corners, vertices.size()));
    return;
  }
  int last = -1;
  for (int v : vertices) {
    if (v < 0) {
      error_at(call.arguments[1].where, call, fmt::format("{} is not a vertex number; these start at 0", v));
      return;
    }
    last = std::max(last, v);
  }
  size_t points = static_cast<size_t>(last) + 1;
  // Files often carry more points than the faces use: P decides, if it has enough.
  if (const Param* p = call.find_param("P"); p && p->numbers.size() / 3 > points)
    points = p->numbers.size() / 3;
  std::vector<TypedParam> vars = primitive_vars(call, {counts.size(), points, points, corners});
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  auto state = primitive_state();
  size_t first = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    auto n = static_cast<size_t>(counts[i]);
    add_polygon({vertices.subspan(first, n), i, first}, P, vars, state, scene_.primitives);
    first += n;
  }
}

} // namespace render
