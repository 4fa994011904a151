// Quantisation with dither.
#include "render/display/quantize.h"

#include "render/hider/random.h"

namespace render {

namespace {

/// std::round, which is a call on processors without SSE 4.1, where the result is an int.
int rounded(float x) {
  int whole = static_cast<int>(x);
  float rest = x - static_cast<float>(whole);
  return whole + (rest >= 0.5f) - (rest <= -0.5f);
}

} // namespace

int quantize(float value, const Quantization& q, int x, int y, int channel) {
  float scaled = static_cast<float>(q.zero) + static_cast<float>(q.one - q.zero) * value;
  auto clamped = [&](float v) {
    // The negated test sends what is not a number to the minimum.
    if (!(v > static_cast<float>(q.min))) return q.min;
    if (v >= static_cast<float>(q.max)) return q.max;
    return rounded(v);
  };
  // Whole numbers, such as those of backgrounds, come back from so little noise.
  if (q.dither <= 0.5f && (scaled == static_cast<float>(q.zero) || scaled == static_cast<float>(q.one)))
    return clamped(scaled);
  float noise = 2 * upper_unit(hash_of(x, y, kDither + 16 * static_cast<uint64_t>(channel))) - 1;
  return clamped(scaled + q.dither * noise);
}

} // namespace render
