// What plug-ins do with files: points with values, whole maps; and names that no one else has.
#include "RslPlugin.h"
#include "rx.h"

#include <string.h>

namespace {

char* token(const char* text) {
  return const_cast<char*>(text);
}

// A point for each of the grid, with x as "heat" and (x, y, 2) as "tint"; in V form those in "mine" space.
int bake(RslContext*, int argc, const RslArg* argv[]) {
  RslFloatIter result(argv[0]);
  RslPointIter p(argv[1]);
  RslNormalIter n(argv[2]);
  RslStringIter file(argv[3]);
  for (unsigned int i = 0, count = RslArg::NumValues(argc, argv); i < count; ++i, ++result, ++p, ++n) {
    float heat = (*p)[0], tint[3] = {(*p)[0], (*p)[1], 2};
    const char* space = "mine";
    char* tokens[] = {token("float heat"), token("coordsystem")};
    void* values[] = {&heat, &space};
    *result = static_cast<float>(strstr(*file, "mine") ? RxBake3dV(*file, *p, *n, 0.5f, 2, tokens, values)
                                                       : RxBake3d(*file, *p, *n, 0.5f, "uniform float heat",
                                                                  &heat, "color tint", tint, NULL));
  }
  return 0;
}

// status, "heat", the second number of "tint".
int read(RslContext*, int argc, const RslArg* argv[]) {
  RslColorIter result(argv[0]);
  RslPointIter p(argv[1]);
  RslNormalIter n(argv[2]);
  RslStringIter file(argv[3]);
  RslFloatIter radius(argv[4]);
  for (unsigned int i = 0, count = RslArg::NumValues(argc, argv); i < count; ++i, ++result, ++p, ++n) {
    float heat = -1, tint[3] = {-1, -1, -1};
    char* tokens[] = {token("float heat"), token("color tint")};
    void* values[] = {&heat, tint};
    const int status =
        *radius > 5 ? RxTexture3dV(*file, *p, *n, *radius, 1, tokens, values)
                    : RxTexture3d(*file, *p, *n, *radius, "float heat", &heat, "color tint", tint, NULL);
    (*result)[0] = static_cast<float>(status);
    (*result)[1] = heat;
    (*result)[2] = tint[1];
  }
  return 0;
}

// Tokens without a type, and a channel that is not there.
int wrong(RslContext*, int, const RslArg* argv[]) {
  RslFloatIter result(argv[0]);
  RslStringIter file(argv[1]);
  RslStringIter name(argv[2]);
  float point[3] = {0, 0, 0}, value = 0;
  *result = static_cast<float>(RxTexture3d(*file, point, NULL, 1, *name, &value, NULL));
  return 0;
}

// Channels 2 and 0 of a level: status, the first number, the last one.
int texels(RslContext*, int, const RslArg* argv[]) {
  RslColorIter result(argv[0]);
  RslStringIter map(argv[1]);
  RslFloatIter level(argv[2]), face(argv[3]), channel(argv[4]);
  int channels[] = {static_cast<int>(*channel), 0};
  float got[12] = {-1};
  got[11] = -1;
  (*result)[0] = static_cast<float>(
      RxTextureGetData(*map, 2, channels, static_cast<int>(*level), static_cast<int>(*face), got));
  (*result)[1] = got[0];
  (*result)[2] = got[11];
  return 0;
}

int unique(RslContext* context, int, const RslArg* argv[]) {
  RslStringIter result(argv[0]);
  char text[64];
  RxUUIDCreateString(text);
  *result = const_cast<char*>(context->GetToken(text));
  return 0;
}

int source_shadow(RslContext*, int, const RslArg* argv[]) {
  RslColorIter result(argv[0]);
  float p[3] = {0, 0, 0}, shadow = 5;
  (*result)[0] = static_cast<float>(RxSourceShadow("map", 0, p, p, p, p, p, p, p, p, &shadow, NULL));
  (*result)[1] = shadow;
  return 0;
}

// An attribute that is a whole number: status, whether it says so, the number.
int integer(RslContext* context, int, const RslArg* argv[]) {
  RslColorIter result(argv[0]);
  RslStringIter name(argv[1]);
  RxInfoType_t type = RxInfoMatrix;
  RtInt value = -1;
  int count = 0;
  (*result)[0] = static_cast<float>(RxAttribute(*name, &value, sizeof value, &type, &count));
  (*result)[1] = type == RxInfoInteger && count == 1;
  (*result)[2] = static_cast<float>(value);
  return context->GetRixInterface(k_RixMessages)->GetVersion() == 1 ? 0 : 7;
}

// As some do: a result where there is none.
int text_of_nothing(RslContext*, int, const RslArg* argv[]) {
  RslStringIter result(argv[0]);
  *result = const_cast<char*>("nobody reads this");
  return 0;
}

// In a prototype of a dialect without `output`.
int twice(RslContext*, int argc, const RslArg* argv[]) {
  RslFloatIter x(argv[1]), y(argv[2]);
  for (unsigned int i = 0, count = RslArg::NumValues(argc, argv); i < count; ++i, ++x, ++y)
    *y = 2 * *x;
  return 0;
}

RslFunction functions[] = {
    {"float fl_bake(point, normal, uniform string)", bake, NULL, NULL},
    {"color fl_read(point, normal, uniform string, uniform float)", read, NULL, NULL},
    {"uniform float fl_wrong(uniform string, uniform string)", wrong, NULL, NULL},
    {"uniform color fl_texels(uniform string, uniform float, uniform float, uniform float)", texels, NULL,
     NULL},
    {"uniform string fl_unique()", unique, NULL, NULL},
    {"uniform color fl_source()", source_shadow, NULL, NULL},
    {"uniform color fl_integer(uniform string)", integer, NULL, NULL},
    {"void fl_text(uniform string)", text_of_nothing, NULL, NULL},
    {"void fl_twice(float, float)", twice, NULL, NULL},
    {NULL}};

} // namespace

RSLEXPORT RslFunctionTable RslPublicFunctions(functions);
