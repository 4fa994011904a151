// Motion blocks: the requests inside are carried out once for each time. A transformation then has a value
// for each, and so have all that follow it; a primitive has a shape for each. Other requests do not move: the
// first one counts.
#include "render/state/interpreter.h"

#include <fmt/format.h>

namespace render {

bool is_transformation(RequestId id) {
  using enum RequestId;
  switch (id) {
  case kIdentity:
  case kTransform:
  case kConcatTransform:
  case kPerspective:
  case kTranslate:
  case kRotate:
  case kScale:
  case kSkew:
  case kCoordSysTransform: return true;
  default: return false;
  }
}

void Interpreter::motion_begin(const RequestCall& call) {
  std::vector<float> times(call.numbers(0).begin(), call.numbers(0).end());
  if (times.empty()) {
    error(call, "a motion block has at least one time", RiError::kBadMotion);
    times.push_back(0);
  }
  for (size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1])) {
      error(call, fmt::format("times must increase, found {:g} after {:g}", times[i], times[i - 1]),
            RiError::kBadMotion);
      times.resize(1);
    }
  open(call, BlockKind::kMotion);
  in_motion_ = MotionBlock{};
  for (float t : times)
    in_motion_->before.push_back({t, motion_.empty() ? ctm_ : matrix_at(motion_, t)});
  in_motion_->times = std::move(times);
}

void Interpreter::motion_end(const RequestCall& call) {
  if (!close(call, BlockKind::kMotion) || !in_motion_) return;
  MotionBlock block = std::move(*in_motion_);
  in_motion_.reset();
  if (block.calls < block.times.size())
    error(call, fmt::format("the block has {} times, but {} requests", block.times.size(), block.calls),
          RiError::kBadMotion);
  const Options& o = in_world_ ? scene_.options : options_;
  if (!block.transforms.empty()) {
    motion_ = std::move(block.transforms);
    ctm_ = matrix_at(motion_, o.shutter_open);
  }
  if (!block.shapes.empty()) {
    scene_.primitives.take_from(block.first_primitive);
    add_deforming(std::move(block.shapes), o.shutter_open, o.shutter_close, scene_.primitives);
  }
}

/// A request inside the open motion block. False: it is carried out as if it stood alone.
bool Interpreter::moved_by_motion_block(const RequestCall& call) {
  MotionBlock& block = *in_motion_;
  size_t index = block.calls++;
  if (index == 0) block.kind = call.id;
  if (index == block.times.size())
    error(call, fmt::format("the motion block has {} times; further requests in it are skipped", index),
          RiError::kBadMotion);
  if (index >= block.times.size()) return true;
  if (call.id != block.kind) {
    error(call,
          fmt::format("a motion block repeats one request; the first was {}", request_info(block.kind).name),
          RiError::kBadMotion);
    return true;
  }
  bool transforms = is_transformation(call.id);
  if (!transforms && !is_primitive(call.id)) {
    if (index == 0)
      warn_once(fmt::format("motion {}", call.info().name), call.where, "rib-unsupported",
                fmt::format("{} does not move: the first one in the motion block counts", call.info().name));
    return index > 0;
  }
  if (transforms)
    motion_transform(call, block.times[index]);
  else
    motion_shape(call, block.times[index]);
  return true;
}

void Interpreter::motion_transform(const RequestCall& call, float time) {
  MotionBlock& block = *in_motion_;
  Matrix4 world = scene_.world_to_camera;
  if (!world_motion_.empty()) scene_.world_to_camera = matrix_at(world_motion_, time);
  ctm_ = block.before[block.transforms.size()].value;
  call_handler(call);
  block.transforms.push_back({time, ctm_});
  scene_.world_to_camera = world;
}

/// The primitives a later call makes give their shapes to those of the first one.
void Interpreter::motion_shape(const RequestCall& call, float time) {
  MotionBlock& block = *in_motion_;
  size_t before = scene_.primitives.size();
  call_handler(call);
  PrimitiveList made = scene_.primitives.take_from(before);
  if (block.calls == 1) {
    block.first_primitive = before;
    scene_.primitives.append(PrimitiveList(made));
  } else if (const size_t first = block.shapes.front().value.size(); made.size() != first) {
    error(call,
          fmt::format("this makes {} surfaces, at the first time of the motion block it was {}", made.size(),
                      first),
          RiError::kBadMotion);
    return;
  }
  block.shapes.push_back({time, std::move(made)});
}

/// A transformation while the current one moves: it acts at all times.
void Interpreter::transform_request(const RequestCall& call) {
  MotionMatrices keys = std::move(motion_);
  motion_.clear();
  Matrix4 ctm = ctm_, world = scene_.world_to_camera;
  for (auto& key : keys) {
    if (!world_motion_.empty()) scene_.world_to_camera = matrix_at(world_motion_, key.time);
    ctm_ = key.value;
    call_handler(call);
    key.value = ctm_;
  }
  scene_.world_to_camera = world;
  ctm_ = ctm;
  call_handler(call);
  motion_ = std::move(keys);
}

} // namespace render
