// Functions whose init throws.
#include "RslPlugin.h"
#include "shadeop.h"
#include <stdexcept>

static int nothing(RslContext*, int, const RslArg*[]) {
  return 0;
}
static void fail(RixContext*) {
  throw std::runtime_error("no licence");
}
static RslFunction functions[] = {{"float ti_grid(float)", nothing, fail, NULL}, {NULL}};
RSLEXPORT RslFunctionTable RslPublicFunctions(functions);

SHADEOP_TABLE(ti_point) = {{"float ti_point_f(float)", "ti_init", "ti_shutdown"}, {""}};
SHADEOP_INIT(ti_init) {
  throw 5;
}
SHADEOP_SHUTDOWN(ti_shutdown) {}
SHADEOP(ti_point_f) {
  *(float*)argv[0] = 1;
  return 0;
}
