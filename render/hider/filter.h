// Pixel reconstruction filters.
#pragma once

#include "render/state/options.h"
#include "render/texture/filter_kind.h"

namespace render {

/// Weight of a sample at (x, y) pixels from a pixel's centre; 0 outside the filter's width. Not normalised.
float filter_weight(const PixelFilter& filter, float x, float y);

} // namespace render
