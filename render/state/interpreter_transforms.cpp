// Transformation requests. The current transformation always leads to camera space.
#include "render/state/interpreter.h"

#include "render/state/camera.h"
#include "render/state/transforms.h"

#include <fmt/format.h>

namespace render {

void Interpreter::identity(const RequestCall&) {
  ctm_ = in_world_ ? scene_.world_to_camera : Matrix4{};
}

void Interpreter::transform(const RequestCall& call) {
  Matrix4 m = matrix_from(call.numbers(0));
  ctm_ = in_world_ ? m * scene_.world_to_camera : m;
}

void Interpreter::concat_transform(const RequestCall& call) {
  ctm_ = matrix_from(call.numbers(0)) * ctm_;
}

void Interpreter::perspective(const RequestCall& call) {
  float fov = call.number(0);
  if (fov > 0 && fov < 180)
    ctm_ = perspective_transform(fov) * ctm_;
  else
    error(call, "the field of view must be between 0 and 180 degrees");
}

void Interpreter::translate(const RequestCall& call) {
  ctm_ = translation({call.number(0), call.number(1), call.number(2)}) * ctm_;
}

void Interpreter::rotate(const RequestCall& call) {
  Vec3 axis(call.number(1), call.number(2), call.number(3));
  if (!(glm::length(axis) > 0)) error(call, "the axis has no length; nothing is rotated");
  ctm_ = rotation(call.number(0), axis) * ctm_;
}

void Interpreter::scale(const RequestCall& call) {
  Vec3 by(call.number(0), call.number(1), call.number(2));
  if (by.x == 0 || by.y == 0 || by.z == 0) warn(call, "a factor is zero: everything that follows is flat");
  ctm_ = scaling(by) * ctm_;
}

void Interpreter::skew(const RequestCall& call) {
  auto m = render::skew(call.number(0), {call.number(1), call.number(2), call.number(3)},
                        {call.number(4), call.number(5), call.number(6)});
  if (m)
    ctm_ = *m * ctm_;
  else
    error(call,
          "the angle must be smaller than the angle between the two axes, and these must not be parallel");
}

void Interpreter::coordinate_system(const RequestCall& call) {
  spaces_[call.text(0)] = ctm_;
}

void Interpreter::scoped_coordinate_system(const RequestCall& call) {
  edit().scoped_spaces[call.text(0)] = ctm_;
}

std::optional<Matrix4> Interpreter::find_space(const std::string& name) const {
  if (auto it = attributes_->scoped_spaces.find(name); it != attributes_->scoped_spaces.end())
    return it->second;
  if (auto it = spaces_.find(name); it != spaces_.end()) return it->second;
  if (name == "camera" || name == "current") return Matrix4{};
  if (name == "object") return ctm_;
  if (name == "world") return in_world_ ? scene_.world_to_camera : ctm_;
  Camera camera(in_world_ ? scene_.options : options_);
  if (name == "screen") return inverse_or_identity(camera.to_screen());
  if (name == "NDC") return inverse_or_identity(camera.to_ndc());
  if (name == "raster") return inverse_or_identity(camera.to_raster());
  return {};
}

void Interpreter::coord_sys_transform(const RequestCall& call) {
  if (auto m = find_space(call.text(0)))
    ctm_ = *m;
  else
    error_at(call.arguments[0].where, call, fmt::format("no coordinate system is named \"{}\"", call.text(0)),
             RiError::kBadToken);
}

} // namespace render
