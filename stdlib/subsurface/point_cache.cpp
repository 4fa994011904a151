#include "stdlib/subsurface/point_cache.h"

#include <algorithm>

namespace subsurface {

PointCache::PointCache(PointCloud cloud) : cloud_(std::move(cloud)), light_(cloud_.size()) {
  cloud_.irradiance.clear();
}

int64_t PointCache::next_index() {
  const size_t index = next_.fetch_add(1, std::memory_order_relaxed);
  if (index < size()) return static_cast<int64_t>(index);
  next_.store(size(), std::memory_order_relaxed);
  return -1;
}

void PointCache::restart() {
  std::fill(light_.begin(), light_.end(), Color{});
  next_ = 0;
}

void PointCache::accumulate(size_t index, Color light) {
  if (index >= size() || !is_finite(light)) return;
  Color& sum = light_[index];
  std::atomic_ref<float>(sum.x).fetch_add(light.x, std::memory_order_relaxed);
  std::atomic_ref<float>(sum.y).fetch_add(light.y, std::memory_order_relaxed);
  std::atomic_ref<float>(sum.z).fetch_add(light.z, std::memory_order_relaxed);
}

PointCloud PointCache::lit() const {
  PointCloud cloud = cloud_;
  cloud.irradiance.reserve(size());
  for (Color& sum : light_)
    cloud.irradiance.push_back({std::atomic_ref<float>(sum.x).load(std::memory_order_relaxed),
                                std::atomic_ref<float>(sum.y).load(std::memory_order_relaxed),
                                std::atomic_ref<float>(sum.z).load(std::memory_order_relaxed)});
  return cloud;
}

slvm::Result<bool> PointCache::write(const std::string& path, PlyEncoding encoding) const {
  return write_point_cloud(path, lit(), encoding);
}

slvm::Result<std::shared_ptr<PointCache>> PointCaches::open(const std::string& name) {
  std::lock_guard lock(mutex_);
  if (auto found = caches_.find(name); found != caches_.end()) return found->second;
  auto load = [&]() -> slvm::Result<std::shared_ptr<PointCache>> {
    auto cloud = loader_(name);
    if (!cloud) return slvm::Error{cloud.error()};
    return std::make_shared<PointCache>(std::move(*cloud));
  };
  return caches_.emplace(name, load()).first->second;
}

} // namespace subsurface
