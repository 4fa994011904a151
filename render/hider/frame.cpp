// The frame loop. Order of work:
//   1. split: primitives, in parallel, into GridTasks (a few dozen bytes each); large meshes and procedurals
//      wait until a bucket comes to them (task_batch.h);
//   2. bin: each bucket gets the list of tasks that may touch it, nearest first;
//   3. buckets in scan order, each thread taking the next: draw the bucket's grids until all samples are
//      closed. A grid is diced and shaded by the first bucket that needs it and freed by the last one in
//      whose list it is, so the grids in memory are those of about one row of buckets.
#include "render/hider/frame.h"

#include "render/hider/after_filter.h"
#include "render/hider/bucket_shares.h"
#include "render/hider/random.h"
#include "render/hider/sample_buffer.h"
#include "render/hider/task_batch.h"
#include "render/hider/task_shader.h"
#include "render/prims/join_tasks.h"
#include "render/prims/split.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>

namespace render {

namespace {

struct Bucket {
  std::vector<uint32_t> tasks; ///< of the scene's own primitives, nearest first
  std::vector<LazyBatch*> waiting;
};

class FrameRenderer {
public:
  FrameRenderer(const Scene& scene, Shading& shading, const FrameSettings& settings)
      : scene_(scene), options_(scene.options), shading_(shading), settings_(settings),
        camera_(scene.options), after_filter_(options_, settings.aovs),
        pattern_({options_.xsamples, options_.ysamples, options_.jitter}, false, false),
        content_(camera_, layout_, split_, settings.make_content) {
    sampling_ = SamplingSettings::from(options_, settings.aovs);
    sampling_.tile = pattern_.tile();
    for (const PrimitiveList::Run& run : scene.primitives.runs()) {
      sampling_.moving = sampling_.moving || run.moves();
      sampling_.size.levels = sampling_.size.levels || !run.state->level.whole();
    }
    // What procedurals make may move, or go over into another level.
    if (!scene.procedurals.empty()) {
      if (options_.shutter_close > options_.shutter_open) sampling_.moving = true;
      sampling_.size.levels = true;
    }
    sampling_.moving = sampling_.moving && options_.sample_motion;
    sampling_.camera = &camera_;
    if (camera_.has_lens()) sampling_.lens = &camera_;
    sampling_.mask = settings.mask;
    sampling_.mask_scale = {1 / static_cast<float>(options_.xres), 1 / static_cast<float>(options_.yres)};
    threads_ = thread_count(settings.threads);
    sampling_.reconstruction.shown = settings.shown;
    image_ = Image(image_rect(camera_.crop()), static_cast<int>(sampling_.aov_floats()), settings.shown);
  }

  Image run(FrameReport& report);

private:
  struct Worker {
    std::optional<TaskShader> tasks;
    std::unique_ptr<SampleBuffer> samples;
    slvm::Grid pixels{2, 2}; ///< for the imager
  };

  void split_all();
  void make_buckets();
  void render_bucket(int i, int j, Worker& worker);
  bool masked(const GridTask& task, const PixelRect& covered) const;
  void finish_bucket(const PixelRect& rect, Worker& worker);
  const ShadedGrid* shaded(TaskBatch& batch, uint32_t task, Worker& worker);
  /// Pixels of the frame to pixels of the image, which are samples when "subpixel" is asked for.
  PixelRect image_rect(const PixelRect& r) const {
    int x = options_.subpixel ? options_.xsamples : 1, y = options_.subpixel ? options_.ysamples : 1;
    return {r.x0 * x, r.y0 * y, r.x1 * x, r.y1 * y};
  }
  void report_progress();
  template <class F> void for_all(size_t count, F&& f) const;

  const Scene& scene_;
  const Options& options_;
  Shading& shading_;
  const FrameSettings& settings_;
  Camera camera_;
  SamplingSettings sampling_;
  AfterFilter after_filter_;
  int threads_;
  Image image_;
  const SamplePattern pattern_; ///< positions alone
  SplitSettings split_;
  TaskBatch batch_; ///< of the scene's own primitives
  BucketLayout layout_;
  std::vector<Bucket> buckets_;
  LazyContent content_;
  std::mutex progress_mutex_;
  size_t finished_buckets_ = 0, split_count_ = 0;
};

Image FrameRenderer::run(FrameReport& report) {
  report.primitives += scene_.primitives.size();
  if (image_.rect.empty()) return std::move(image_);
  // Also for what rays build. One thread needs none of this, which takes a tenth of the time to start.
  std::optional<tbb::global_control> control;
  if (threads_ > 1)
    control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads_));
  std::vector<Worker> workers(static_cast<size_t>(threads_));
  auto make = [&] {
    split_all();
    make_buckets();
    const auto columns = static_cast<size_t>(layout_.columns);
    BucketShares shares(columns, static_cast<size_t>(layout_.rows), workers.size());
    for_all(workers.size(), [&](size_t w) { // one task a thread
      Worker& worker = workers[w];
      while (const std::optional<size_t> b = shares.next(w)) {
        if (!worker.tasks)
          worker.tasks.emplace(TaskSettings{options_, camera_, pattern_, settings_.aovs}, shading_);
        render_bucket(static_cast<int>(*b % columns), static_cast<int>(*b / columns), worker);
        report_progress();
      }
    });
  };
  if (threads_ == 1)
    make();
  else
    tbb::task_arena(threads_).execute(make);
  report.primitives += content_.primitives();
  report.split_primitives += split_count_ + content_.split();
  report.grids += batch_.tasks.size() + content_.grids();
  for (const Worker& w : workers)
    if (w.tasks) report.add_shading(w.tasks->report());
  return std::move(image_);
}

