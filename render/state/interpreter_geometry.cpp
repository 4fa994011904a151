// Geometry requests: checks of arguments and variables, then one Primitive for each patch.
#include "render/state/interpreter.h"

#include "render/prims/patch_mesh.h"
#include "render/prims/patches.h"
#include "render/prims/quadrics.h"
#include "render/prims/teapot.h"
#include "render/prims/typed_vars.h"
#include "render/state/left_out.h"

#include <fmt/format.h>

#include <cmath>

namespace render {

namespace {

/// "Pz", the heights of a field, becomes "P": x and y run from 0 to 1 with u and v (RISpec 3.2, 5.3).
void expand_heights(int columns, std::vector<TypedParam>& vars) {
  for (TypedParam& v : vars) {
    if (v.declaration.name != "Pz" || v.declaration.type != slvm::Type::kFloat) continue;
    std::vector<float> heights = std::move(v.numbers);
    auto width = static_cast<size_t>(columns), rows = heights.size() / width;
    v.numbers.clear();
    for (size_t k = 0; k < heights.size(); ++k) {
      v.numbers.push_back(static_cast<float>(k % width) / static_cast<float>(width - 1));
      v.numbers.push_back(static_cast<float>(k / width) / static_cast<float>(rows - 1));
      v.numbers.push_back(heights[k]);
    }
    v.declaration.name = "P";
    v.declaration.type = slvm::Type::kPoint;
  }
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

std::optional<ClassSizes> Interpreter::sizes_of(const RequestCall& call) {
  SizesOfRequest r = class_sizes(call, {attributes_->ubasis.step, attributes_->vbasis.step});
  if (r.ok()) return r.sizes;
  error_at(r.argument < 0 ? call.where : call.arguments[static_cast<size_t>(r.argument)].where, call,
           r.error);
  return std::nullopt;
}

std::vector<TypedParam> Interpreter::primitive_vars(const RequestCall& call, const ClassSizes& sizes) {
  std::vector<TypedParam> out;
  for (const Param& p : call.params) {
    auto declared = declarations_.resolve(p.token);
    if (!declared) {
      error_at(p.where, call, declared.error(), RiError::kBadToken);
      continue;
    }
    const Declaration& d = *declared;
    if (d.mpoint && (call.id != RequestId::kBlobby || !interpolates(d.storage) || d.elements)) {
      error_at(
          p.where, call,
          fmt::format("\"{}\" is an mpoint: a Blobby has these, one vertex value for each leaf", d.name));
      continue;
    }
    bool text = d.type == slvm::Type::kString;
    size_t have = text ? p.strings.size() : p.numbers.size();
    size_t want = sizes.of(d.storage) * static_cast<size_t>(d.width());
    out.push_back({d, p.numbers, p.strings, p.where});
    TypedParam& v = out.back();
    if (have != want) {
      const std::string found =
          fmt::format("\"{}\" ({} {}) takes {} {}, found {}", d.name, storage_class_name(d.storage),
                      slvm::type_name(d.type), want, text ? "strings" : "numbers", have);
      if (have > want) {
        warn_at(p.where, call, found + "; those left over are not used");
        v.numbers.resize(text ? 0 : want);
        v.strings.resize(text ? want : 0);
      } else if (have == static_cast<size_t>(d.width()) && d.name[0] != 'P') {
        warn_at(p.where, call, found + "; this value holds all over the primitive");
        v.declaration.storage = StorageClass::kConstant;
      } else {
        error_at(p.where, call, found);
        out.pop_back();
        continue;
      }
    }
    if (text && interpolates(v.declaration.storage)) {
      error_at(p.where, call,
               fmt::format("\"{}\" is a string and cannot be {}", d.name, storage_class_name(d.storage)));
      out.pop_back();
    }
  }
  return out;
}

/// Takes P (or Pw) out of the variables. False, with a message: there is none.
bool Interpreter::take_positions(const RequestCall& call, std::vector<TypedParam>& vars, std::vector<Vec3>& P,
                                 bool all_finite) {
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
    for (Vec3 p : P)
      if (all_finite && (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))) {
        error(call, "a point is not finite; the primitive is skipped");
        return false;
      }
    return true;
  }
  // A wrong count was reported with the variable.
  if (!call.find_param("P") && !call.find_param("Pw") && !call.find_param("Pz"))
    error(call, "\"P\" is missing", RiError::kMissingData);
  return false;
}

/// `element`: "face", "curve".
void Interpreter::say_left_out(const RequestCall& call, int argument, std::string_view element,
                               const LeftOut& out) {
  if (out.count == 0) return;
  warn_at(call.arguments[static_cast<size_t>(argument)].where, call,
          fmt::format("{} of {} {}s cannot be drawn and {} left out; {} {}, counted from 0, {}", out.count,
                      out.all, element, out.count == 1 ? "is" : "are",
                      out.count == 1 ? element : fmt::format("the first, {}", element), out.first,
                      out.first_why));
}

float Interpreter::displacement_bound_of(const Attributes& a, const Matrix4& object_to_camera) const {
  if (!(a.displacement_sphere > 0)) return 0;
  Matrix4 m = object_to_camera;
  if (a.displacement_space == "shader" && a.displacement)
    m = a.displacement->shader_to_camera;
  else if (auto space = find_space(a.displacement_space); space && a.displacement_space != "object")
    m = *space;
  float longest = 0;
  for (Vec3 axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    longest = std::max(longest, glm::length(transform_vector(m, axis)));
  return a.displacement_sphere * longest;
}

std::shared_ptr<const PrimitiveState> Interpreter::primitive_state() {
  auto state = std::make_shared<PrimitiveState>();
  state->attributes = attributes_;
  state->object_to_camera = ctm_;
  state->motion = clip_to_shutter(motion_, scene_.options.shutter_open, scene_.options.shutter_close);
  state->camera_to_object = inverse_or_identity(ctm_);
  state->mirrored = slvm::determinant3(ctm_) < 0;
  state->displacement_bound = displacement_bound_of(*attributes_, ctm_);
  if (solid_.is_operand()) {
    state->solid = solid_.tree;
    state->solid_primitive = solid_.node;
  }
  state->level = attributes_->detail.part();
  return state;
}

bool is_primitive(RequestId id) {
  return id >= RequestId::kSphere && id <= RequestId::kGeometry && id != RequestId::kBasis &&
         id != RequestId::kTrimCurve;
}

/// A patch whose varying and vertex variables have four values.
void Interpreter::add_patch(std::shared_ptr<const Geometry> geometry, std::span<const TypedParam> vars) {
  Primitive primitive;
  primitive.state = primitive_state();
  primitive.geometry = std::move(geometry);
  for (const TypedParam& v : vars) {
    bool varies = interpolates(v.declaration.storage);
    primitive.vars.push_back(varies ? bilinear_var(v, {0, 1, 2, 3}) : constant_var(v, 0));
  }
  scene_.primitives.push_back(std::move(primitive));
}

void Interpreter::quadric(const RequestCall& call) {
  auto geometry = make_quadric(call);
  if (!geometry) { // what shrinks to nothing in an animation, and what programs write
    warn_once(fmt::format("empty {} {}", call.info().name, geometry.error()), call.where, "rib",
              fmt::format("{}: {}; nothing is drawn, here and wherever it is so", call.info().name,
                          geometry.error()));
    return;
  }
  std::vector<TypedParam> vars = primitive_vars(call, {});
  add_patch(*geometry, vars);
}

/// A patch is a mesh of one.
void Interpreter::patch(const RequestCall& call) {
  auto sizes = sizes_of(call);
  if (!sizes) return;
  bool mesh = call.id == RequestId::kPatchMesh;
  MeshDirection d[2];
  for (int side = 0; side < 2; ++side) {
    d[side].cubic = call.text(0) == "bicubic";
    d[side].points = d[side].order();
    d[side].basis = side == 0 ? attributes_->ubasis : attributes_->vbasis;
    if (!mesh) continue;
    d[side].periodic = call.text(2 + 2 * side) == "periodic";
    d[side].points = call.integer(1 + 2 * side);
    if (!d[side].even())
      warn(call, fmt::format("{} is {}, which steps of {} do not divide; the points left over are not used",
                             side == 0 ? "nu" : "nv", d[side].points, d[side].step()));
  }
  std::vector<TypedParam> vars = primitive_vars(call, *sizes);
  std::vector<float> weights = point_weights(vars);
  std::vector<Vec3> P;
  expand_heights(d[0].points, vars);
  if (!take_positions(call, vars, P)) return;
  add_patch_mesh(d[0], d[1], P, vars, primitive_state(), scene_.primitives, weights);
}

void Interpreter::geometry(const RequestCall& call) {
  if (call.text(0) != "teapot") {
    error_at(call.arguments[0].where, call,
             fmt::format("unknown geometry \"{}\"; known is \"teapot\"", call.text(0)));
    return;
  }
  std::vector<TypedParam> vars = primitive_vars(call, *sizes_of(call));
  auto state = primitive_state();
  MeshDirection side;
  for (const auto& patch : teapot_patches())
    add_patch_mesh(side, side, patch, vars, state, scene_.primitives);
}

} // namespace render
