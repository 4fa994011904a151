// Float to integer conversion of finished pixels. RISpec 3.2, 4.2.3.
#pragma once

#include "render/state/options.h"

#include <cstdint>

namespace render {

/// round(one * value + dither * r) limited to [min, max]; r in [-1, 1) is a function of pixel and channel.
/// `one` must not be 0 (that means: no quantisation).
int quantize(float value, const Quantization& q, int x, int y, int channel);

} // namespace render
