// Dicing and shading of tasks.
#include "render/hider/task_shader.h"

#include "render/prims/motion.h"

#include <bit>

namespace render {

TaskShader::TaskShader(const TaskSettings& settings, Shading& shading)
    : settings_(settings), shader_(shading.make_grid_shader()) {
  const Options& o = settings.options;
  context_ = {&settings.camera, &shading.strings(), o.shutter_open + o.shutter_offset,
              o.shutter_close - o.shutter_open};
  for (const AovChannel& aov : settings.aovs)
    if (slvm::Global g = slvm::find_global(aov.name); g != slvm::Global::kCount)
      shown_.set(static_cast<size_t>(g));
}

std::unique_ptr<const ShadedGrid> TaskShader::shade(const TaskBatch& batch, uint32_t index) {
  const GridTask& task = batch.tasks[index];
  pieces_.clear();
  for (uint64_t left = task.pieces; left != 0; left &= left - 1)
    pieces_.push_back((*batch.primitives)[task.primitive + static_cast<uint32_t>(std::countr_zero(left))]);
  const PrimitiveState& state = *pieces_.front().state;
  read_.predefined = shader_->reads(pieces_.front()) | shown_;
  const uint64_t id = batch.id ^ index;
  const PointNeeds needs = shader_->needs(pieces_.front());
  auto out = may_leave_out(task, needs) ? shade_needed(task, id, needs) : shade_all(task, id);
  if (!out) return nullptr;
  if (state.solid) out->cut_near = batch.solids.at(state.solid.get()).cut_near[state.solid_primitive];
  report_.variables |= out->variables;
  report_.bad_colours += out->bad_colours;
  return out;
}

std::unique_ptr<ShadedGrid> TaskShader::shade_all(const GridTask& task, uint64_t id) {
  const Primitive& primitive = pieces_.front();
  const Attributes& a = primitive.attributes();
  const Camera& camera = settings_.camera;
  if (a.sides == 1) read_.predefined.set(static_cast<size_t>(slvm::Global::kNg)); // for faces_away()
  dice(pieces_, task, id, context_, read_, grid_);
  auto started = std::chrono::steady_clock::now();
  const std::optional<GridOutline> outline = outline_of(task);
  const GridOutline* seams = outline ? &*outline : nullptr;
  if (shader_->displace(primitive, grid_)) renew_geometry(camera, grid_);
  const std::vector<float> times = motion_times(primitive);
  if (times.empty() && a.sides == 1 && a.cull_backfacing && a.back_face_tolerance == 0 &&
      !primitive.state->solid && faces_away(grid_, camera))
    return nullptr;
  std::vector<slvm::Grid> moved;
  for (size_t i = 1; i < times.size(); ++i) {
    std::vector<Primitive> there;
    for (const Primitive& piece : pieces_)
      there.push_back(primitive_at(piece, times[i]));
    slvm::Grid& later = moved.emplace_back(2, 2);
    dice(there, task, id, context_, read_, later);
    shader_->displace(there.front(), later);
  }
  if (!moved.empty()) set_motion(grid_, moved.back(), context_.dtime);
  shader_->shade(primitive, grid_);
  count(task, started);
  auto out = place(seams); // surface shaders may have moved P
  add_looks(*out, primitive, grid_, {}, settings_.aovs, *shader_);
  for (size_t i = 0; i < moved.size() && settings_.options.sample_motion; ++i)
    add_positions(*out, times[i + 1], moved[i], camera, seams);
  return out;
}

std::unique_ptr<ShadedGrid> TaskShader::shade_needed(const GridTask& task, uint64_t id, PointNeeds needs) {
  auto started = std::chrono::steady_clock::now();
  dice_positions(pieces_, task, grid_);
  const std::optional<GridOutline> outline = outline_of(task);
  auto out = place(outline ? &*outline : nullptr);
  needed_.find(*out, is_small(task) ? &settings_.pattern : nullptr);
  if (needed_.empty()) return nullptr;
  const Primitive& primitive = pieces_.front();
  const bool few = needed_.few(grid_.points());
  if (few)
    dice_some(pieces_, task, needed_.points(), needs == PointNeeds::kNeighbours, id, context_, read_, grid_);
  else
    dice(pieces_, task, id, context_, read_, grid_);
  shader_->displace(primitive, grid_); // there is nothing to displace: a beginning
  shader_->shade(primitive, grid_);
  count(task, started);
  add_looks(*out, primitive, grid_, few ? needed_.points() : std::span<const uint32_t>(), settings_.aovs,
            *shader_);
  return out;
}

/// Whether so many micropolygons can lie between samples that it is worth while to look for them: more where
/// shading is cheap, as it is without an atmosphere to march through.
bool TaskShader::is_small(const GridTask& task) const {
  if (task.count() > 1) return true;
  const Options& o = settings_.options;
  const float samples =
      task.step * task.step * static_cast<float>(o.xsamples) * static_cast<float>(o.ysamples);
  return samples < (pieces_.front().attributes().atmosphere ? 2.0f : 0.75f);
}

/// Whether it can be worth while, and right, to leave out points.
bool TaskShader::may_leave_out(const GridTask& task, PointNeeds needs) const {
  const Primitive& primitive = pieces_.front();
  const Attributes& a = primitive.attributes();
  if (!a.cull_hidden || settings_.camera.has_lens() || !motion_times(primitive).empty()) return false;
  // The other corners of a single micropolygon are all the neighbours that its own one has.
  if (needs == PointNeeds::kNeighbours) return !a.smooth_shading && task.nu == 2 && task.nv == 2;
  const bool few_corners = !a.smooth_shading && (task.nu - 1) * (task.nv - 1) * 5 < task.nu * task.nv * 4;
  return needs == PointNeeds::kNothing && (few_corners || is_small(task));
}

std::optional<GridOutline> TaskShader::outline_of(const GridTask& task) const {
  const Primitive& primitive = pieces_.front();
  if (primitive.geometry->ruled() || !primitive.attributes().stitch || pieces_.size() > 1) return {};
  return find_outline(grid_, task.rect, settings_.camera, task.step);
}

std::unique_ptr<ShadedGrid> TaskShader::place(const GridOutline* outline) const {
  return std::make_unique<ShadedGrid>(make_grid_geometry(pieces_.front(), grid_, settings_.camera, outline));
}

void TaskShader::count(const GridTask& task, std::chrono::steady_clock::time_point started) {
  std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - started;
  const auto& surface = pieces_.front().attributes().surface;
  ShaderCost& cost = report_.shaders[surface ? surface->name : "none"];
  cost.seconds += seconds.count();
  ++cost.grids;
  cost.points += grid_.samples();
  ++report_.shaded_grids;
  report_.shaded_points += grid_.samples();
  report_.micropolygons +=
      static_cast<size_t>(task.count()) * static_cast<size_t>((task.nu - 1) * (task.nv - 1));
}

} // namespace render
