// Numbers of samples for many points at once: two for every ray there is.
#pragma once

#include <cstddef>
#include <cstdint>

namespace slvm {

/// out[i] = scrambled(bits, seeds[i]), with as many at a time as the processor has lanes.
void draw_numbers(uint32_t bits, const uint32_t* seeds, size_t count, float* out);

} // namespace slvm
