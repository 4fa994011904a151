// The work of a frame: primitives cut into tasks, the buckets these fall in, and what procedurals and large
// meshes add when a bucket comes to them.
//
// A bucket takes its work nearest first. Where it meets a procedural that something nearer does not hide, the
// content is made, once, and cut; all buckets the bound covers then find the pieces that concern them. So a
// procedural that is hidden in every bucket is never made, and one that all its buckets have left is freed.
// It is the same with blocks of neighbours in a large mesh, which are there, but not cut.
#pragma once

#include "render/hider/image.h"
#include "render/hider/shaded_grid.h"
#include "render/prims/split.h"
#include "render/state/scene.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <queue>
#include <span>
#include <vector>

namespace render {

/// Buckets of a rectangle of the image: columns i0 to i1 and rows j0 to j1, both included.
struct BucketRange {
  int i0 = 0, i1 = -1, j0 = 0, j1 = -1;
  bool empty() const { return i0 > i1 || j0 > j1; }
  size_t count() const {
    return empty() ? 0 : static_cast<size_t>(i1 - i0 + 1) * static_cast<size_t>(j1 - j0 + 1);
  }
  bool contains(int i, int j) const { return i >= i0 && i <= i1 && j >= j0 && j <= j1; }
  /// Of a bucket among those of the range, row by row.
  size_t number(int i, int j) const {
    return static_cast<size_t>(j - j0) * static_cast<size_t>(i1 - i0 + 1) + static_cast<size_t>(i - i0);
  }
  BucketRange within(const BucketRange& r) const {
    return {std::max(i0, r.i0), std::min(i1, r.i1), std::max(j0, r.j0), std::min(j1, r.j1)};
  }
};

/// How an image is cut into buckets.
struct BucketLayout {
  PixelRect crop;
  int width = 32, height = 32;
  int xmargin = 0, ymargin = 0; ///< pixels around a bucket in which its samples lie
  int columns = 0, rows = 0;

  BucketLayout() = default;
  BucketLayout(PixelRect crop, int width, int height, int xmargin, int ymargin);
  PixelRect rect(int i, int j) const;
  /// The buckets whose samples a piece of the image may touch.
  BucketRange touched(Vec2 raster_min, Vec2 raster_max) const;
};

/// The shared, shaded form of one task.
struct GridSlot {
  static constexpr uint8_t kNew = 0, kBusy = 1, kDone = 2;
  std::atomic<uint8_t> state{kNew};
  std::atomic<uint32_t> users{0}; ///< buckets that may still ask for it
  std::unique_ptr<const ShadedGrid> grid;
  void leave() {
    if (users.fetch_sub(1) == 1) grid.reset();
  }
};

struct LazyBatch;

/// A solid in this frame.
struct SolidExtent {
  float zmin = kInfinity;        ///< nearest depth of all its pieces
  std::vector<uint8_t> cut_near; ///< for each node of its tree: it reaches in front of the near plane
};

struct TaskBatch {
  TaskBatch();
  ~TaskBatch();

  uint64_t id = 0;     ///< 0: the scene's own
  PrimitiveList owned; ///< of procedurals; the scene keeps its own
  const PrimitiveList* primitives = nullptr;
  std::vector<GridTask> tasks;
  std::unique_ptr<GridSlot[]> slots;
  std::vector<std::unique_ptr<LazyBatch>> waiting;
  std::map<const SolidTree*, SolidExtent> solids;

  /// When all tasks are there. What bounds a solid is known when all its surfaces are: its grids come
  /// together, at the turn of the nearest.
  void measure_solids(const Camera&);
  /// 0: the task's surface belongs to none.
  uint32_t solid_number(uint32_t task) const {
    const SolidTree* solid = solids.empty() ? nullptr : state_of(task).solid.get();
    return solid ? solid->number() : 0;
  }

