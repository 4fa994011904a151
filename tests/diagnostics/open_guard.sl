// A header whose guard nothing ends, included twice.
#include "open_guard.h"
#include "open_guard.h"
surface s() {
  Ci = third(u);
}
