// What the functions of the plug-in keep between calls: for the run or a frame, shared by all threads, or for
// the grid that is being shaded. And their messages, which get the line of the shader.
#pragma once

#include "RslPlugin.h"
#include "rx.h"
#include "stdlib/subsurface/vec3.h"

#include <string>

namespace subsurface_plugin {

inline void complain(const RixContext& context, const std::string& text) {
  static_cast<RixMessages*>(context.GetRixInterface(k_RixMessages))->Error("%s", text.c_str());
}

/// The T of this storage, made when it is first asked for. `T::kName` is its key. When the storage ends,
/// T::end(context) is called and T is deleted.
template <class T> T& kept(RixStorage& storage) {
  struct Turn {
    explicit Turn(RixStorage& s) : storage(s) { storage.Lock(); }
    ~Turn() { storage.Unlock(); }
    RixStorage& storage;
  } turn(storage);
  if (void* data = storage.Get(T::kName)) return *static_cast<T*>(data);
  T* made = new T;
  storage.Set(T::kName, made, [](RixContext* context, void* data) {
    auto* old = static_cast<T*>(data);
    old->end(*context);
    delete old;
  });
  return *made;
}
/// What outlives frames.
template <class T> T& of_run(const RslContext& context) {
  return kept<T>(*static_cast<RixStorage*>(context.GetRixInterface(k_RixRunData)));
}
template <class T> T& of_frame(const RslContext& context) {
  return kept<T>(*context.GetGlobalStorage());
}
template <class T> T& of_grid(const RslContext& context) {
  return kept<T>(*context.GetLocalStorage());
}

/// Bytes that Option "limits" "octreememory" of the scene leaves, inside a call.
inline size_t octree_memory(size_t otherwise) {
  RxInfoType_t type;
  int count = 0;
  float kilobytes = 0;
  const bool given = RxOption("limits:octreememory", &kilobytes, sizeof kilobytes, &type, &count) == 0;
  return given && kilobytes > 0 ? static_cast<size_t>(kilobytes) * 1024 : otherwise;
}

inline subsurface::Vec3 vec3(const float* three) {
  return {three[0], three[1], three[2]};
}
inline void store(subsurface::Vec3 v, float* three) {
  three[0] = v.x, three[1] = v.y, three[2] = v.z;
}

} // namespace subsurface_plugin