/// One thread does it by itself: to set threads up takes a twentieth of the time of a very small picture.
template <class F> void FrameRenderer::for_all(size_t count, F&& f) const {
  if (threads_ > 1) return tbb::parallel_for(size_t{0}, count, f);
  for (size_t k = 0; k < count; ++k)
    f(k);
}

void FrameRenderer::split_all() {
  SplitSettings& s = split_;
  s.camera = &camera_;
  PixelRect crop = camera_.crop();
  auto mx = static_cast<float>(sampling_.reconstruction.xmargin()),
       my = static_cast<float>(sampling_.reconstruction.ymargin());
  s.raster_min = {static_cast<float>(crop.x0) - mx, static_cast<float>(crop.y0) - my};
  s.raster_max = {static_cast<float>(crop.x1) + mx, static_cast<float>(crop.y1) + my};
  s.grid_size = options_.grid_size;
  s.eye_splits = options_.eye_splits;
  s.motion = options_.sample_motion;
  s.may_have_samples = [this](Vec2 low, Vec2 high) { return pattern_.may_have(low, high); };
  s.must_be_shaded = [this](const Primitive& p) { return shading_.has_effects(p); };
  // Chunks of primitives in parallel, joined in order: task numbers never depend on the threads.
  const std::vector<PrimitiveRange> chunks = chunks_at_once(scene_.primitives);
  std::vector<std::vector<GridTask>> parts(chunks.size());
  for_all(chunks.size(), [&](size_t c) {
    for (size_t i = chunks[c].first; i < chunks[c].end; ++i)
      split_primitive(scene_.primitives[i], static_cast<uint32_t>(i), s, parts[c]);
    join_tasks(scene_.primitives, parts[c]);
    parts[c].shrink_to_fit();
  });
  for (const PrimitiveRange& c : chunks)
    split_count_ += c.end - c.first;
  size_t tasks = 0;
  for (const auto& part : parts)
    tasks += part.size();
  batch_.tasks.reserve(tasks);
  for (auto& part : parts) {
    batch_.tasks.insert(batch_.tasks.end(), part.begin(), part.end());
    part = {};
  }
  batch_.primitives = &scene_.primitives;
  batch_.slots = std::make_unique<GridSlot[]>(batch_.tasks.size());
  if (scene_.solids > 0) batch_.measure_solids(camera_);
}

void FrameRenderer::make_buckets() {
  layout_ = BucketLayout(camera_.crop(), options_.bucket_width, options_.bucket_height,
                         sampling_.reconstruction.xmargin(), sampling_.reconstruction.ymargin());
  buckets_.resize(static_cast<size_t>(layout_.columns) * static_cast<size_t>(layout_.rows));
  auto for_each = [&](const BucketRange& r, auto&& f) {
    for (int j = r.j0; j <= r.j1; ++j)
      for (int i = r.i0; i <= r.i1; ++i)
        f(buckets_[static_cast<size_t>(j * layout_.columns + i)]);
  };
  for (uint32_t t = 0; t < batch_.tasks.size(); ++t) {
    BucketRange r = layout_.touched(batch_.tasks[t].raster_min, batch_.tasks[t].raster_max);
    for_each(r, [&](Bucket& b) { b.tasks.push_back(t); });
    batch_.slots[t].users = static_cast<uint32_t>(r.count());
  }
  LazyFinder finder(camera_, layout_, 0, {0, layout_.columns - 1, 0, layout_.rows - 1});
  finder.add(scene_.procedurals);
  finder.add(scene_.primitives);
  batch_.waiting = finder.take();
  for (const auto& lazy : batch_.waiting)
    for_each(lazy->buckets, [&](Bucket& b) { b.waiting.push_back(lazy.get()); });
  for_all(buckets_.size(), [&](size_t b) {
    std::sort(buckets_[b].tasks.begin(), buckets_[b].tasks.end(), [&](uint32_t x, uint32_t y) {
      const GridTask &s = batch_.tasks[x], &t = batch_.tasks[y];
      if (s.zmin != t.zmin) return s.zmin < t.zmin;
      uint32_t a = batch_.solid_number(x), c = batch_.solid_number(y);
      return a != c ? a < c : x < y;
    });
  });
}

