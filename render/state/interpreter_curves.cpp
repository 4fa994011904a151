// What has no surface of its own: Curves, Points, Blobby.
#include "render/prims/blobby.h"
#include "render/prims/curves.h"
#include "render/state/interpreter.h"
#include "render/state/left_out.h"
#include "render/texture/find_image.h"

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
  std::vector<int> counts(call.integers(1).begin(), call.integers(1).end());
  std::vector<TypedParam> vars = primitive_vars(call, *sizes);
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P, false)) return;
  say_left_out(call, 1, "curve", leave_out_bad_curves(layout, counts, P, vars));
  auto state = primitive_state();
  add_curves(layout, counts, std::move(P), std::move(vars), eye_in_object(options_, *state), state,
             scene_.primitives);
}

void Interpreter::points(const RequestCall& call) {
  std::vector<TypedParam> vars = primitive_vars(call, *sizes_of(call));
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  auto state = primitive_state();
  add_points(std::move(P), std::move(vars), eye_in_object(options_, *state), state, scene_.primitives);
}

/// The depth image that a ground of a Blobby names. Null, with a message: it cannot be had.
std::shared_ptr<const BlobbyGround> Interpreter::blobby_ground(const RequestCall& call, int string) {
  auto names = call.texts(3);
  auto fail = [&](std::string_view text) {
    error_at(call.arguments[3].where, call, fmt::format("{}; the ground has no effect", text));
    return nullptr;
  };
  if (string < 0 || static_cast<size_t>(string) >= names.size())
    return fail(fmt::format("a ground has the file {} of {}", string, names.size()));
  const std::string& name = names[static_cast<size_t>(string)];
  auto found = find_image(name, scene_.options.search_paths["texture"]);
  DepthImage image;
  std::string problem = found ? read_depth_image(*found, image) : "no such file in the texture search path";
  if (problem.empty() && (image.world_to_camera.empty() || image.world_to_screen.empty()))
    problem = "the image does not say where its camera was; expected a shadow map or z image";
  if (!problem.empty()) return fail(fmt::format("\"{}\": {}", name, problem));
  return std::make_shared<BlobbyGround>(std::move(image), ctm_ * inverse_or_identity(scene_.world_to_camera));
}

namespace {

/// About the side of a micropolygon in object space, where the part of `bound` that is nearest to the camera
/// is; 0 where that is behind the near plane.
float micropolygon_in_object(const Box& bound, const PrimitiveState& state, const Options& options) {
  Camera camera(options);
  Box box = transform_box(state.object_to_camera, bound);
  for (const auto& key : state.motion)
    box.add(transform_box(key.value, bound));
  if (camera.perspective() && !(box.min.z > camera.near_plane())) return 0;
  Vec2 here = camera.project({0, 0, box.min.z});
  float pixels = std::max(glm::distance(here, camera.project({1, 0, box.min.z})),
                          glm::distance(here, camera.project({0, 1, box.min.z})));
  float longest = 0; // that a unit of object space is in camera space
  for (Vec3 axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    longest = std::max(longest, glm::length(transform_vector(state.object_to_camera, axis)));
  float side = std::sqrt(state.attributes->shading_rate) / (pixels * longest);
  return side < kInfinity ? side : 0;
}

} // namespace

void Interpreter::blobby(const RequestCall& call) {
  const auto codes = options_.named.find("blobby:codes");
  const bool note = codes != options_.named.end() && codes->second.strings[0] == "note31";
  const auto field = BlobbyField::make(
      call.integers(1), call.numbers(2),
      [&](const std::string& text) { warn_at(call.arguments[1].where, call, text); },
      [&](int string) { return blobby_ground(call, string); },
      note ? BlobbyField::Codes::kNote31 : BlobbyField::Codes::kSpecification);
  size_t leaves = field.leaves();
  if (call.integer(0) < 0 || static_cast<size_t>(call.integer(0)) != leaves)
    warn(call,
         fmt::format("'nleaf' is {}, but the code has {} leaves, and that counts", call.integer(0), leaves));
  std::vector<TypedParam> vars = primitive_vars(call, {1, leaves, leaves, leaves});
  auto state = primitive_state();
  // Quadrilaterals of two micropolygons a side, with smooth normals, show no corners.
  float wanted =
      field.bound().empty() ? 0 : 2 * micropolygon_in_object(field.bound(), *state, scene_.options);
  add_blobby(field, wanted, vars, state, scene_.primitives);
}

} // namespace render
