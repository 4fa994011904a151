// Softer images: what a map's filter of more than its usual width is for.
#pragma once

#include "render/texture/make_maps.h"
#include "render/texture/pixels.h"

namespace render {

/// Blurs an image by the filter and the widths of the settings, in its pixels. Beyond its sides
/// there is what the wraps say.
void blur(FloatImage& image, const MakeSettings& settings);

/// The same for latitudes and longitudes: widths are those at the equator, and the same angle everywhere.
/// What comes out is smaller where that loses nothing.
void blur_sphere(FloatImage& image, MakeSettings settings);

} // namespace render