void FrameRenderer::render_bucket(int i, int j, Worker& worker) {
  Bucket& bucket = buckets_[static_cast<size_t>(j * layout_.columns + i)];
  PixelRect pixels = layout_.rect(i, j), rect = image_rect(pixels);
  if (bucket.tasks.empty() && bucket.waiting.empty()) {
    clear(sampling_.reconstruction, rect, image_);
    finish_bucket(rect, worker);
    return;
  }
  if (!worker.samples) worker.samples = std::make_unique<SampleBuffer>(sampling_);
  SampleBuffer& samples = *worker.samples;
  samples.begin(pixels);
  BucketQueue queue(batch_, std::exchange(bucket.tasks, {}), std::exchange(bucket.waiting, {}));
  std::vector<LazyBatch*> opened;
  for (BucketQueue::Item item; queue.next(item);) {
    if (LazyBatch* lazy = item.lazy) {
      if (lazy->cull_hidden && samples.hides(lazy->seen.raster_min, lazy->seen.raster_max, item.zmin)) {
        content_.leave(*lazy, i, j, false);
      } else {
        content_.open(*lazy, i, j, queue);
        opened.push_back(lazy);
      }
      continue;
    }
    const GridTask& task = item.batch->tasks[item.task];
    const PrimitiveState& state = item.batch->state_of(item.task);
    // Of a solid all must be known, whatever is seen of it.
    const bool hidden = state.solid ? samples.hides(item.zmin)
                                    : samples.hides(task.raster_min, task.raster_max, item.zmin) ||
                                          masked(task, samples.covered());
    if (!hidden || !state.attributes->cull_hidden)
      if (const ShadedGrid* grid = shaded(*item.batch, item.task, worker)) samples.draw(*grid);
    item.batch->slots[item.task].leave();
  }
  // From the inside out: what came of a procedural lives in it.
  for (auto lazy = opened.rbegin(); lazy != opened.rend(); ++lazy)
    content_.leave(**lazy, i, j, true);
  samples.finish(image_);
  finish_bucket(rect, worker);
}

/// Whether Hider "depthmask" leaves out all of a task that samples of `covered` could see.
bool FrameRenderer::masked(const GridTask& task, const PixelRect& covered) const {
  if (!sampling_.mask) return false;
  const Vec2 from = glm::max(task.raster_min, Vec2(covered.x0, covered.y0)) * sampling_.mask_scale;
  const Vec2 to = glm::min(task.raster_max, Vec2(covered.x1, covered.y1)) * sampling_.mask_scale;
  const auto [least, largest] = sampling_.mask->limits(from, to);
  return sampling_.mask->reverse ? task.zmin > largest : task.zmax < least;
}

void FrameRenderer::finish_bucket(const PixelRect& rect, Worker& worker) {
  after_filter_.run(rect, image_, worker.tasks->shader(), worker.pixels);
  if (settings_.finished) settings_.finished(image_, rect);
}

/// The task's grid, shaded now if no other bucket has done it. Another thread at it is waited for: it needs
/// nothing from this one.
const ShadedGrid* FrameRenderer::shaded(TaskBatch& batch, uint32_t task, Worker& worker) {
  GridSlot& slot = batch.slots[task];
  uint8_t expected = GridSlot::kNew;
  if (slot.state.compare_exchange_strong(expected, GridSlot::kBusy)) {
    slot.grid = worker.tasks->shade(batch, task);
    slot.state = GridSlot::kDone;
    slot.state.notify_all();
  } else {
    while (expected != GridSlot::kDone) {
      slot.state.wait(expected);
      expected = slot.state;
    }
  }
  return slot.grid.get();
}

void FrameRenderer::report_progress() {
  std::lock_guard lock(progress_mutex_);
  ++finished_buckets_;
  if (settings_.progress)
    settings_.progress(static_cast<double>(finished_buckets_) / static_cast<double>(buckets_.size()));
}

} // namespace

int thread_count(int threads) {
  return threads > 0 ? threads : tbb::this_task_arena::max_concurrency();
}

Image render_frame(const Scene& scene, Shading& shading, const FrameSettings& settings, FrameReport& report) {
  return FrameRenderer(scene, shading, settings).run(report);
}

} // namespace render
