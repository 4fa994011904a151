// A header that includes itself, without end.
#include "include_itself.h"
surface s() {}
