/* Functions by point: a parameter of every type, in and out; overloads; strings that fit and that do not. */
#include "shadeop.h"

#include <stdio.h>

SHADEOP_TABLE(pt_sum) = {{"float pt_sum_all(float, point, vector, normal, color, matrix, string, float[3], color[2])", "", ""},
                         {"float pt_sum_f(float)", "", ""},
                         {"point pt_sum_p(point)", "", ""},
                         {"color pt_sum_c(color)", "", ""},
                         {""}};

/* Every component with another weight. */
SHADEOP(pt_sum_all) {
  static const int kCounts[] = {1, 3, 3, 3, 3, 16};
  float total = 0, weight = 1;
  int a, i;
  if (argc != 10) return 1;
  for (a = 0; a < 6; ++a)
    for (i = 0; i < kCounts[a]; ++i)
      total += weight++ * ((float*)argv[a + 1])[i];
  total += weight++ * (float)strlen(((STRING_DESC*)argv[7])->s);
  for (i = 0; i < 3; ++i)
    total += weight++ * ((float*)argv[8])[i];
  for (i = 0; i < 6; ++i)
    total += weight++ * ((float*)argv[9])[i];
  *(float*)argv[0] = total;
  return 0;
}
SHADEOP(pt_sum_f) {
  *(float*)argv[0] = 10 * *(float*)argv[1];
  return argc != 2;
}
SHADEOP(pt_sum_p) {
  int i;
  for (i = 0; i < 3; ++i)
    ((float*)argv[0])[i] = 20 * ((float*)argv[1])[i];
  return 0;
}
SHADEOP(pt_sum_c) {
  int i;
  for (i = 0; i < 3; ++i)
    ((float*)argv[0])[i] = 30 * ((float*)argv[1])[i];
  return 0;
}

SHADEOP_TABLE(pt_out) = {{"void pt_out_all(float, output float, output point, output color, output matrix, output string, "
                          "output float[2], output string[2])",
                          "", ""},
                         {""}};
SHADEOP(pt_out_all) {
  float x = *(float*)argv[1];
  int i;
  *(float*)argv[2] += x;
  for (i = 0; i < 3; ++i) {
    ((float*)argv[3])[i] = x + (float)i;
    ((float*)argv[4])[i] = x * (float)(i + 1);
  }
  for (i = 0; i < 16; ++i)
    ((float*)argv[5])[i] = x + (float)i;
  strcpy(((STRING_DESC*)argv[6])->s, "written");
  ((float*)argv[7])[0] = x;
  ((float*)argv[7])[1] += 1;
  ASSIGN_STRING(((char**)argv[8])[1], "second");
  return 0;
}

/* Says of no parameter that it is stored to. */
SHADEOP_TABLE(pt_swap) = {{"void pt_swap_ff(float, float)", "", ""}, {""}};
SHADEOP(pt_swap_ff) {
  float *a = (float*)argv[1], *b = (float*)argv[2], old = *a;
  *a = *b;
  *b = old;
  return 0;
}

SHADEOP_TABLE(pt_join) = {{"string pt_join_ss(string, string)", "", ""}, {"string pt_join_sf(string, float)", "", ""}, {""}};
SHADEOP(pt_join_ss) {
  STRING_DESC *r = (STRING_DESC*)argv[0], *a = (STRING_DESC*)argv[1], *b = (STRING_DESC*)argv[2];
  char text[8192];
  snprintf(text, sizeof text, "%s%s", a->s, b->s);
  if ((int)strlen(text) < r->bufflen)
    strcpy(r->s, text);
  else
    ASSIGN_STRING(r->s, text);
  a->s[0] = 'x'; /* its own copy */
  return 0;
}
SHADEOP(pt_join_sf) {
  char text[8192];
  snprintf(text, sizeof text, "%s%g", *(char**)argv[1], *(float*)argv[2]);
  ASSIGN_STRING(*(char**)argv[0], text);
  return 0;
}

/* How often it was called. */
SHADEOP_TABLE(pt_count) = {{"float pt_count_f(float)", "pt_count_init", "pt_count_shutdown"},
                           {"varying float pt_count_v()", "pt_count_init", "pt_count_shutdown"},
                           {""}};
SHADEOP_INIT(pt_count_init) {
  return calloc(1, sizeof(int));
}
SHADEOP(pt_count_f) {
  *(float*)argv[0] = (float)++*(int*)initdata;
  return 0;
}
SHADEOP(pt_count_v) {
  *(float*)argv[0] = (float)++*(int*)initdata;
  return 0;
}
SHADEOP_SHUTDOWN(pt_count_shutdown) {
  free(initdata);
}
