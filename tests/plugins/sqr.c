/* A function by point in C, with overloads. */
#include "shadeop.h"

SHADEOP_TABLE(sqr) = {{"float sqr_f(float)", "sqr_init", "sqr_shutdown"},
                      {"point sqr_t(point)", "sqr_init", "sqr_shutdown"},
                      {"color sqr_t(color)", "sqr_init", "sqr_shutdown"},
                      {""}};

SHADEOP_INIT(sqr_init) {
  return malloc(1);
}
SHADEOP_SHUTDOWN(sqr_shutdown) {
  free(initdata);
}
SHADEOP(sqr_f) {
  float x = *(float*)argv[1];
  *(float*)argv[0] = x * x;
  return 0;
}
SHADEOP(sqr_t) {
  float *r = (float*)argv[0], *x = (float*)argv[1];
  int i;
  for (i = 0; i < 3; ++i)
    r[i] = x[i] * x[i];
  return 0;
}
