// What a plug-in of either kind can ask the renderer during a call: noise, spaces, attributes, options. For C
// and C++. Outside of a call (init, shutdown) only the noises are served; the others then say that nothing is
// found.
//
// RxAttribute, RxOption, RxRendererInfo: 0 when found, with its type and number of items; -1 when there is
// none of the name, or the bytes needed when `length` of them are not enough. Strings are given as addresses
// (char*) of texts that live as long as the renderer.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  RxInfoFloat,
  RxInfoInteger,
  RxInfoStringV,
  RxInfoColor,
  RxInfoNormal,
  RxInfoVector,
  RxInfoPoint,
  RxInfoHPoint,
  RxInfoMPoint,
  RxInfoMatrix
} RxInfoType_t;

/// The renderer's side. `call` is the one under way; null outside of calls.
typedef struct AnemonePluginServices {
  int version;
  /// kind: 0 noise, 1 pnoise, 2 cellnoise. 0: done; -1: no such dimensions.
  int (*noise)(int kind, int in_dimension, const float* in, const float* period, int out_dimension,
               float* out);
  /// The matrix from one space to another, row by row. 0: done; -1: no such space, or no call is under way.
  int (*matrix)(void* call, const char* from, const char* to, float* sixteen);
  /// kind: 0 attribute, 1 option, 2 rendererinfo.
  int (*query)(void* call, int kind, const char* name, void* result, int length, RxInfoType_t* type,
               int* count);
  /// A RixContext.
  void* (*context)(void* call);
} AnemonePluginServices;
#define ANEMONE_PLUGIN_SERVICES 1

#define ANEMONE_SHARED __attribute__((weak, visibility("default")))
#define ANEMONE_INLINE static __inline__ __attribute__((unused))

// One of each in the whole plug-in, for each thread: what the program said last.
extern ANEMONE_SHARED __thread const AnemonePluginServices* anemone_services;
ANEMONE_SHARED __thread const AnemonePluginServices* anemone_services = NULL;
extern ANEMONE_SHARED __thread void* anemone_call;
ANEMONE_SHARED __thread void* anemone_call = NULL;
/// Called by the program before and after each of its calls, in the thread of the call.
ANEMONE_SHARED void anemone_enter(const AnemonePluginServices* services, void* call);
void anemone_enter(const AnemonePluginServices* services, void* call) {
  anemone_services = services && services->version == ANEMONE_PLUGIN_SERVICES ? services : NULL;
  anemone_call = call;
}

ANEMONE_INLINE int RxNoise(int in_dimension, float* in, int out_dimension, float* out) {
  return anemone_services ? anemone_services->noise(0, in_dimension, in, NULL, out_dimension, out) : -1;
}
ANEMONE_INLINE int RxPNoise(int in_dimension, float* in, float* period, int out_dimension, float* out) {
  return anemone_services ? anemone_services->noise(1, in_dimension, in, period, out_dimension, out) : -1;
}
ANEMONE_INLINE int RxCellNoise(int in_dimension, float* in, int out_dimension, float* out) {
  return anemone_services ? anemone_services->noise(2, in_dimension, in, NULL, out_dimension, out) : -1;
}
/// The matrix from one space to another. `time` does not matter: a grid is shaded at one time.
ANEMONE_INLINE int RxTransform(const char* from, const char* to, float time, float matrix[4][4]) {
  (void)time;
  return anemone_services ? anemone_services->matrix(anemone_call, from, to, &matrix[0][0]) : -1;
}
ANEMONE_INLINE int RxTransformPoints(const char* from, const char* to, int count, float points[][3],
                                     float time) {
  float m[4][4];
  int i;
  if (RxTransform(from, to, time, m)) return -1;
  for (i = 0; i < count; ++i) {
    float* p = points[i];
    float x = p[0] * m[0][0] + p[1] * m[1][0] + p[2] * m[2][0] + m[3][0];
    float y = p[0] * m[0][1] + p[1] * m[1][1] + p[2] * m[2][1] + m[3][1];
    float z = p[0] * m[0][2] + p[1] * m[1][2] + p[2] * m[2][2] + m[3][2];
    float w = p[0] * m[0][3] + p[1] * m[1][3] + p[2] * m[2][3] + m[3][3];
    if (w == 0) w = 1;
    p[0] = x / w;
    p[1] = y / w;
    p[2] = z / w;
  }
  return 0;
}
ANEMONE_INLINE int RxAttribute(const char* name, void* result, int length, RxInfoType_t* type, int* count) {
  return anemone_services ? anemone_services->query(anemone_call, 0, name, result, length, type, count) : -1;
}
ANEMONE_INLINE int RxOption(const char* name, void* result, int length, RxInfoType_t* type, int* count) {
  return anemone_services ? anemone_services->query(anemone_call, 1, name, result, length, type, count) : -1;
}
ANEMONE_INLINE int RxRendererInfo(const char* name, void* result, int length, RxInfoType_t* type,
                                  int* count) {
  return anemone_services ? anemone_services->query(anemone_call, 2, name, result, length, type, count) : -1;
}

#ifdef __cplusplus
}
#endif

#ifdef __cplusplus
class RixContext; // RixInterfaces.h
static inline RixContext* RxGetRixContext() {
  return anemone_services ? static_cast<RixContext*>(anemone_services->context(anemone_call)) : NULL;
}
#endif
