// Tables with prototypes that cannot be read.
#include "shadeop.h"
SHADEOP_TABLE(bp_call) = {{"float bp_call(float, quaternion)", "", ""}, {""}};
SHADEOP(bp_call) {
  *(float*)argv[0] = 1;
  return 0;
}
