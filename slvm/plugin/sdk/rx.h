// What a plug-in of either kind can ask the renderer during a call: noise, spaces, attributes, options. For C
// and C++. Outside of a call (init, shutdown) only the noises are served; the others then say that nothing is
// found.
//
// RxAttribute, RxOption, RxRendererInfo: 0 when found, with its type and number of items; -1 when there is
// none of the name, or the bytes needed when `length` of them are not enough. Strings are given as addresses
// (char*) of texts that live as long as the renderer; what a scene declares as int as ints.
#pragma once

#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <sys/random.h>
#include <sys/types.h>

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

/// A lookup in a map, over as many regions as there are points. kind: 0 texture, 1 environment, 2 shadow.
typedef struct AnemoneLookup {
  const char* function; /* that asks: for messages */
  int kind;
  const char* map;
  int first_channel, channels;
  int points;
  /* s and t, or directions, or points in "current" space: component c of corner k of point i is
     corner[k][c][i * stride] */
  const float* corner[4][3];
  int stride;
  float own[4][3]; /* what they point to when there is one point */
  int tokens;
  char** token;
  void** value;
  float* result; /* the channels of each point side by side */
} AnemoneLookup;

/// A point to be written to a file of points, or looked up in one. N and the point are in "current" space.
typedef struct AnemoneCloudPoint {
  const char* function; /* that asks: for messages */
  int write;
  const char* file;
  const float *point, *normal;
  float radius;
  int tokens;
  char** token;
  void** value;
} AnemoneCloudPoint;

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
  /// 0: done; -1: the map cannot be used (there is a message), or no call is under way.
  int (*lookup)(void* call, const AnemoneLookup* lookup);
  int (*texture_info)(void* call, const char* map, const char* name, void* result, int length,
                      RxInfoType_t* type, int* count);
  /// Of the statement under way: the line of the shader and, as a text that lives on, its file. 0: done.
  int (*place)(void* call, int* line, const char** file);
  /// 0: done; -1: not (there is a message, unless there was nothing near the point).
  int (*cloud_point)(void* call, const AnemoneCloudPoint* point);
  /// All of a level of a map: channels of a texel together, rows from the top. 0: done.
  int (*texels)(void* call, const char* map, int channels, const int* channel, int level, int face,
                float* result);
  /// A message about a function that this program does not have; -1.
  int (*missing)(void* call, const char* function, const char* advice);
} AnemonePluginServices;
#define ANEMONE_PLUGIN_SERVICES 4

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
  anemone_services = services && services->version >= ANEMONE_PLUGIN_SERVICES ? services : NULL;
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

// Lookups over the region between four corners, which come row by row, as those of a patch. nchannels values
// from firstchannel on are stored in `result`; of shadows one, 1 in full shadow. Optional arguments are those
// of texture(): pairs of a token and the address of a float ("blur", "width", "samples", "fill", "bias"...)
// or of a char* ("filter"), ended by RI_NULL; in the forms that end in V, n of them. 0 when all went well.
#define ANEMONE_MOST_TOKENS 32

