// Functions whose init crashes.
#include "RslPlugin.h"
#include "shadeop.h"
#include <signal.h>

static int nothing(RslContext*, int, const RslArg*[]) {
  return 0;
}
static void crash(RixContext*) {
  raise(SIGSEGV);
}
static RslFunction functions[] = {{"float ci_grid(float)", nothing, crash, NULL}, {NULL}};
RSLEXPORT RslFunctionTable RslPublicFunctions(functions);

SHADEOP_TABLE(ci_point) = {{"float ci_point_f(float)", "ci_init", ""}, {""}};
SHADEOP_INIT(ci_init) {
  raise(SIGFPE);
  return 0;
}
SHADEOP(ci_point_f) {
  *(float*)argv[0] = 1;
  return 0;
}
