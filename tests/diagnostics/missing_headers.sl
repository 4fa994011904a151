// Headers that are not there.
#include "shadedefs.h" // expect-error: cannot find 'shadedefs.h'; searched in
#include <nois.h> // expect-error: cannot find 'nois.h'; did you mean 'noises.h'?; searched in no folder (-I adds a folder)
surface a() { Ci = 1; }
