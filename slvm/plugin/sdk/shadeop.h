// Functions for shaders that are called once for each point ("DSO shadeops"), in C or C++. A source includes
// this, is compiled to a shared library and put into a folder that --dso or ANEMONE_DSO_PATH names.
// docs/plugins.md tells more.
//
//   SHADEOP_TABLE(sqr) = {{"float sqr_f(float)", "sqr_init", "sqr_shutdown"}, {"point sqr_p(point)", "", ""},
//   {""}}; SHADEOP_INIT(sqr_init) { return NULL; } SHADEOP_SHUTDOWN(sqr_shutdown) {} SHADEOP(sqr_f) { float x
//   = *(float*)argv[1]; *(float*)argv[0] = x * x; return 0; }
//
// The table's name is what shaders call. An entry is a prototype, "result function(types)", and the names of
// functions that are called before the first and after the last call, or "". Several entries are overloads.
// The last is {""}. argv[0] is the result, argv[1] and so on are the arguments; all are addresses:
//   float           1 float       point vector normal color   3 floats       matrix   16 floats, row by row
//   string          STRING_DESC   float[3], color[]...        the elements one after the other; of strings
//   char*
// A parameter that is `output` in the prototype is stored to. In a prototype without any, arguments that are
// local variables or output parameters of the shader of just that type are.
#pragma once

#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
#define ANEMONE_EXTERN_C extern "C"
#define ANEMONE_EXTERN_C_VARIABLE extern "C"
#else
#define ANEMONE_EXTERN_C
#define ANEMONE_EXTERN_C_VARIABLE extern
#endif
#define ANEMONE_EXPORT __attribute__((visibility("default")))
#ifndef EXPORT
#define EXPORT ANEMONE_EXPORT
#endif

typedef struct ANEMONE_SHADEOP_SPEC {
  const char* definition;
  const char* init;
  const char* shutdown;
} SHADEOP_SPEC;

/// A string. To return one either copy it to `s`, if `bufflen` bytes are enough, or set `s` to memory of your
/// own that stays as it is until the next call (ASSIGN_STRING sees to it). Do not free what `s` was.
typedef struct ANEMONE_STRING_DESC {
  char* s;
  union {
    int bufflen;
    int buflen; /* as others spell it */
  };
} STRING_DESC;

#define SHADEOP_TABLE(name)                                                                                  \
  ANEMONE_EXTERN_C_VARIABLE ANEMONE_EXPORT SHADEOP_SPEC name##_shadeops[];                                   \
  SHADEOP_SPEC name##_shadeops[]

/// `ctx`: a number for each thread; `texturectx`: nothing. Called before the first call in each thread; what
/// it returns is `initdata`. Functions with the same init and shutdown share it.
#define SHADEOP_INIT(function) ANEMONE_EXTERN_C ANEMONE_EXPORT void* function(int ctx, void* texturectx)
#define SHADEOP(function) ANEMONE_EXTERN_C ANEMONE_EXPORT int function(void* initdata, int argc, void** argv)
#define SHADEOP_SHUTDOWN(function) ANEMONE_EXTERN_C ANEMONE_EXPORT void function(void* initdata)
#define SHADEOP_CLEANUP(function) SHADEOP_SHUTDOWN(function)

/// The functions of this table may run in several threads at once. Without it calls of the library take
/// turns, a grid at a time.
#define SHADEOP_THREADSAFE(name)                                                                             \
  ANEMONE_EXTERN_C_VARIABLE ANEMONE_EXPORT const int name##_threadsafe;                                      \
  const int name##_threadsafe = 1

/// Of each thread, the last strings that ASSIGN_STRING kept. All of them end with the library.
typedef struct ANEMONE_KEPT_STRINGS {
  struct ANEMONE_KEPT_STRINGS* next;
  unsigned turn;
  char* text[16];
} ANEMONE_KEPT_STRINGS;
static ANEMONE_KEPT_STRINGS* volatile anemone_all_kept __attribute__((unused)) = NULL;

static __inline__ __attribute__((unused)) char* anemone_keep_string(const char* text) {
  static __thread ANEMONE_KEPT_STRINGS* mine;
  char** slot;
  size_t size = strlen(text) + 1;
  char* copy = (char*)malloc(size);
  if (copy) memcpy(copy, text, size);
  if (!mine) {
    mine = (ANEMONE_KEPT_STRINGS*)calloc(1, sizeof *mine);
    if (!mine) return copy;
    do
      mine->next = anemone_all_kept;
    while (!__sync_bool_compare_and_swap(&anemone_all_kept, mine->next, mine));
  }
  slot = &mine->text[mine->turn++ % 16];
  free(*slot);
  return *slot = copy;
}
static __attribute__((destructor)) void anemone_free_kept(void) {
  while (anemone_all_kept) {
    ANEMONE_KEPT_STRINGS* kept = anemone_all_kept;
    int i;
    anemone_all_kept = kept->next;
    for (i = 0; i < 16; ++i)
      free(kept->text[i]);
    free(kept);
  }
}
#define ASSIGN_STRING(variable, text) ((variable) = anemone_keep_string(text))
