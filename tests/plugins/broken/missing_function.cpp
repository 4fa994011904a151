// A table that names a function which is not there.
#include "shadeop.h"
SHADEOP_TABLE(mf_call) = {{"float mf_elsewhere(float)", "", ""}, {""}};
