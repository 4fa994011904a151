// Which small surfaces can share a grid.
#include "render/prims/join_tasks.h"

namespace render {

namespace {

/// Of a task that is worth joining to others, and of what comes of it.
constexpr int kSmall = 25, kMostPoints = 256;
/// From the first primitive of a grid to its last one: bits of GridTask::pieces.
constexpr uint32_t kReach = 64;
/// Pixels that a joined grid may be wider and higher than its pieces, whose bounds for displacement may be
/// wide already: it is shaded as a whole, also where it is hidden.
constexpr float kMostPixels = 32;
/// Pieces of one grid have lattices of one size: how many times the points they need they may have.
constexpr float kMostWaste = 1.7f;

bool is_whole(const UvRect& r) {
  return r.u0 == 0 && r.u1 == 1 && r.v0 == 0 && r.v1 == 1;
}

/// Whether a surface can share grids at all.
bool joins(const Primitive& p) {
  const VarSource* vars = p.vars.source();
  bool seams = !p.geometry->ruled() && !p.one_across && p.attributes().stitch;
  return !seams && !p.state->solid && p.deformation.empty() && (!vars || !vars->differs_by_piece());
}

/// What surfaces that share a grid have in common.
struct Kind {
  const PrimitiveState* state = nullptr;
  const VarSource* vars = nullptr;
  bool one_across = false;
  bool operator==(const Kind&) const = default;
};

/// Whether a grid of this size would still be about where the task is.
bool is_near(Vec2 size, const GridTask& task) {
  Vec2 own = task.raster_max - task.raster_min;
  return size.x <= own.x + kMostPixels && size.y <= own.y + kMostPixels;
}

} // namespace

void join_tasks(const PrimitiveList& primitives, std::vector<GridTask>& tasks) {
  size_t kept = 0;
  bool open = false; // the last task that was kept may grow
  float wanted = 0;  // points that its pieces need
  Kind kind;         // of its pieces
  for (size_t t = 0; t < tasks.size(); ++t) {
    const GridTask& task = tasks[t];
    bool small = task.nu * task.nv <= kSmall && is_whole(task.rect);
    Kind own;
    if (small) {
      const Primitive p = primitives[task.primitive];
      small = joins(p);
      own = {p.state.get(), p.vars.source(), p.one_across};
    }
    if (small && open) {
      GridTask& run = tasks[kept - 1];
      Vec2 low = glm::min(run.raster_min, task.raster_min), high = glm::max(run.raster_max, task.raster_max);
      int nu = std::max(run.nu, task.nu), nv = std::max(run.nv, task.nv);
      int points = (run.count() + 1) * nu * nv;
      // Between them there may be some that are not seen.
      const uint32_t place = task.primitive - run.primitive;
      float both = wanted + static_cast<float>(task.nu * task.nv);
      bool room = points <= kMostPoints && static_cast<float>(points) <= kMostWaste * both &&
                  is_near(high - low, task);
      if (room && place < kReach && run.pieces >> place == 0 && task.step == run.step && own == kind) {
        run.pieces |= uint64_t{1} << place;
        wanted = both;
        run.nu = nu;
        run.nv = nv;
        run.raster_min = low;
        run.raster_max = high;
        run.zmin = std::min(run.zmin, task.zmin);
        run.zmax = std::max(run.zmax, task.zmax);
        continue;
      }
    }
    open = small;
    kind = own;
    wanted = static_cast<float>(task.nu * task.nv);
    if (kept != t) tasks[kept] = task;
    ++kept;
  }
  tasks.resize(kept);
}

} // namespace render
