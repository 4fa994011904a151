// A header that includes another forty-five times, which does the same.
#include "include_many_a.h"
surface s() {}
