// Pixel reconstruction filters.
#pragma once

#include "render/state/options.h"

namespace render {

/// Weight of a sample at (x, y) pixels from a pixel's centre; 0 outside the filter's width. Not normalised.
float filter_weight(const PixelFilter& filter, float x, float y);

/// Whether the weight is a product of one of x and one of y.
bool is_separable(FilterKind kind);
/// The factor of one axis.
float axis_weight(FilterKind kind, float x, float width);

} // namespace render
