// Six faces of a cube as one latitude-longitude image.
#pragma once

#include "render/texture/pixels.h"

#include <array>

namespace render {

/// Faces px nx py ny pz nz with the same channels, each seen from the middle of the cube with `fov` degrees.
/// As many pixels round the equator as the four faces have there.
FloatImage latlong_of_cube(const std::array<FloatImage, 6>& faces, float fov);

} // namespace render