ANEMONE_INLINE int anemone_look_up(AnemoneLookup* lookup, int n, char* tokens[], void* values[]) {
  lookup->tokens = n;
  lookup->token = tokens;
  lookup->value = values;
  return anemone_services ? anemone_services->lookup(anemone_call, lookup) : -1;
}
ANEMONE_INLINE int anemone_take_tokens(va_list list, char* tokens[], void* values[]) {
  int n = 0;
  char* token;
  while (n < ANEMONE_MOST_TOKENS && (token = va_arg(list, char*)) != NULL) {
    tokens[n] = token;
    values[n++] = va_arg(list, void*);
  }
  return n;
}
ANEMONE_INLINE int anemone_look_up_list(AnemoneLookup* lookup, va_list list) {
  char* tokens[ANEMONE_MOST_TOKENS];
  void* values[ANEMONE_MOST_TOKENS];
  const int n = anemone_take_tokens(list, tokens, values);
  return anemone_look_up(lookup, n, tokens, values);
}
ANEMONE_INLINE void anemone_set_lookup(AnemoneLookup* lookup, const char* function, int kind, const char* map,
                                       int points, int first, int channels, float* result) {
  memset(lookup, 0, sizeof *lookup);
  lookup->function = function;
  lookup->kind = kind;
  lookup->map = map;
  lookup->points = points;
  lookup->first_channel = first;
  lookup->channels = channels;
  lookup->result = result;
}
ANEMONE_INLINE void anemone_set_own(AnemoneLookup* lookup) {
  int k, c;
  for (k = 0; k < 4; ++k)
    for (c = 0; c < 3; ++c)
      lookup->corner[k][c] = &lookup->own[k][c];
}
ANEMONE_INLINE void anemone_set_st(AnemoneLookup* lookup, float s0, float t0, float s1, float t1, float s2,
                                   float t2, float s3, float t3) {
  float st[8];
  int k;
  st[0] = s0, st[1] = t0, st[2] = s1, st[3] = t1, st[4] = s2, st[5] = t2, st[6] = s3, st[7] = t3;
  for (k = 0; k < 8; ++k)
    lookup->own[k / 2][k % 2] = st[k];
  anemone_set_own(lookup);
}
ANEMONE_INLINE void anemone_set_points(AnemoneLookup* lookup, const float* p0, const float* p1,
                                       const float* p2, const float* p3) {
  memcpy(lookup->own[0], p0, 3 * sizeof(float));
  memcpy(lookup->own[1], p1, 3 * sizeof(float));
  memcpy(lookup->own[2], p2, 3 * sizeof(float));
  memcpy(lookup->own[3], p3, 3 * sizeof(float));
  anemone_set_own(lookup);
}
ANEMONE_INLINE void anemone_set_corner(AnemoneLookup* lookup, int k, const float* x, const float* y,
                                       const float* z, int stride) {
  lookup->corner[k][0] = x;
  lookup->corner[k][1] = y;
  lookup->corner[k][2] = z;
  lookup->stride = stride;
}
ANEMONE_INLINE void anemone_set_many_points(AnemoneLookup* lookup, const float* p0, const float* p1,
                                            const float* p2, const float* p3) {
  anemone_set_corner(lookup, 0, p0, p0 + 1, p0 + 2, 3);
  anemone_set_corner(lookup, 1, p1, p1 + 1, p1 + 2, 3);
  anemone_set_corner(lookup, 2, p2, p2 + 1, p2 + 2, 3);
  anemone_set_corner(lookup, 3, p3, p3 + 1, p3 + 2, 3);
}

