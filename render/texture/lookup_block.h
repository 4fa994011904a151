// So many lookups go through filters at once, one to a lane of the widest processors.
#pragma once

#include <cstddef>

namespace render {

inline constexpr size_t kLookupBlock = 16;
using LookupLanes = float[kLookupBlock];

} // namespace render
