// opencache, indexcache, getPcache, getNcache, accumcache, writecache: a shader lights the points of a cloud
// (C. Hery, the course's 4.4). Points are shared out among all points of all grids that open the same file.
#include "stdlib/dso/calls.h"
#include "stdlib/dso/plugin_data.h"
#include "stdlib/subsurface/point_cache.h"

namespace subsurface_plugin {
namespace {

using subsurface::PointCache;

/// A cloud that grids light. The file is written when the last of those that are at it is done: before, light
/// would be missing.
class Lighting {
public:
  explicit Lighting(std::shared_ptr<PointCache> cache) : cache_(std::move(cache)) {}

  PointCache& cache() { return *cache_; }
  void begin() {
    std::lock_guard lock(mutex_);
    ++at_work_;
  }
  void accumulate(size_t index, subsurface::Color light) {
    cache_->accumulate(index, light);
    changed_ = true;
  }
  /// `output`: "" if this grid wants no file.
  void done(const std::string& output, const RixContext& context) {
    std::lock_guard lock(mutex_);
    if (!output.empty()) {
      changed_ = changed_ || output_ != output;
      output_ = output;
    }
    if (--at_work_ > 0 || output_.empty() || !changed_) return;
    changed_ = false;
    if (auto written = cache_->write(output_); !written) complain(context, written.error());
  }

private:
  std::shared_ptr<PointCache> cache_;
  std::mutex mutex_;
  int at_work_ = 0;
  std::string output_;
  std::atomic<bool> changed_ = true;
};

/// Those of a frame.
struct Lightings {
  static constexpr const char* kName = "anemone.subsurface.lightings";
  void end(RixContext&) {}

  slvm::Result<std::shared_ptr<Lighting>> open(const std::string& file) {
    auto cache = caches.open(file);
    if (!cache) return slvm::Error{cache.error()};
    std::lock_guard lock(mutex);
    std::shared_ptr<Lighting>& lighting = by_cache[cache->get()];
    if (!lighting) lighting = std::make_shared<Lighting>(*cache);
    return lighting;
  }

  subsurface::PointCaches caches;
  std::mutex mutex;
  std::map<PointCache*, std::shared_ptr<Lighting>> by_cache;
};

/// What the shader of this grid has open.
struct OpenCache {
  static constexpr const char* kName = "anemone.subsurface.cache";
  void end(RixContext& context) { close("", context); }
  void close(const std::string& output, const RixContext& context) {
    if (auto old = std::move(lighting)) old->done(output, context);
  }

  std::shared_ptr<Lighting> lighting;
};

/// Null, with a message: none is open.
Lighting* opened(const RslContext& context, const char* function) {
  Lighting* lighting = of_grid<OpenCache>(context).lighting.get();
  if (!lighting)
    complain(context, std::string(function) + " is called without a cache: call opencache() first");
  return lighting;
}

bool in_range(float index, const PointCache& cache) {
  return index >= 0 && index < static_cast<float>(cache.size());
}

/// What `get` tells of the points of an index, zero of those that there are not.
template <class Iterator>
int read_points(RslContext& context, int argc, const RslArg* argv[], const char* call,
                subsurface::Vec3 (PointCache::*get)(size_t) const) {
  Iterator result(argv[0]);
  RslFloatIter index(argv[1]);
  Lighting* lighting = opened(context, call);
  for (unsigned int i = 0; i < RslArg::NumValues(argc, argv); ++i, ++result, ++index) {
    bool known = lighting && in_range(*index, lighting->cache());
    store(known ? (lighting->cache().*get)(static_cast<size_t>(*index)) : subsurface::Vec3{}, *result);
  }
  return 0;
}

} // namespace

int open_cache(RslContext* context, int, const RslArg* argv[]) {
  RslFloatIter result(argv[0]);
  RslStringIter file(argv[1]);
  OpenCache& open = of_grid<OpenCache>(*context);
  open.close("", *context);
  *result = 0;
  auto lighting = of_frame<Lightings>(*context).open(*file);
  if (!lighting) {
    complain(*context, lighting.error());
    return 0;
  }
  open.lighting = *lighting;
  open.lighting->begin();
  *result = 1;
  return 0;
}

int next_index(RslContext* context, int, const RslArg* argv[]) {
  RslFloatIter result(argv[0]);
  Lighting* lighting = opened(*context, "indexcache()");
  for (unsigned int i = 0; i < argv[0]->NumValues(); ++i, ++result)
    *result = lighting ? static_cast<float>(lighting->cache().next_index()) : -1.0f;
  return 0;
}

int get_position(RslContext* context, int argc, const RslArg* argv[]) {
  return read_points<RslPointIter>(*context, argc, argv, "getPcache()", &PointCache::position);
}

int get_normal(RslContext* context, int argc, const RslArg* argv[]) {
  return read_points<RslNormalIter>(*context, argc, argv, "getNcache()", &PointCache::normal);
}

int accumulate(RslContext* context, int argc, const RslArg* argv[]) {
  RslFloatIter index(argv[1]);
  RslColorIter light(argv[2]);
  Lighting* lighting = opened(*context, "accumcache()");
  for (unsigned int i = 0; lighting && i < RslArg::NumValues(argc, argv); ++i, ++index, ++light)
    if (in_range(*index, lighting->cache())) lighting->accumulate(static_cast<size_t>(*index), vec3(*light));
  return 0;
}

int write_cache(RslContext* context, int, const RslArg* argv[]) {
  RslStringIter file(argv[1]);
  if (!opened(*context, "writecache()")) return 0;
  if (!**file) complain(*context, "writecache() needs the name of a file");
  of_grid<OpenCache>(*context).close(*file, *context);
  return 0;
}

} // namespace subsurface_plugin
