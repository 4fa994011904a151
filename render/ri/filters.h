// The filters of ri.h and their names in RIB.
#pragma once

#include "render/ri/ri.h"

#include <string_view>

namespace render::ri {

/// Empty: it is none of ours.
std::string_view filter_name(RtFilterFunc function);

} // namespace render::ri
