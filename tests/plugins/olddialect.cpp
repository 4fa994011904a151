// The ways of writing that sources of other renderers have: tables inside and behind extern "C", const char**
// for strings, functions that return 1, prototypes with blanks, names and superfluous words.
#include <shadeop.h>

extern "C" {

SHADEOP_TABLE(od_length) = {{"float od_length ( string text )", "od_init", "od_cleanup"}, {""}};

SHADEOP_INIT(od_init) {
  return 0x0;
}
SHADEOP(od_length) {
  const char** text = (const char**)(argv[1]);
  *((float*)argv[0]) = static_cast<float>(strlen(*text));
  return 1;
}
SHADEOP_CLEANUP(od_cleanup) {}
}

extern "C" SHADEOP_TABLE(od_scale) = {{"vector od_scale_v(vector v,float float);", 0, 0}, {"", "", ""}};
extern "C" SHADEOP(od_scale_v) {
  for (int i = 0; i < 3; ++i)
    ((float*)argv[0])[i] = ((float*)argv[1])[i] * *(float*)argv[2];
  return 0;
}
