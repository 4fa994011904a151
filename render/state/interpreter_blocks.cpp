// Blocks: frames, worlds, attributes, transformations, solids, objects, archives, conditions.
#include "render/state/interpreter.h"

#include <fmt/format.h>

namespace render {

namespace {

constexpr size_t kMaxBlocks = 10000;
constexpr std::string_view kBlockNames[] = {"FrameBegin", "WorldBegin",  "AttributeBegin", "TransformBegin",
                                            "SolidBegin", "MotionBegin", "IfBegin"};

} // namespace

void Interpreter::open(const RequestCall& call, BlockKind kind) {
  if (blocks_.size() == kMaxBlocks) error(call, fmt::format("more than {} nested blocks", kMaxBlocks));
  blocks_.push_back({kind, call.where, attributes_, ctm_, motion_, {}});
}

/// Restores what the innermost block of this kind saved. Blocks left open inside it are reported and closed
/// too.
bool Interpreter::close(const RequestCall& call, BlockKind kind) {
  size_t at = blocks_.size();
  while (at > 0 && blocks_[at - 1].kind != kind)
    --at;
  std::string_view opener = kBlockNames[static_cast<size_t>(kind)];
  // A world or frame is never closed from inside by what is not its own end.
  bool crosses_world = false;
  for (size_t i = at; i < blocks_.size(); ++i)
    crosses_world = crosses_world || blocks_[i].kind <= BlockKind::kWorld;
  if (at == 0 || (crosses_world && kind > BlockKind::kWorld)) {
    error(call, fmt::format("there is no open {}; the request is skipped", opener));
    return false;
  }
  for (size_t i = blocks_.size(); i > at; --i) {
    std::string_view inner = kBlockNames[static_cast<size_t>(blocks_[i - 1].kind)];
    auto& d = diagnostics_.error(call.where, fmt::format("{}: {} is still open", call.info().name, inner));
    d.notes.push_back({blocks_[i - 1].where, fmt::format("{} stands here", inner)});
  }
  const Block& block = blocks_[at - 1];
  if (kind == BlockKind::kFrame || kind == BlockKind::kWorld || kind == BlockKind::kAttribute)
    attributes_ = block.attributes;
  if (kind <= BlockKind::kTransform) {
    ctm_ = block.ctm;
    motion_ = block.motion;
  }
  if (block.options) options_ = *block.options;
  blocks_.resize(at - 1);
  return true;
}

void Interpreter::frame_begin(const RequestCall& call) {
  open(call, BlockKind::kFrame);
  blocks_.back().options = options_;
  options_.frame = call.integer(0);
}

void Interpreter::frame_end(const RequestCall& call) {
  close(call, BlockKind::kFrame);
}

void Interpreter::world_begin(const RequestCall& call) {
  open(call, BlockKind::kWorld);
  in_world_ = true;
  scene_ = {};
  if (!motion_.empty()) ctm_ = matrix_at(motion_, options_.shutter_open); // Shutter may have come after it
  scene_.world_to_camera = ctm_;
  world_motion_ = motion_;
  scene_.options = options_;
  if (override_options) override_options(scene_.options);
}

void Interpreter::world_end(const RequestCall& call) {
  scene_.spaces = spaces_;
  // Closed first, so that a block left open is reported before a long render.
  close(call, BlockKind::kWorld);
  in_world_ = false;
  in_motion_.reset();
  if (render_world_) render_world_(scene_);
  scene_ = {};
}

void Interpreter::attribute_begin(const RequestCall& call) {
  open(call, BlockKind::kAttribute);
}
void Interpreter::attribute_end(const RequestCall& call) {
  close(call, BlockKind::kAttribute);
}
void Interpreter::transform_begin(const RequestCall& call) {
  open(call, BlockKind::kTransform);
}
void Interpreter::transform_end(const RequestCall& call) {
  close(call, BlockKind::kTransform);
}
void Interpreter::solid_begin(const RequestCall& call) {
  open(call, BlockKind::kSolid);
}
void Interpreter::solid_end(const RequestCall& call) {
  close(call, BlockKind::kSolid);
}

void Interpreter::object_begin(const RequestCall& call) {
  recording_ = {call.id, RequestId::kObjectEnd, call.text(0), 1,
                std::make_shared<std::vector<RequestCall>>()};
}

void Interpreter::archive_begin(const RequestCall& call) {
  recording_ = {call.id, RequestId::kArchiveEnd, call.text(0), 1,
                std::make_shared<std::vector<RequestCall>>()};
}

/// ObjectEnd and ArchiveEnd.
void Interpreter::recording_end(const RequestCall& call) {
  if (recording_.depth == 0) {
    bool object = call.id == RequestId::kObjectEnd;
    error(call, fmt::format("there is no open {}; the request is skipped",
                            object ? "ObjectBegin" : "ArchiveBegin"));
    return;
  }
  bool object = recording_.begin == RequestId::kObjectBegin;
  (object ? objects_ : archives_)[recording_.name] = recording_.calls;
  recording_ = {};
}

void Interpreter::object_instance(const RequestCall& call) {
  auto it = objects_.find(call.text(0));
  if (it == objects_.end()) {
    error_at(call.arguments[0].where, call, fmt::format("no object \"{}\" was recorded", call.text(0)));
    return;
  }
  auto calls = it->second;
  // What an object changes of the state must not leak to what follows.
  auto attributes = attributes_;
  Matrix4 ctm = ctm_;
  MotionMatrices motion = motion_;
  replay(call, *calls);
  attributes_ = attributes;
  ctm_ = ctm;
  motion_ = std::move(motion);
}

void Interpreter::archive_instance(const RequestCall& call) {
  auto it = archives_.find(call.text(0));
  if (it == archives_.end()) {
    error_at(call.arguments[0].where, call, fmt::format("no archive \"{}\" was recorded", call.text(0)));
    return;
  }
  auto calls = it->second;
  replay(call, *calls);
}

void Interpreter::if_begin(const RequestCall& call) {
  open(call, BlockKind::kCondition);
}

/// The first branch was taken: everything up to the end of the condition is passed over.
void Interpreter::else_branch(const RequestCall& call) {
  if (blocks_.empty() || blocks_.back().kind != BlockKind::kCondition) {
    error(call, "there is no open IfBegin; the request is skipped");
    return;
  }
  skip_depth_ = 1;
}

void Interpreter::if_end(const RequestCall& call) {
  close(call, BlockKind::kCondition);
}

} // namespace render