ANEMONE_INLINE int RxTextureV(const char* map, int firstchannel, int nchannels, float s0, float t0, float s1,
                              float t1, float s2, float t2, float s3, float t3, float* result, int n,
                              char* tokens[], void* values[]) {
  AnemoneLookup lookup;
  anemone_set_lookup(&lookup, "RxTexture", 0, map, 1, firstchannel, nchannels, result);
  anemone_set_st(&lookup, s0, t0, s1, t1, s2, t2, s3, t3);
  return anemone_look_up(&lookup, n, tokens, values);
}
ANEMONE_INLINE int RxTexture(const char* map, int firstchannel, int nchannels, float s0, float t0, float s1,
                             float t1, float s2, float t2, float s3, float t3, float* result, ...) {
  AnemoneLookup lookup;
  va_list list;
  int status;
  anemone_set_lookup(&lookup, "RxTexture", 0, map, 1, firstchannel, nchannels, result);
  anemone_set_st(&lookup, s0, t0, s1, t1, s2, t2, s3, t3);
  va_start(list, result);
  status = anemone_look_up_list(&lookup, list);
  va_end(list);
  return status;
}
ANEMONE_INLINE int RxEnvironmentV(const char* map, int firstchannel, int nchannels, const float* dir0,
                                  const float* dir1, const float* dir2, const float* dir3, float* result,
                                  int n, char* tokens[], void* values[]) {
  AnemoneLookup lookup;
  anemone_set_lookup(&lookup, "RxEnvironment", 1, map, 1, firstchannel, nchannels, result);
  anemone_set_points(&lookup, dir0, dir1, dir2, dir3);
  return anemone_look_up(&lookup, n, tokens, values);
}
ANEMONE_INLINE int RxEnvironment(const char* map, int firstchannel, int nchannels, const float* dir0,
                                 const float* dir1, const float* dir2, const float* dir3, float* result,
                                 ...) {
  AnemoneLookup lookup;
  va_list list;
  int status;
  anemone_set_lookup(&lookup, "RxEnvironment", 1, map, 1, firstchannel, nchannels, result);
  anemone_set_points(&lookup, dir0, dir1, dir2, dir3);
  va_start(list, result);
  status = anemone_look_up_list(&lookup, list);
  va_end(list);
  return status;
}
ANEMONE_INLINE int RxShadowV(const char* map, int firstchannel, const float* P0, const float* P1,
                             const float* P2, const float* P3, float* result, int n, char* tokens[],
                             void* values[]) {
  AnemoneLookup lookup;
  anemone_set_lookup(&lookup, "RxShadow", 2, map, 1, firstchannel, 1, result);
  anemone_set_points(&lookup, P0, P1, P2, P3);
  return anemone_look_up(&lookup, n, tokens, values);
}
ANEMONE_INLINE int RxShadow(const char* map, int firstchannel, const float* P0, const float* P1,
                            const float* P2, const float* P3, float* result, ...) {
  AnemoneLookup lookup;
  va_list list;
  int status;
  anemone_set_lookup(&lookup, "RxShadow", 2, map, 1, firstchannel, 1, result);
  anemone_set_points(&lookup, P0, P1, P2, P3);
  va_start(list, result);
  status = anemone_look_up_list(&lookup, list);
  va_end(list);
  return status;
}

ANEMONE_INLINE void anemone_set_coordinates(AnemoneLookup* lookup, const float* s0, const float* t0,
                                            const float* s1, const float* t1, const float* s2,
                                            const float* t2, const float* s3, const float* t3) {
  anemone_set_corner(lookup, 0, s0, t0, t0, 1);
  anemone_set_corner(lookup, 1, s1, t1, t1, 1);
  anemone_set_corner(lookup, 2, s2, t2, t2, 1);
  anemone_set_corner(lookup, 3, s3, t3, t3, 1);
}

