/* rmannotes.sl: the older name of rmannotes.h. */
#include "rmannotes.h"
