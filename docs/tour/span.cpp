// void span(float x, output uniform float least, output uniform float most): of x on the whole grid.
#include "RslPlugin.h"

static int span(RslContext*, int, const RslArg* argv[]) {
  RslFloatIter x(argv[1]), least(argv[2]), most(argv[3]);
  *least = *most = *x;
  for (unsigned int i = 0; i < argv[1]->NumValues(); ++i, ++x) {
    if (*x < *least) *least = *x;
    if (*x > *most) *most = *x;
  }
  return 0;
}

static RslFunction functions[] = {
    {"void span(float x, output uniform float least, output uniform float most)", span, NULL, NULL}, {NULL}};
RSLEXPORT RslFunctionTable RslPublicFunctions(functions);
