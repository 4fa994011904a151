// A point cloud that a shader lights (C. Hery, "Implementing a Skin BSSRDF", 4.4, chapter 4 of the SIGGRAPH
// 2003 course 9), in the calls of its shader lightbake_srf:
//
//   cache = caches.open("skin.ply");                       // opencache
//   while ((i = cache->next_index()) >= 0)                 // indexcache
//     illuminance at cache->position(i), cache->normal(i): // getPcache, getNcache
//       cache->accumulate(i, Cl * L.N);                    // accumcache
//   cache->write("lit.ply");                               // writecache
#pragma once

#include "stdlib/subsurface/point_cloud.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace subsurface {

/// One cloud that is being lit. Thread-safe: threads share the points out among themselves.
class PointCache {
public:
  /// Light starts at zero, whatever the cloud has.
  explicit PointCache(PointCloud cloud);

  size_t size() const { return cloud_.size(); }
  /// Each index once, then -1.
  int64_t next_index();
  /// Light starts at zero again, indices at the first. No other thread may be at work.
  void restart();

  Vec3 position(size_t index) const { return cloud_.position[index]; }
  /// The zero vector where the cloud has no normals.
  Vec3 normal(size_t index) const { return cloud_.normal.empty() ? Vec3{} : cloud_.normal[index]; }
  /// Adds to the irradiance of a point; nothing happens if there is no such point or the light is not finite.
  void accumulate(size_t index, Color light);

  /// The cloud with the light it has.
  PointCloud lit() const;
  slvm::Result<bool> write(const std::string& path, PlyEncoding encoding = PlyEncoding::kBinary) const;

private:
  PointCloud cloud_; // without irradiance
  mutable std::vector<Color> light_;
  std::atomic<size_t> next_{0};
};

/// The caches that a render has open, each read once. Thread-safe.
class PointCaches {
public:
  using Loader = std::function<slvm::Result<PointCloud>(const std::string& name)>;
  explicit PointCaches(Loader loader = read_point_cloud) : loader_(std::move(loader)) {}

  slvm::Result<std::shared_ptr<PointCache>> open(const std::string& name);

private:
  Loader loader_;
  std::mutex mutex_;
  std::map<std::string, slvm::Result<std::shared_ptr<PointCache>>, std::less<>> caches_;
};

} // namespace subsurface