// The same for many points at once: arrays with a number of each point, or with three (dir0, P0...). The
// channels of a point stand side by side in `result`.
ANEMONE_INLINE int RxTexturePointsV(const char* map, int points, int firstchannel, int nchannels, float* s0,
                                    float* t0, float* s1, float* t1, float* s2, float* t2, float* s3,
                                    float* t3, float* result, int n, char* tokens[], void* values[]) {
  AnemoneLookup lookup;
  anemone_set_lookup(&lookup, "RxTexturePoints", 0, map, points, firstchannel, nchannels, result);
  anemone_set_coordinates(&lookup, s0, t0, s1, t1, s2, t2, s3, t3);
  return anemone_look_up(&lookup, n, tokens, values);
}
ANEMONE_INLINE int RxTexturePoints(const char* map, int points, int firstchannel, int nchannels, float* s0,
                                   float* t0, float* s1, float* t1, float* s2, float* t2, float* s3,
                                   float* t3, float* result, ...) {
  AnemoneLookup lookup;
  va_list list;
  int status;
  anemone_set_lookup(&lookup, "RxTexturePoints", 0, map, points, firstchannel, nchannels, result);
  anemone_set_coordinates(&lookup, s0, t0, s1, t1, s2, t2, s3, t3);
  va_start(list, result);
  status = anemone_look_up_list(&lookup, list);
  va_end(list);
  return status;
}
ANEMONE_INLINE int RxEnvironmentPointsV(const char* map, int points, int firstchannel, int nchannels,
                                        float* dir0, float* dir1, float* dir2, float* dir3, float* result,
                                        int n, char* tokens[], void* values[]) {
  AnemoneLookup lookup;
  anemone_set_lookup(&lookup, "RxEnvironmentPoints", 1, map, points, firstchannel, nchannels, result);
  anemone_set_many_points(&lookup, dir0, dir1, dir2, dir3);
  return anemone_look_up(&lookup, n, tokens, values);
}
ANEMONE_INLINE int RxEnvironmentPoints(const char* map, int points, int firstchannel, int nchannels,
                                       float* dir0, float* dir1, float* dir2, float* dir3, float* result,
                                       ...) {
  AnemoneLookup lookup;
  va_list list;
  int status;
  anemone_set_lookup(&lookup, "RxEnvironmentPoints", 1, map, points, firstchannel, nchannels, result);
  anemone_set_many_points(&lookup, dir0, dir1, dir2, dir3);
  va_start(list, result);
  status = anemone_look_up_list(&lookup, list);
  va_end(list);
  return status;
}
ANEMONE_INLINE int RxShadowPointsV(const char* map, int points, int firstchannel, float* P0, float* P1,
                                   float* P2, float* P3, float* result, int n, char* tokens[],
                                   void* values[]) {
  AnemoneLookup lookup;
  anemone_set_lookup(&lookup, "RxShadowPoints", 2, map, points, firstchannel, 1, result);
  anemone_set_many_points(&lookup, P0, P1, P2, P3);
  return anemone_look_up(&lookup, n, tokens, values);
}
ANEMONE_INLINE int RxShadowPoints(const char* map, int points, int firstchannel, float* P0, float* P1,
                                  float* P2, float* P3, float* result, ...) {
  AnemoneLookup lookup;
  va_list list;
  int status;
  anemone_set_lookup(&lookup, "RxShadowPoints", 2, map, points, firstchannel, 1, result);
  anemone_set_many_points(&lookup, P0, P1, P2, P3);
  va_start(list, result);
  status = anemone_look_up_list(&lookup, list);
  va_end(list);
  return status;
}

/// What textureinfo() tells: answers as those of RxAttribute.
ANEMONE_INLINE int RxTextureInfo(const char* map, const char* name, void* result, int length,
                                 RxInfoType_t* type, int* count) {
  return anemone_services
             ? anemone_services->texture_info(anemone_call, map, name, result, length, type, count)
             : -1;
}

/// Whole maps. nchannels channels, those whose numbers are in `channels`, of each texel side by side, rows
/// from the top, as floats (of maps of bytes or shorts 0 to 1). Level 0 is as large as RxTextureInfo() says
/// under "resolution"; each other one half as large, down to a texel. Maps have one face, number 0.
ANEMONE_INLINE int RxTextureGetData(const char* map, int nchannels, int* channels, int level, int face,
                                    void* result) {
  return anemone_services
             ? anemone_services->texels(anemone_call, map, nchannels, channels, level, face, (float*)result)
             : -1;
}

/// Shadows of lights that have a size, from maps that hold more than one depth of a pixel: there are none
/// here. A message says so, and what to do; the result is 0, no shadow.
ANEMONE_INLINE int RxSourceShadowV(const char* map, int firstchannel, const float* P0, const float* P1,
                                   const float* P2, const float* P3, const float* source0,
                                   const float* source1, const float* source2, const float* source3,
                                   float* result, int n, char* tokens[], void* values[]) {
  (void)map, (void)firstchannel, (void)P0, (void)P1, (void)P2, (void)P3, (void)n, (void)tokens, (void)values;
  (void)source0, (void)source1, (void)source2, (void)source3;
  *result = 0;
  return anemone_services
             ? anemone_services->missing(anemone_call, "RxSourceShadow",
                                         "shadow maps have one depth a pixel; RxShadow with a \"blur\" as "
                                         "wide as the light softens their edges")
             : -1;
}
ANEMONE_INLINE int RxSourceShadow(const char* map, int firstchannel, const float* P0, const float* P1,
                                  const float* P2, const float* P3, const float* source0,
                                  const float* source1, const float* source2, const float* source3,
                                  float* result, ...) {
  return RxSourceShadowV(map, firstchannel, P0, P1, P2, P3, source0, source1, source2, source3, result, 0,
                         NULL, NULL);
}

