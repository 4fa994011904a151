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
  CurveLayout layout;
  layout.cubic = call.text(0) == "cubic";
  if (!layout.cubic && call.text(0) != "linear") {
    error_at(call.arguments[0].where, call,
             fmt::format("unknown type \"{}\"; expected \"linear\" or \"cubic\"", call.text(0)));
    return;
  }
  layout.periodic = wraps(call, 2);
  layout.basis = attributes_->vbasis;
  std::span<const int> counts = call.integers(1);
  size_t points = 0, corners = 0;
  for (int n : counts) {
    if (n < layout.fewest()) {
      error_at(call.arguments[1].where, call,
               fmt::format("a {} curve has at least {} points, found {}", call.text(0), layout.fewest(), n));
      return;
    }
    points += static_cast<size_t>(n);
    corners += static_cast<size_t>(layout.varying(n));
  }
  std::vector<TypedParam> vars = primitive_vars(call, {counts.size(), corners, points, corners});
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  auto state = primitive_state();
  add_curves(layout, counts, P, vars, eye_in_object(options_, *state), state, scene_.primitives);
}

void Interpreter::points(const RequestCall& call) {
  const Param* p = call.find_param("P");
  size_t n = p ? p->numbers.size() / 3 : 0;
  std::vector<TypedParam> vars = primitive_vars(call, {1, n, n, n});
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
  size_t leaves = field->leaves();
  std::vector<TypedParam> vars = primitive_vars(call, {1, leaves, leaves, leaves});
  add_blobby(*field, vars, primitive_state(), scene_.primitives);
}

} // namespace render
