// Blocks: frames, worlds, attributes, transformations. Solids: interpreter_solids.cpp.
#include "render/state/interpreter.h"

#include <fmt/format.h>

#include <algorithm>

namespace render {

namespace {

constexpr size_t kMaxBlocks = 10000;
constexpr std::string_view kBlockNames[] = {"FrameBegin", "WorldBegin",  "AttributeBegin", "TransformBegin",
                                            "SolidBegin", "MotionBegin", "IfBegin"};

} // namespace

void Interpreter::open(const RequestCall& call, BlockKind kind) {
  if (blocks_.size() == kMaxBlocks) error(call, fmt::format("more than {} nested blocks", kMaxBlocks));
  blocks_.push_back({kind, call.where, attributes_, ctm_, motion_, {}, solid_, false, false});
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
    error(call, fmt::format("there is no open {}; the request is skipped", opener), RiError::kNesting);
    return false;
  }
  for (size_t i = blocks_.size(); i > at; --i) {
    std::string_view inner = kBlockNames[static_cast<size_t>(blocks_[i - 1].kind)];
    auto& d = diagnostics_.error(call.where, fmt::format("{}: {} is still open", call.info().name, inner));
    error_kind_ = RiError::kNesting;
    d.notes.push_back({blocks_[i - 1].where, fmt::format("{} stands here", inner)});
  }
  const Block& block = blocks_[at - 1];
  // Solids, too, save all (RISpec 3.2, 4).
  if (kind <= BlockKind::kSolid) {
    if (kind != BlockKind::kTransform) attributes_ = block.attributes;
    ctm_ = block.ctm;
    motion_ = block.motion;
  }
  if (block.options) options_ = *block.options;
  solid_ = block.solid;
  blocks_.resize(at - 1);
  return true;
}

/// True from the beginning to the end of a frame that is left out.
bool Interpreter::in_unwanted_frame(const RequestCall& call) {
  if (unwanted_frame_) {
    if (call.id == RequestId::kFrameEnd) unwanted_frame_.reset();
    return true;
  }
  if (call.id != RequestId::kFrameBegin || !wants_frame || recording() || in_world_) return false;
  if (wants_frame(call.integer(0))) return false;
  unwanted_frame_ = call.where;
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

/// Scenes are often made to be rendered from their own folder, archives to be read from theirs, and the
/// standard shaders should be at hand whatever a search path says.
std::vector<std::string> Interpreter::full_path(const Options& options, const std::string& kind) const {
  std::vector<std::string> path;
  if (auto it = options.search_paths.find(kind); it != options.search_paths.end()) path = it->second;
  if (auto it = options.search_paths.find("resource"); it != options.search_paths.end())
    path.insert(path.end(), it->second.begin(), it->second.end());
  std::vector<std::string> last{".", folder_, scene_folder_};
  if (auto it = standard_paths.find(kind); it != standard_paths.end())
    last.insert(last.end(), it->second.begin(), it->second.end());
  for (std::string& folder : last)
    if (!folder.empty() && std::find(path.begin(), path.end(), folder) == path.end())
      path.push_back(std::move(folder));
  return path;
}

void Interpreter::world_begin(const RequestCall& call) {
  open(call, BlockKind::kWorld);
  in_world_ = true;
  scene_ = {};
  if (!motion_.empty()) ctm_ = matrix_at(motion_, options_.shutter_open); // Shutter may have come after it
  scene_.world_to_camera = ctm_;
  world_motion_ = motion_;
  scene_.options = options_;
  for (const char* kind : {"shader", "texture", "archive", "procedural"})
    scene_.options.search_paths[kind] = full_path(options_, kind);
  if (override_options) override_options(scene_.options);
  measure_detail();
  const Options& o = scene_.options;
  if (o.projection == ProjectionKind::kOrthographic && o.fstop < kInfinity)
    warn_once("DepthOfField orthographic", call.where, "rib-unsupported",
              "DepthOfField has no effect: orthographic cameras have no lens");
}

void Interpreter::world_end(const RequestCall& call) {
  if (procedural_depth_ > 0) {
    error(call, "a procedural cannot end the world; the request is skipped");
    return;
  }
  // Closed first, so that a block left open is reported before a long render.
  close(call, BlockKind::kWorld);
  scene_.spaces = spaces_;
  in_motion_.reset();
  if (render_world_ && !stopped_) {
    complete_early();
    // What procedurals make goes to a scene of its own: this one is being read while they are at it.
    Scene scene = std::exchange(scene_, {});
    scene_.options = scene.options;
    scene_.world_to_camera = scene.world_to_camera;
    render_world_(scene);
  }
  in_world_ = false;
  scene_ = {};
  procedurals_ = repetitions_ = 0;
  endless_.clear();
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

} // namespace render