ANEMONE_INLINE int anemone_cloud_point(const char* function, int write, const char* file, const float* point,
                                       const float* normal, float radius, int n, char* tokens[],
                                       void* values[]) {
  AnemoneCloudPoint p;
  p.function = function;
  p.write = write;
  p.file = file;
  p.point = point;
  p.normal = normal;
  p.radius = radius;
  p.tokens = n;
  p.token = tokens;
  p.value = values;
  return anemone_services ? anemone_services->cloud_point(anemone_call, &p) : -1;
}

// Files of points (PLY), with values of their own: pairs of a token with its type ("float heat", "color
// tint"; also vector, normal, point) and the address of the value, ended by RI_NULL, or n of them.
// "coordsystem" (a char*) is the space of the points, "world" when nothing is said; point, normal and radius
// are in "current" space.
//
// RxTexture3d: the means of the points within the filter radius of `point` that do not face away from
// `normal`; with a radius of 0 of the four nearest ones. 0: found; -1: there is nothing, and values stay as
// they are. Nothing that this frame writes is seen before the next.
ANEMONE_INLINE int RxTexture3dV(const char* file, const float* point, const float* normal, float filterradius,
                                int n, char* tokens[], void* values[]) {
  return anemone_cloud_point("RxTexture3d", 0, file, point, normal, filterradius, n, tokens, values);
}
ANEMONE_INLINE int RxTexture3d(const char* file, const float* point, const float* normal, float filterradius,
                               ...) {
  char* tokens[ANEMONE_MOST_TOKENS];
  void* values[ANEMONE_MOST_TOKENS];
  va_list list;
  int n;
  va_start(list, filterradius);
  n = anemone_take_tokens(list, tokens, values);
  va_end(list);
  return RxTexture3dV(file, point, normal, filterradius, n, tokens, values);
}
/// Adds a point, a disc of this radius, to a file, which is written when the frame ends. All points of a file
/// have the same values.
ANEMONE_INLINE int RxBake3dV(const char* file, const float* point, const float* normal, float radius, int n,
                             char* tokens[], void* values[]) {
  return anemone_cloud_point("RxBake3d", 1, file, point, normal, radius, n, tokens, values);
}
ANEMONE_INLINE int RxBake3d(const char* file, const float* point, const float* normal, float radius, ...) {
  char* tokens[ANEMONE_MOST_TOKENS];
  void* values[ANEMONE_MOST_TOKENS];
  va_list list;
  int n;
  va_start(list, radius);
  n = anemone_take_tokens(list, tokens, values);
  va_end(list);
  return RxBake3dV(file, point, normal, radius, n, tokens, values);
}

/// A text that no other call has given, anywhere: a UUID (RFC 9562, version 4) in 36 characters. `text` has
/// room for 64. Needs no call that is under way.
ANEMONE_INLINE void RxUUIDCreateString(char* text) {
  static const char* digits = "0123456789abcdef";
  unsigned char bytes[16];
  size_t i;
  char* to = text;
  for (i = 0; i < sizeof bytes;) {
    ssize_t got = getrandom(bytes + i, sizeof bytes - i, 0);
    if (got > 0) i += (size_t)got;
  }
  bytes[6] = (unsigned char)((bytes[6] & 0x0f) | 0x40);
  bytes[8] = (unsigned char)((bytes[8] & 0x3f) | 0x80);
  for (i = 0; i < sizeof bytes; ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) *to++ = '-';
    *to++ = digits[bytes[i] >> 4];
    *to++ = digits[bytes[i] & 15];
  }
  *to = 0;
}

/// Where the renderer is: a shader is no RIB file, so that it is the line and the file of the shader that
/// makes the call. 0: told; 1: no call is under way.
ANEMONE_INLINE int RxGetRIBFileContext(int* line, char** file) {
  const char* name = NULL;
  int told = anemone_services && anemone_services->place(anemone_call, line, &name) == 0;
  *file = told ? (char*)name : NULL;
  return told ? 0 : 1;
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
