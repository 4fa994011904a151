/* A function with the name of a built-in one, and other parameters. */
#include "shadeop.h"

SHADEOP_TABLE(erfc) = {{"float erfc_of_point(point)", "", ""}, {""}};

SHADEOP(erfc_of_point) {
  (void)initdata, (void)argc;
  *(float*)argv[0] = 100 + ((float*)argv[1])[0];
  return 0;
}
