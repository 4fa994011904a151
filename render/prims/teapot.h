// The Utah teapot (M. Newell, 1975; the data are in the public domain): 32 bicubic Bezier patches, z up, the
// bottom at z = 0.
#pragma once

#include "render/state/math.h"

#include <array>
#include <vector>

namespace render {

/// Control points of the patches, u fastest. Du(P) x Dv(P) points outwards.
std::vector<std::array<Vec3, 16>> teapot_patches();

} // namespace render
