// Quantisation with dither.
#include "render/display/quantize.h"

#include "render/hider/random.h"

#include <cmath>

namespace render {

int quantize(float value, const Quantization& q, int x, int y, int channel) {
  float noise = 2 * upper_unit(hash_of(x, y, kDither + 16 * static_cast<uint64_t>(channel))) - 1;
  float scaled =
      std::round(static_cast<float>(q.zero) + static_cast<float>(q.one - q.zero) * value + q.dither * noise);
  // The negated test sends what is not a number to the minimum.
  if (!(scaled > static_cast<float>(q.min))) return q.min;
  if (scaled >= static_cast<float>(q.max)) return q.max;
  return static_cast<int>(scaled);
}

} // namespace render
