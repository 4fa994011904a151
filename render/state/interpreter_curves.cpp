// What has no surface of its own: Curves, Points, Blobby.
#include "render/prims/blobby.h"
#include "render/prims/curves.h"
#include "render/state/interpreter.h"

#include <fmt/format.h>

namespace render {

namespace {

EyeInObject eye_in_object(const Options& options, const PrimitiveState& state) {
  EyeInObject eye;
  eye.point = options.projection == ProjectionKind::kPerspective;
  eye.where = eye.point ? transform_point(state.camera_to_object, Vec3(0.0f))
                        : transform_vector(state.camera_to_object, Vec3(0, 0, -1));
  return eye;
}

} // namespace

void Interpreter::curves(const RequestCall& call) {
  auto sizes = sizes_of(call);
  if (!sizes) return;
  CurveLayout layout;
  layout.cubic = call.text(0) == "cubic";
  layout.periodic = call.text(2) == "periodic";
  layout.basis = attributes_->vbasis;
  std::span<const int> counts = call.integers(1);
  std::vector<TypedParam> vars = primitive_vars(call, *sizes);
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  auto state = primitive_state();
  add_curves(layout, counts, P, vars, eye_in_object(options_, *state), state, scene_.primitives);
}

void Interpreter::points(const RequestCall& call) {
  std::vector<TypedParam> vars = primitive_vars(call, *sizes_of(call));
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  auto state = primitive_state();
  add_points(P, vars, eye_in_object(options_, *state), state, scene_.primitives);
}

void Interpreter::blobby(const RequestCall& call) {
  auto field = BlobbyField::make(call.integer(0), call.integers(1), call.numbers(2));
  if (!field) {
    error(call, field.error());
    return;
  }
  if (field->has_planes())
    warn_once("Blobby plane", call.where, "rib-unsupported",
              "Blobby: planes that repel (code 1003) have no effect");
  std::vector<TypedParam> vars = primitive_vars(call, *sizes_of(call));
  add_blobby(*field, vars, primitive_state(), scene_.primitives);
}

} // namespace render
