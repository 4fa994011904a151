// Quantization of rows of pixels, as many at a time as the processor has lanes.
#pragma once

#include "render/state/options.h"

#include <cstdint>
#include <span>

namespace render {

/// Quantizer::hash() of the pixels of row y from x on.
void hash_row(int x, int y, int group, std::span<uint64_t> hashes);

/// The values of a channel, as Quantizer makes them; `hashes` are those of its group.
void quantize_row(const Quantization& q, int channel, std::span<const uint64_t> hashes, const float* values,
                  int* out);

} // namespace render
