/* float stripes(float x, float count), color stripes(float x, float count, color a, color b): x from 0 to 1 in stripes. */
#include "shadeop.h"

#include <math.h>

SHADEOP_TABLE(stripes) = {{"float stripes_f(float x, float count)", "", ""},
                          {"color stripes_c(float x, float count, color a, color b)", "", ""},
                          {""}};
SHADEOP_THREADSAFE(stripes);

static int odd(void** argv) {
  return (int)floorf(*(float*)argv[1] * *(float*)argv[2]) % 2 != 0;
}

SHADEOP(stripes_f) {
  *(float*)argv[0] = odd(argv) ? 1 : 0;
  return 0;
}

SHADEOP(stripes_c) {
  memcpy(argv[0], argv[odd(argv) ? 4 : 3], 3 * sizeof(float));
  return 0;
}
