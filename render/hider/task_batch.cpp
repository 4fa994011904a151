// Work of buckets, and procedurals that join it.
#include "render/hider/task_batch.h"

#include "render/hider/random.h"
#include "render/prims/join_tasks.h"

#include <algorithm>
#include <cmath>

namespace render {

TaskBatch::TaskBatch() = default;
TaskBatch::~TaskBatch() = default;

void TaskBatch::measure_solids(const Camera& camera) {
  for (const Primitive& p : primitives) {
    if (!p.state->solid) continue;
    SolidExtent& extent = solids[p.state->solid.get()];
    extent.cut_near.resize(p.state->solid->size());
    if (!(p.camera_bound({}).min.z >= camera.near_plane())) extent.cut_near[p.state->solid_primitive] = 1;
  }
  if (solids.empty()) return;
  auto extent_of = [&](const GridTask& task) {
    const SolidTree* solid = primitives[task.primitive].state->solid.get();
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

std::vector<std::unique_ptr<LazyBatch>> lazy_batches(std::vector<Procedural> procedurals, uint64_t id,
                                                     const Camera& camera, const BucketLayout& layout,
                                                     const BucketRange& within) {
  std::vector<std::unique_ptr<LazyBatch>> out;
  Vec2 margin(static_cast<float>(layout.xmargin), static_cast<float>(layout.ymargin));
  for (size_t i = 0; i < procedurals.size(); ++i) {
    auto seen = seen_bound(procedurals[i], camera, margin);
    if (!seen) continue;
    BucketRange buckets = layout.touched(seen->raster_min, seen->raster_max).within(within);
    if (buckets.empty()) continue;
    auto lazy = std::make_unique<LazyBatch>();
    lazy->procedural = std::move(procedurals[i]);
    lazy->seen = *seen;
    lazy->buckets = buckets;
    lazy->id = hash_of(static_cast<int>(id), static_cast<int>(id >> 32), static_cast<uint32_t>(i + 1)) | 1;
    lazy->left.resize(buckets.count());
    lazy->still_in = buckets.count();
    out.push_back(std::move(lazy));
  }
  return out;
}

BucketQueue::BucketQueue(TaskBatch& scene, std::vector<uint32_t> tasks,
                         std::span<LazyBatch* const> procedurals)
    : scene_(scene), tasks_(std::move(tasks)) {
  for (LazyBatch* lazy : procedurals)
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
  SceneContent content;
  {
    std::lock_guard one_at_a_time(maker_mutex_);
    content = make_(lazy.procedural, lazy.seen.area);
  }
  TaskBatch& batch = lazy.batch;
  batch.id = lazy.id;
  batch.owned = std::move(content.primitives);
  batch.primitives = batch.owned;
  for (uint32_t k = 0; k < batch.owned.size(); ++k)
    split_primitive(batch.owned[k], k, split_, batch.tasks);
  join_tasks(batch.owned, batch.tasks);
  batch.measure_solids(camera_);
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
  batch.procedurals = lazy_batches(std::move(content.procedurals), lazy.id, camera_, layout_, lazy.buckets);
  for (const auto& inner : batch.procedurals)
    for_each(inner->buckets, [&](int i, int j, size_t bucket) {
      if (!lazy.left[bucket]) return;
      inner->left[inner->buckets.number(i, j)] = true;
      --inner->still_in;
    });
  lazy.made = true;
  primitives_ += batch.owned.size();
  grids_ += batch.tasks.size();
}

void LazyContent::open(LazyBatch& lazy, int i, int j, BucketQueue& queue) {
  std::lock_guard lock(lazy.mutex);
  if (!lazy.made) make(lazy);
  for (uint32_t t : lazy.tasks_of[lazy.buckets.number(i, j)])
    queue.add({lazy.batch.tasks[t].zmin, &lazy.batch, t, nullptr});
  for (const auto& inner : lazy.batch.procedurals)
    if (inner->buckets.contains(i, j)) queue.add({inner->seen.zmin, nullptr, 0, inner.get()});
}

void LazyContent::leave(LazyBatch& lazy, int i, int j, bool was_open) {
  std::lock_guard lock(lazy.mutex);
  lazy.left[lazy.buckets.number(i, j)] = true;
  if (lazy.made && !was_open) {
    for (uint32_t t : lazy.tasks_of[lazy.buckets.number(i, j)])
      lazy.batch.slots[t].leave();
    for (const auto& inner : lazy.batch.procedurals)
      if (inner->buckets.contains(i, j)) leave(*inner, i, j, false);
  }
  if (--lazy.still_in > 0) return;
  // Nobody will ask again.
  lazy.batch.procedurals.clear();
  lazy.batch.slots.reset();
  lazy.batch.tasks = {};
  lazy.batch.solids.clear();
  lazy.batch.primitives = {};
  lazy.batch.owned = {};
  lazy.tasks_of = {};
}

} // namespace render
