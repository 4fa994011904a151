// Embree's functions, from its shared library, which is loaded when a world for rays is first made: to map
// and to relocate it takes a thirtieth of what a small picture takes, and most pictures have no rays. Works
// with Embree 3 and 4. Read next: embree_world.h, behind which alone these are called.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <string>

#if RTC_VERSION_MAJOR >= 4
#define SL_EMBREE_4(X) X(rtcSetGeometryEnableFilterFunctionFromArguments)
#else
#define SL_EMBREE_4(X)
#endif
#define SL_EMBREE(X)                                                                                         \
  X(rtcNewDevice)                                                                                            \
  X(rtcReleaseDevice)                                                                                        \
  X(rtcSetDeviceMemoryMonitorFunction)                                                                       \
  X(rtcNewScene)                                                                                             \
  X(rtcReleaseScene)                                                                                         \
  X(rtcSetSceneFlags)                                                                                        \
  X(rtcCommitScene)                                                                                          \
  X(rtcNewGeometry)                                                                                          \
  X(rtcReleaseGeometry)                                                                                      \
  X(rtcAttachGeometry)                                                                                       \
  X(rtcCommitGeometry)                                                                                       \
  X(rtcSetGeometryTimeStepCount)                                                                             \
  X(rtcSetNewGeometryBuffer)                                                                                 \
  X(rtcSetGeometryUserPrimitiveCount)                                                                        \
  X(rtcSetGeometryUserData)                                                                                  \
  X(rtcSetGeometryBoundsFunction)                                                                            \
  X(rtcSetGeometryIntersectFunction)                                                                         \
  X(rtcSetGeometryOccludedFunction)                                                                          \
  X(rtcIntersect1)                                                                                           \
  X(rtcOccluded1)                                                                                            \
  SL_EMBREE_4(X)

namespace render {

struct EmbreeLibrary {
  /// `file`: as dlopen() finds it. Never unloaded: it has threads of its own.
  explicit EmbreeLibrary(const char* file);
  /// The one this was built with.
  static const char* usual_file();

  std::string problem; ///< why there are no functions; empty: there are
#define SL_FUNCTION(name) decltype(&::name) name = nullptr;
  SL_EMBREE(SL_FUNCTION)
#undef SL_FUNCTION
};

/// Loaded at the first call; called for every ray.
inline const EmbreeLibrary& embree() {
  static const EmbreeLibrary kLibrary(EmbreeLibrary::usual_file());
  return kLibrary;
}

} // namespace render