  const PrimitiveState& state_of(uint32_t task) const { return primitives->state(tasks[task].primitive); }
};

/// Primitives [first, end) of a list.
struct PrimitiveRange {
  size_t first = 0, end = 0;
};

/// A procedural that can be seen, or a block of a large mesh.
struct LazyBatch {
  std::unique_ptr<const Procedural> procedural; ///< null: primitives of `list`
  const PrimitiveList* list = nullptr;
  PrimitiveRange range;
  bool cull_hidden = true;
  SeenBound seen;
  BucketRange buckets;
  uint64_t id = 0;

  std::mutex mutex; ///< of what follows
  bool made = false;
  std::vector<bool> left; ///< by bucket of the range: it will not ask any more
  size_t still_in = 0;    ///< buckets that have not left
  TaskBatch batch;
  std::vector<std::vector<uint32_t>> tasks_of; ///< by bucket of the range: what may touch it
};

/// Makes what procedurals hold, with shaders bound and all; given the pixels their bound covers. Called by
/// one thread at a time.
using ContentMaker = std::function<SceneContent(const Procedural&, float area)>;

/// Whether the primitives of a request are so many that blocks of them are cut one by one. What bounds a
/// solid is cut at once: all of it must be known.
inline bool waits(const PrimitiveList::Run& run) {
  return run.count > Pieces::kBlock && !run.state->solid;
}

/// What does not wait, a few at a time.
std::vector<PrimitiveRange> chunks_at_once(const PrimitiveList&);

/// Finds what can be seen, as parts of batch `id`, in the buckets of `within`.
class LazyFinder {
public:
  LazyFinder(const Camera& camera, const BucketLayout& layout, uint64_t id, const BucketRange& within)
      : camera_(camera), layout_(layout), id_(id), within_(within) {}
  void add(std::vector<Procedural> procedurals);
  /// The blocks of all that waits; the list must stay where it is.
  void add(const PrimitiveList&);
  std::vector<std::unique_ptr<LazyBatch>> take() { return std::move(found_); }

private:
  LazyBatch* add(const std::optional<SeenBound>& seen, uint64_t number);

  const Camera& camera_;
  const BucketLayout& layout_;
  uint64_t id_;
  BucketRange within_;
  std::vector<std::unique_ptr<LazyBatch>> found_;
};

/// What one bucket has to draw, nearest first.
class BucketQueue {
public:
  struct Item {
    float zmin = 0;
    TaskBatch* batch = nullptr;
    uint32_t task = 0;
    LazyBatch* lazy = nullptr; ///< set: not a task
  };

  /// `tasks`, of `scene`, are sorted.
  BucketQueue(TaskBatch& scene, std::vector<uint32_t> tasks, std::span<LazyBatch* const> waiting);
  void add(const Item& item) { added_.push(item); }
  /// False: all is done.
  bool next(Item& item);

private:
  struct Later {
    bool operator()(const Item& a, const Item& b) const;
  };
  TaskBatch& scene_;
  std::vector<uint32_t> tasks_;
  size_t at_ = 0;
  std::priority_queue<Item, std::vector<Item>, Later> added_;
};

/// Procedurals and blocks of meshes on the way from bound to grids.
class LazyContent {
public:
  LazyContent(const Camera& camera, const BucketLayout& layout, const SplitSettings& split,
              ContentMaker maker)
      : camera_(camera), layout_(layout), split_(split), make_(std::move(maker)) {}

  /// Bucket (i, j) has met `lazy`: its pieces there join the queue.
  void open(LazyBatch& lazy, int i, int j, BucketQueue& queue);
  /// Bucket (i, j) will not ask for anything of `lazy` again. It has drawn what open() gave it, or never
  /// asked.
  void leave(LazyBatch& lazy, int i, int j, bool was_open);

  size_t primitives() const { return primitives_; } ///< of procedurals
  size_t split() const { return cut_; }             ///< primitives
  size_t grids() const { return grids_; }

private:
  void make(LazyBatch& lazy);

  const Camera& camera_;
  const BucketLayout& layout_;
  const SplitSettings& split_;
  ContentMaker make_;
  std::mutex maker_mutex_;
  std::atomic<size_t> primitives_{0}, cut_{0}, grids_{0};
};

} // namespace render
