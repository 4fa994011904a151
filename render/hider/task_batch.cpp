// Work of buckets, and what joins it later.
#include "render/hider/task_batch.h"

#include "render/hider/random.h"
#include "render/prims/join_tasks.h"

#include <algorithm>
#include <cmath>

namespace render {

TaskBatch::TaskBatch() = default;
TaskBatch::~TaskBatch() = default;

void TaskBatch::measure_solids(const Camera& camera) {
  for (const PrimitiveList::Run& run : primitives->runs()) {
    const PrimitiveState& state = *run.state;
    if (!state.solid) continue;
    SolidExtent& extent = solids[state.solid.get()];
    extent.cut_near.resize(state.solid->size());
    for (uint32_t k = 0; k < run.count; ++k)
      if (!(run.primitive(k).camera_bound({}).min.z >= camera.near_plane()))
        extent.cut_near[state.solid_primitive] = 1;
  }
  if (solids.empty()) return;
  auto extent_of = [&](const GridTask& task) {
    const SolidTree* solid = primitives->state(task.primitive).solid.get();
    return solid ? &solids.at(solid) : nullptr;
  };
  for (const GridTask& task : tasks)
    if (SolidExtent* e = extent_of(task)) e->zmin = std::min(e->zmin, task.zmin);
  for (GridTask& task : tasks)
    if (SolidExtent* e = extent_of(task)) task.zmin = e->zmin;
}

BucketLayout::BucketLayout(PixelRect c, int w, int h, int mx, int my)
    : crop(c), width(w), height(h), xmargin(mx), ymargin(my), columns((c.width() + w - 1) / w),
      rows((c.height() + h - 1) / h) {}

PixelRect BucketLayout::rect(int i, int j) const {
  return {crop.x0 + i * width, crop.y0 + j * height, std::min(crop.x0 + (i + 1) * width, crop.x1),
          std::min(crop.y0 + (j + 1) * height, crop.y1)};
}

BucketRange BucketLayout::touched(Vec2 raster_min, Vec2 raster_max) const {
  auto index = [](float x, int margin, int origin, int size, int count) {
    float cell = std::floor((x + static_cast<float>(margin - origin)) / static_cast<float>(size));
    return static_cast<int>(std::clamp(cell, 0.0f, static_cast<float>(count - 1)));
  };
  return {index(raster_min.x, -xmargin, crop.x0, width, columns),
          index(raster_max.x, xmargin, crop.x0, width, columns),
          index(raster_min.y, -ymargin, crop.y0, height, rows),
          index(raster_max.y, ymargin, crop.y0, height, rows)};
}

std::vector<PrimitiveRange> chunks_at_once(const PrimitiveList& list) {
  constexpr size_t kChunk = 64;
  std::vector<PrimitiveRange> out;
  auto add = [&](size_t first, size_t end) {
    for (size_t next = 0; first < end; first = next) {
      next = std::min(end, (first / kChunk + 1) * kChunk);
      out.push_back({first, next});
    }
  };
  size_t first = 0;
  for (const PrimitiveList::Run& run : list.runs())
    if (waits(run)) {
      add(first, run.first);
      first = size_t{run.first} + run.count;
    }
  add(first, list.size());
  return out;
}

namespace {

Vec2 margin_of(const BucketLayout& layout) {
  return {static_cast<float>(layout.xmargin), static_cast<float>(layout.ymargin)};
}

} // namespace

/// Null: it cannot be seen. `number`: among all of the batch.
LazyBatch* LazyFinder::add(const std::optional<SeenBound>& seen, uint64_t number) {
  if (!seen) return nullptr;
  BucketRange buckets = layout_.touched(seen->raster_min, seen->raster_max).within(within_);
  if (buckets.empty()) return nullptr;
  auto lazy = std::make_unique<LazyBatch>();
  lazy->seen = *seen;
  lazy->buckets = buckets;
  lazy->id = hash_of(static_cast<int>(id_), static_cast<int>(id_ >> 32), number) | 1;
  lazy->left.resize(buckets.count());
  lazy->still_in = buckets.count();
  return found_.emplace_back(std::move(lazy)).get();
}

void LazyFinder::add(std::vector<Procedural> procedurals) {
  for (size_t i = 0; i < procedurals.size(); ++i) {
    LazyBatch* lazy = add(seen_bound(procedurals[i], camera_, margin_of(layout_)), i + 1);
    if (!lazy) continue;
    lazy->cull_hidden = procedurals[i].attributes->cull_hidden;
    lazy->procedural = std::make_unique<const Procedural>(std::move(procedurals[i]));
  }
}

void LazyFinder::add(const PrimitiveList& list) {
  constexpr uint64_t kBlocks = uint64_t{1} << 32; // behind all numbers of procedurals
  for (const PrimitiveList::Run& run : list.runs()) {
    if (!waits(run) || !run.attributes().rays.camera) continue;
    for (uint32_t from = 0; from < run.count; from += Pieces::kBlock) {
      Box box = run.camera_bound(from / Pieces::kBlock);
      // What is rounded otherwise must not lie outside.
      box.grow(1e-6f * std::max(glm::length(box.min), glm::length(box.max)));
      LazyBatch* lazy = add(seen_bound(box, camera_, margin_of(layout_)), kBlocks + run.first + from);
      if (!lazy) continue;
      lazy->cull_hidden = run.attributes().cull_hidden;
      lazy->list = &list;
      lazy->range = {run.first + from, run.first + std::min(from + Pieces::kBlock, run.count)};
    }
  }
}

BucketQueue::BucketQueue(TaskBatch& scene, std::vector<uint32_t> tasks, std::span<LazyBatch* const> waiting)
    : scene_(scene), tasks_(std::move(tasks)) {
  for (LazyBatch* lazy : waiting)
    add({lazy->seen.zmin, nullptr, 0, lazy});
}

/// Nearest first; what is as near in an order that depends on nothing but the scene.
bool BucketQueue::Later::operator()(const Item& a, const Item& b) const {
  if (a.zmin != b.zmin) return a.zmin > b.zmin;
  uint64_t x = a.lazy ? a.lazy->id : a.batch->id, y = b.lazy ? b.lazy->id : b.batch->id;
  if (x != y || a.lazy || b.lazy) return x > y;
  uint32_t s = a.batch->solid_number(a.task), t = b.batch->solid_number(b.task);
  return s != t ? s > t : a.task > b.task;
}

bool BucketQueue::next(Item& item) {
  bool more = at_ < tasks_.size();
  if (!added_.empty() && (!more || added_.top().zmin < scene_.tasks[tasks_[at_]].zmin)) {
    item = added_.top();
    added_.pop();
    return true;
  }
  if (!more) return false;
  uint32_t task = tasks_[at_++];
  item = {scene_.tasks[task].zmin, &scene_, task, nullptr};
  return true;
}

/// With the lock of `lazy`.
void LazyContent::make(LazyBatch& lazy) {
  TaskBatch& batch = lazy.batch;
  batch.id = lazy.id;
  auto cut = [&](size_t first, size_t end) {
    for (size_t k = first; k < end; ++k)
      split_primitive((*batch.primitives)[k], static_cast<uint32_t>(k), split_, batch.tasks);
    cut_ += end - first;
  };
  if (lazy.procedural) {
    SceneContent content;
    {
      std::lock_guard one_at_a_time(maker_mutex_);
      content = make_(*lazy.procedural, lazy.seen.area);
    }
    batch.owned = std::move(content.primitives);
    batch.primitives = &batch.owned;
    primitives_ += batch.owned.size();
    for (const PrimitiveList::Run& run : batch.owned.runs())
      if (!waits(run)) cut(run.first, run.first + run.count);
    LazyFinder finder(camera_, layout_, lazy.id, lazy.buckets);
    finder.add(std::move(content.procedurals));
    finder.add(batch.owned);
    batch.waiting = finder.take();
  } else {
    batch.primitives = lazy.list;
    cut(lazy.range.first, lazy.range.end);
  }
  join_tasks(*batch.primitives, batch.tasks);
  batch.tasks.shrink_to_fit();
  if (lazy.procedural) batch.measure_solids(camera_);
  batch.slots = std::make_unique<GridSlot[]>(batch.tasks.size());
  lazy.tasks_of.resize(lazy.buckets.count());
  auto for_each = [&](const BucketRange& r, auto&& f) {
    for (int j = r.j0; j <= r.j1; ++j)
      for (int i = r.i0; i <= r.i1; ++i)
        f(i, j, lazy.buckets.number(i, j));
  };
  for (uint32_t t = 0; t < batch.tasks.size(); ++t) {
    const GridTask& task = batch.tasks[t];
    for_each(layout_.touched(task.raster_min, task.raster_max).within(lazy.buckets),
             [&](int, int, size_t bucket) {
               if (lazy.left[bucket]) return;
               lazy.tasks_of[bucket].push_back(t);
               ++batch.slots[t].users;
             });
  }
  for (const auto& inner : batch.waiting)
    for_each(inner->buckets, [&](int i, int j, size_t bucket) {
      if (!lazy.left[bucket]) return;
      inner->left[inner->buckets.number(i, j)] = true;
      --inner->still_in;
    });
  lazy.made = true;
  grids_ += batch.tasks.size();
}

void LazyContent::open(LazyBatch& lazy, int i, int j, BucketQueue& queue) {
  std::lock_guard lock(lazy.mutex);
  if (!lazy.made) make(lazy);
  for (uint32_t t : lazy.tasks_of[lazy.buckets.number(i, j)])
    queue.add({lazy.batch.tasks[t].zmin, &lazy.batch, t, nullptr});
  for (const auto& inner : lazy.batch.waiting)
    if (inner->buckets.contains(i, j)) queue.add({inner->seen.zmin, nullptr, 0, inner.get()});
}

void LazyContent::leave(LazyBatch& lazy, int i, int j, bool was_open) {
  std::lock_guard lock(lazy.mutex);
  lazy.left[lazy.buckets.number(i, j)] = true;
  if (lazy.made && !was_open) {
    for (uint32_t t : lazy.tasks_of[lazy.buckets.number(i, j)])
      lazy.batch.slots[t].leave();
    for (const auto& inner : lazy.batch.waiting)
      if (inner->buckets.contains(i, j)) leave(*inner, i, j, false);
  }
  if (--lazy.still_in > 0) return;
  // Nobody will ask again.
  lazy.batch.waiting.clear();
  lazy.batch.slots.reset();
  lazy.batch.tasks = {};
  lazy.batch.solids.clear();
  lazy.batch.primitives = nullptr;
  lazy.batch.owned = {};
  lazy.tasks_of = {};
}

} // namespace render
