// Float to integer conversion of finished pixels. RISpec 3.2, 4.2.3.
#pragma once

#include "render/state/options.h"

#include <cstdint>

namespace render {

/// round(zero + (one - zero) * value + dither * r) limited to [min, max]; r in [-1, 1) is a function of pixel
/// and channel. Not for q.is_float().
int quantize(float value, const Quantization& q, int x, int y, int channel);

} // namespace render
