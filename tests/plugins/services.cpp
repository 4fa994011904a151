// What plug-ins ask of the program: storage of three lives, messages, locks, statistics, noise, spaces,
// attributes; and when their functions are called in a frame, as lines of the file LIFE_LOG.
#include "RslPlugin.h"
#include "rx.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

namespace {

void note(const char* what) {
  const char* name = getenv("LIFE_LOG");
  FILE* f = name ? fopen(name, "a") : NULL;
  if (!f) return;
  fprintf(f, "%s\n", what);
  fclose(f);
}

float seconds = 1.5f;
RixMutex* guard = NULL;

void library_init(RixContext* context) {
  note("library init");
  guard = static_cast<RixThreadUtils*>(context->GetRixInterface(k_RixThreadUtils))->NewMutex();
  static_cast<RixStats*>(context->GetRixInterface(k_RixStats))
      ->AddTimerStat(&seconds, "services", "time it took");
}
void library_cleanup(RixContext*) {
  note("library cleanup");
  delete guard;
}
void init(RixContext*) {
  note("init");
}
void cleanup(RixContext*) {
  note("cleanup");
}
void begin(RixContext*) {
  note("begin");
}
void end(RixContext*) {
  note("end");
}
void release(RixContext*, void* data) {
  note(static_cast<const char*>(data));
}

// How often it was called with this storage: of the grid, the thread, the frame.
int visits(RslContext* context, int, const RslArg* argv[]) {
  static int counts[3][1000];
  static int used[3];
  RixStorage* storages[] = {context->GetLocalStorage(), context->GetThreadStorage(),
                            context->GetGlobalStorage()};
  RslColorIter result(argv[0]);
  guard->Lock();
  for (int i = 0; i < 3; ++i) {
    storages[i]->Lock();
    int* count = static_cast<int*>(storages[i]->Get("visits"));
    if (!count) {
      count = &counts[i][used[i]++];
      static const char* kNames[] = {"end of grid", "end of thread", "end of frame"};
      storages[i]->Set("visits", count);
      storages[i]->Set("note", const_cast<char*>(kNames[i]), release);
    }
    (*result)[i] = static_cast<float>(++*count);
    storages[i]->Unlock();
  }
  guard->Unlock();
  return 0;
}

int tell(RslContext* context, int, const RslArg*[]) {
  RixMessages* messages = static_cast<RixMessages*>(context->GetRixInterface(k_RixMessages));
  messages->Error("no %s left", "cheese");
  messages->Warning("%d crumbs", 3);
  messages->Info("a good %s", "year");
  return context->GetRixInterface(k_RixSamplingPattern) != NULL; // not served
}

// red: noise, green: x in "shader" space, blue: attribute "user:size" and its count, or -1.
int ask(RslContext* context, int, const RslArg* argv[]) {
  RslColorIter result(argv[0]);
  RslPointIter p(argv[1]);
  for (unsigned int i = 0; i < argv[0]->NumValues(); ++i, ++result, ++p) {
    float noise = -1, point[1][3] = {{(*p)[0], (*p)[1], (*p)[2]}};
    RxNoise(3, *p, 1, &noise);
    (*result)[0] = noise;
    (*result)[1] = RxTransformPoints("current", "mine", 1, point, 0) ? -1 : point[0][0];
    float size[2] = {0, 0};
    RxInfoType_t type = RxInfoMatrix;
    int count = 0;
    const bool found = RxAttribute("user:size", size, sizeof size, &type, &count) == 0 && type == RxInfoFloat;
    const bool short_buffer = RxAttribute("user:size", size, 1, &type, &count) == sizeof(float);
    (*result)[2] = found && short_buffer ? size[0] + static_cast<float>(count) : -1;
  }
  float unused;
  if (RxNoise(9, &unused, 1, &unused) != -1) return 3;
  return RxGetRixContext() == static_cast<RixContext*>(context) ? 0 : 4;
}

// Lookups of each kind: the first three numbers they give, or what they return.
int maps(RslContext*, int, const RslArg* argv[]) {
  RslColorIter result(argv[0]);
  RslPointIter p(argv[1]);
  RslStringIter what(argv[2]), map(argv[3]);
  float blur = 0.5f, width = 2;
  const char* filter = "box";
  char* tokens[] = {const_cast<char*>("uniform float blur"), const_cast<char*>("cheese")};
  void* values[] = {&blur, &blur};
  for (unsigned int i = 0; i < argv[0]->NumValues(); ++i, ++result, ++p) {
    float got[5] = {-1, -1, -1, -1, -1};
    const float x = (*p)[0];
    const float corner[4][3] = {{x, 1, 0}, {x + 1, 1, 0}, {x, 3, 0}, {x + 1, 3, 0}};
    RxInfoType_t type = RxInfoMatrix;
    int status = -2, count = 0;
    if (!strcmp(*what, "texture"))
      status = RxTexture(*map, 2, 5, x, 0, x + 1, 0, x, 3, x + 1, 3, got, "width", &width, "filter", &filter,
                         NULL);
    else if (!strcmp(*what, "textureV"))
      status = RxTextureV(*map, 0, 1, x, 0, x + 1, 0, x + 1, 3, x, 3, got, 2, tokens, values);
    else if (!strcmp(*what, "environment"))
      status = RxEnvironment(*map, 0, 3, corner[0], corner[1], corner[2], corner[3], got, NULL);
    else if (!strcmp(*what, "environmentV"))
      status = RxEnvironmentV(*map, 1, 3, corner[0], corner[1], corner[2], corner[3], got, 1, tokens, values);
    else if (!strcmp(*what, "shadow"))
      status = RxShadow(*map, 0, corner[0], corner[1], corner[2], corner[3], got, "bias", &blur, NULL);
    else if (!strcmp(*what, "shadowV"))
      status = RxShadowV(*map, 0, corner[0], corner[1], corner[2], corner[3], got, 1, tokens, values);
    else if (!strcmp(*what, "info"))
      status = RxTextureInfo(*map, "resolution", got, sizeof got, &type, &count);
    (*result)[0] = status ? static_cast<float>(status) : got[0];
    (*result)[1] = got[1];
    (*result)[2] = !strcmp(*what, "texture") ? got[4]
                   : !strcmp(*what, "info")  ? static_cast<float>(count)
                                             : got[2];
  }
  return 0;
}

// The same for all points with one call each.
int many(RslContext*, int, const RslArg* argv[]) {
  RslColorIter result(argv[0]);
  RslPointIter p(argv[1]);
  RslStringIter what(argv[2]), map(argv[3]);
  const unsigned int n = argv[0]->NumValues();
  float s[4][16], t[4][16], corner[4][3 * 16], got[5 * 16] = {};
  float blur = 0.5f;
  char* tokens[] = {const_cast<char*>("blur")};
  void* values[] = {&blur};
  if (n > 16) return 9;
  for (unsigned int i = 0; i < n; ++i, ++p)
    for (int k = 0; k < 4; ++k) {
      s[k][i] = corner[k][3 * i] = (*p)[0] + static_cast<float>(k % 2);
      t[k][i] = k < 2 ? 0.0f : 3.0f;
      corner[k][3 * i + 1] = k < 2 ? 1.0f : 3.0f;
      corner[k][3 * i + 2] = 0;
    }
  const int points = static_cast<int>(n);
  int status = -2, channels = 3;
  if (!strcmp(*what, "texture"))
    status = RxTexturePoints(*map, points, 2, channels = 5, s[0], t[0], s[1], t[1], s[2], t[2], s[3], t[3],
                             got, "blur", &blur, NULL);
  else if (!strcmp(*what, "textureV"))
    status = RxTexturePointsV(*map, points, 0, 3, s[0], t[0], s[1], t[1], s[2], t[2], s[3], t[3], got, 1,
                              tokens, values);
  else if (!strcmp(*what, "environment"))
    status = RxEnvironmentPoints(*map, points, 0, 3, corner[0], corner[1], corner[2], corner[3], got, NULL);
  else if (!strcmp(*what, "environmentV"))
    status = RxEnvironmentPointsV(*map, points, 1, 3, corner[0], corner[1], corner[2], corner[3], got, 1,
                                  tokens, values);
  else if (!strcmp(*what, "shadow"))
    status = RxShadowPoints(*map, points, 0, corner[0], corner[1], corner[2], corner[3], got, NULL),
    channels = 1;
  else if (!strcmp(*what, "shadowV"))
    status =
        RxShadowPointsV(*map, points, 0, corner[0], corner[1], corner[2], corner[3], got, 1, tokens, values),
    channels = 1;
  for (unsigned int i = 0; i < n; ++i, ++result) {
    const float* of_point = got + static_cast<unsigned int>(channels) * i;
    (*result)[0] = status ? static_cast<float>(status) : of_point[0];
    (*result)[1] = of_point[channels > 1 ? 1 : 0];
    (*result)[2] = of_point[channels - 1];
  }
  return 0;
}

// The line, and 1 when the file is that of the shader.
int where(RslContext*, int, const RslArg* argv[]) {
  RslColorIter result(argv[0]);
  char* file = nullptr;
  int line = -1;
  const int status = RxGetRIBFileContext(&line, &file);
  for (unsigned int i = 0; i < argv[0]->NumValues(); ++i, ++result) {
    (*result)[0] = static_cast<float>(status);
    (*result)[1] = static_cast<float>(line);
    (*result)[2] = file && !strcmp(file, "test.sl");
  }
  return 0;
}

RslFunction functions[] = {{"uniform color sv_visits()", visits, init, cleanup, begin, end},
                           {"void sv_tell()", tell, NULL, NULL},
                           {"color sv_ask(point)", ask, NULL, NULL},
                           {"color sv_maps(point, uniform string, uniform string)", maps, NULL, NULL},
                           {"color sv_many(point, uniform string, uniform string)", many, NULL, NULL},
                           {"uniform color sv_where()", where, NULL, NULL},
                           {NULL}};

} // namespace

RSLEXPORT RslFunctionTable RslPublicFunctions(functions, library_init, library_cleanup);
