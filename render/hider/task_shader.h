// What becomes of a task when the first bucket asks for it: diced, displaced and shaded micropolygons. Where
// shaders look at single points, the grid is placed first, and only what can be seen is diced and shaded.
#pragma once

#include "render/hider/frame_report.h"
#include "render/hider/needed_points.h"
#include "render/hider/sample_pattern.h"
#include "render/hider/shaded_grid.h"
#include "render/hider/task_batch.h"
#include "render/prims/dice.h"
#include "render/shading/grid_shader.h"

#include <bitset>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace render {

/// What all threads share; it outlives them.
struct TaskSettings {
  const Options& options;
  const Camera& camera;
  const SamplePattern& pattern; ///< positions are enough
  const std::vector<AovChannel>& aovs;
};

/// Of one thread.
class TaskShader {
public:
  TaskShader(const TaskSettings& settings, Shading& shading);
  /// Null when nothing of the grid can be seen.
  std::unique_ptr<const ShadedGrid> shade(const TaskBatch& batch, uint32_t task);

  GridShader& shader() { return *shader_; }
  /// All but primitives and grids.
  const FrameReport& report() const { return report_; }

private:
  std::unique_ptr<ShadedGrid> shade_all(const GridTask& task, uint64_t id);
  std::unique_ptr<ShadedGrid> shade_needed(const GridTask& task, uint64_t id, PointNeeds needs);
  bool is_small(const GridTask& task) const;
  bool may_leave_out(const GridTask& task, PointNeeds needs) const;
  std::unique_ptr<ShadedGrid> place(const GridOutline* outline) const;
  std::optional<GridOutline> outline_of(const GridTask& task) const;
  void count(const GridTask& task, std::chrono::steady_clock::time_point started);

  const TaskSettings settings_;
  std::unique_ptr<GridShader> shader_;
  DiceContext context_;
  std::bitset<slvm::kGlobalCount> shown_; ///< predefined variables that displays ask for
  ReadVariables read_;                    ///< of the task's grid
  std::vector<Primitive> pieces_;         ///< of the task
  slvm::Grid grid_{2, 2};
  NeededPoints needed_;
  FrameReport report_;
};

} // namespace render
