// What a plug-in of either kind can ask the renderer during a call: noise, spaces, attributes, options. For C and C++.
// Outside of a call (init, shutdown) only the noises are served; the others then say that nothing is found.
//
// RxAttribute, RxOption, RxRendererInfo: 0 when found, with its type and number of items; -1 when there is none of the
// name, or the bytes needed when `length` of them are not enough. Strings are given as addresses (char*) of texts that
// live as long as the renderer.
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

/// The renderer's side; filled in by the program that opens the plug-in.
typedef struct AnemonePluginServices {
  int version;
  /// kind: 0 noise, 1 pnoise, 2 cellnoise. 0: done.
  int (*noise)(int kind, int in_dimension, const float* in, const float* period, int out_dimension, float* out);
  /// Of points: kind 0; vectors 1; normals 2. 0: done, -1: no such space, or no call is under way.
  int (*transform)(const char* from, const char* to, int kind, int count, float (*points)[3]);
  int (*matrix)(const char* from, const char* to, float* sixteen);
  /// kind: 0 attribute, 1 option, 2 rendererinfo.
  int (*query)(int kind, const char* name, void* result, int length, RxInfoType_t* type, int* count);
} AnemonePluginServices;
#define ANEMONE_PLUGIN_SERVICES 1

extern __attribute__((weak, visibility("default"))) const AnemonePluginServices* anemone_plugin_services;
__attribute__((weak, visibility("default"))) const AnemonePluginServices* anemone_plugin_services = NULL;

#define ANEMONE_INLINE static __inline__ __attribute__((unused))

ANEMONE_INLINE int RxNoise(int in_dimension, float* in, int out_dimension, float* out) {
  const AnemonePluginServices* s = anemone_plugin_services;
  return s ? s->noise(0, in_dimension, in, NULL, out_dimension, out) : -1;
}
ANEMONE_INLINE int RxPNoise(int in_dimension, float* in, float* period, int out_dimension, float* out) {
  const AnemonePluginServices* s = anemone_plugin_services;
  return s ? s->noise(1, in_dimension, in, period, out_dimension, out) : -1;
}
ANEMONE_INLINE int RxCellNoise(int in_dimension, float* in, int out_dimension, float* out) {
  const AnemonePluginServices* s = anemone_plugin_services;
  return s ? s->noise(2, in_dimension, in, NULL, out_dimension, out) : -1;
}
/// The matrix from one space to another; `time` is ignored: grids are shaded at one time.
ANEMONE_INLINE int RxTransform(const char* from, const char* to, float time, float matrix[4][4]) {
  const AnemonePluginServices* s = anemone_plugin_services;
  (void)time;
  return s ? s->matrix(from, to, &matrix[0][0]) : -1;
}
ANEMONE_INLINE int RxTransformPoints(const char* from, const char* to, int count, float points[][3], float time) {
  const AnemonePluginServices* s = anemone_plugin_services;
  (void)time;
  return s ? s->transform(from, to, 0, count, points) : -1;
}
ANEMONE_INLINE int RxAttribute(const char* name, void* result, int length, RxInfoType_t* type, int* count) {
  const AnemonePluginServices* s = anemone_plugin_services;
  return s ? s->query(0, name, result, length, type, count) : -1;
}
ANEMONE_INLINE int RxOption(const char* name, void* result, int length, RxInfoType_t* type, int* count) {
  const AnemonePluginServices* s = anemone_plugin_services;
  return s ? s->query(1, name, result, length, type, count) : -1;
}
ANEMONE_INLINE int RxRendererInfo(const char* name, void* result, int length, RxInfoType_t* type, int* count) {
  const AnemonePluginServices* s = anemone_plugin_services;
  return s ? s->query(2, name, result, length, type, count) : -1;
}

#ifdef __cplusplus
}
#endif
