// The surface of primitives that have none: Ci = Os Cs |N.I|, a headlight without highlights, so that
// geometry shows.
#pragma once

#include "slvm/grid.h"

namespace render {

void shade_by_default(slvm::Grid& grid);

} // namespace render
