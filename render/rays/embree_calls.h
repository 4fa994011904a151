// What differs between Embree 3 and 4: how a ray is shot with a filter function, and what is built for that.
#pragma once

#include "render/rays/embree_library.h"

namespace render {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
inline void init_context(QueryContext& c) {
  rtcInitRayQueryContext(&c);
}
inline constexpr RTCSceneFlags kFilterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
inline void allow_filter(RTCGeometry g) {
  embree().rtcSetGeometryEnableFilterFunctionFromArguments(g, true);
}
inline void intersect(RTCScene scene, QueryContext& c, RTCFilterFunctionN filter, RTCRayHit& ray) {
  RTCIntersectArguments a;
  rtcInitIntersectArguments(&a);
  a.context = &c;
  a.filter = filter;
  embree().rtcIntersect1(scene, &ray, &a);
}
inline void occluded(RTCScene scene, QueryContext& c, RTCFilterFunctionN filter, RTCRay& ray) {
  RTCOccludedArguments a;
  rtcInitOccludedArguments(&a);
  a.context = &c;
  a.filter = filter;
  embree().rtcOccluded1(scene, &ray, &a);
}
#else
using QueryContext = RTCIntersectContext;
inline void init_context(QueryContext& c) {
  rtcInitIntersectContext(&c);
}
inline constexpr RTCSceneFlags kFilterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
inline void allow_filter(RTCGeometry) {}
inline void intersect(RTCScene scene, QueryContext& c, RTCFilterFunctionN filter, RTCRayHit& ray) {
  c.filter = filter;
  embree().rtcIntersect1(scene, &c, &ray);
}
inline void occluded(RTCScene scene, QueryContext& c, RTCFilterFunctionN filter, RTCRay& ray) {
  c.filter = filter;
  embree().rtcOccluded1(scene, &c, &ray);
}
#endif

} // namespace render
