// The constants of ri.h that are known by name in RIB.
#pragma once

#include "render/ri/ri.h"

#include <string_view>

namespace render::ri {

/// "bezier" for the numbers of RiBezierBasis, and so on; empty for others.
std::string_view basis_name(const RtFloat (*matrix)[4]);

} // namespace render::ri
