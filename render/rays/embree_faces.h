// What is behind embree_world.h: the device, and what its two parts (embree_faces.cpp, embree_world.cpp)
// share.
#pragma once

#include "render/rays/embree_library.h"
#include "render/rays/embree_world.h"

#include <tbb/global_control.h>

#include <atomic>
#include <mutex>
#include <optional>

namespace render {

struct RayDevice::Impl {
  ~Impl() {
    if (device) embree().rtcReleaseDevice(device);
  }
  /// Made at the first call: it takes a thirtieth of the time of a small picture, even when there is nothing
  /// for rays in it. Null: there is a problem.
  RTCDevice get() {
    std::call_once(made, [this] {
      problem = embree().problem;
      if (!problem.empty()) return;
      if (alone) one_thread.emplace(tbb::global_control::max_allowed_parallelism, 1);
      device = embree().rtcNewDevice(nullptr);
      auto count = [](void* user, ssize_t size, bool) {
        static_cast<Impl*>(user)->bytes.fetch_add(size, std::memory_order_relaxed);
        return true;
      };
      embree().rtcSetDeviceMemoryMonitorFunction(device, count, this);
    });
    return device;
  }

  bool alone = false;
  std::optional<tbb::global_control> one_thread;
  std::once_flag made;
  RTCDevice device = nullptr;
  std::string problem;
  std::atomic<int64_t> bytes{0};
};

/// The scene of what RayDevice::build() made.
RTCScene scene_of(const FaceScene* faces);

/// Builds may run on several threads; while this thread waits for them it must not take up other work of the
/// renderer, which could wait for what is being built here.
void commit_scene(RTCScene scene);

} // namespace render
