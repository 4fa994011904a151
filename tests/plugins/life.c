/* When functions by point are called: a line of the file LIFE_LOG for each init and shutdown; threads in one at a time. */
#include "shadeop.h"

#include <stdio.h>
#include <unistd.h>

static void note(const char* what, int number) {
  const char* name = getenv("LIFE_LOG");
  FILE* f = name ? fopen(name, "a") : NULL;
  if (!f) return;
  fprintf(f, "%s %d\n", what, number);
  fclose(f);
}

SHADEOP_TABLE(lf_first) = {{"float lf_first_f(float)", "lf_init", "lf_shutdown"}, {""}};
SHADEOP_TABLE(lf_second) = {{"float lf_second_f(float)", "lf_init", "lf_shutdown"}, {""}};
SHADEOP_TABLE(lf_other) = {{"float lf_other_f(float)", "lf_other_init", "lf_other_shutdown"}, {""}};

SHADEOP_INIT(lf_init) {
  note("init", ctx);
  return malloc(1);
}
SHADEOP_SHUTDOWN(lf_shutdown) {
  note("shutdown", initdata != NULL);
  free(initdata);
}
SHADEOP_INIT(lf_other_init) {
  note("other init", ctx);
  return NULL;
}
SHADEOP_SHUTDOWN(lf_other_shutdown) {
  note("other shutdown", initdata != NULL);
}
SHADEOP(lf_first_f) {
  *(float*)argv[0] = initdata ? 1 : 0;
  return 0;
}
SHADEOP(lf_second_f) {
  *(float*)argv[0] = initdata ? 2 : 0;
  return 0;
}
SHADEOP(lf_other_f) {
  *(float*)argv[0] = initdata ? 3 : -3;
  return 0;
}

/* 1 when another thread was inside, too. */
static int inside;
static float visit(void) {
  int alone = __sync_add_and_fetch(&inside, 1) == 1;
  usleep(200);
  if (inside > 1) alone = 0;
  __sync_sub_and_fetch(&inside, 1);
  return alone ? 0 : 1;
}
SHADEOP_TABLE(lf_alone) = {{"float lf_alone_f(float)", "", ""}, {""}};
SHADEOP(lf_alone_f) {
  *(float*)argv[0] = visit();
  return 0;
}
SHADEOP_TABLE(lf_together) = {{"float lf_together_f(float)", "", ""}, {""}};
SHADEOP_THREADSAFE(lf_together);
static int arrived;
/* 1 when another thread comes while this one waits. */
SHADEOP(lf_together_f) {
  int i;
  __sync_add_and_fetch(&arrived, 1);
  for (i = 0; i < 5000 && __sync_fetch_and_add(&arrived, 0) < 2; ++i)
    usleep(1000);
  *(float*)argv[0] = arrived >= 2;
  return 0;
}
