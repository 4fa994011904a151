// Needs a function of a library that it is not linked with.
#include "shadeop.h"
extern "C" float function_of_nobody(float);
SHADEOP_TABLE(ur_call) = {{"float ur_call_f(float)", "", ""}, {""}};
SHADEOP(ur_call_f) {
  *(float*)argv[0] = function_of_nobody(*(float*)argv[1]);
  return 0;
}
