// Float to integer conversion of finished pixels. RISpec 3.2, 4.2.3.
#pragma once

#include "render/hider/random.h"
#include "render/state/options.h"

#include <cstdint>

namespace render {

/// round(zero + (one - zero) * value + dither * r) limited to [min, max]; r in [-1, 1) is a function of pixel
/// and channel. Not for q.is_float().
class Quantizer {
public:
  Quantizer(const Quantization& q, int channel)
      : zero_(static_cast<float>(q.zero)), one_(static_cast<float>(q.one)),
        range_(static_cast<float>(q.one - q.zero)), least_(static_cast<float>(q.min)),
        most_(static_cast<float>(q.max)), min_(q.min), max_(q.max), dither_(q.dither),
        purpose_(kDither + 16 * static_cast<uint64_t>(channel)) {}

  int operator()(float value, int x, int y) const {
    float scaled = zero_ + range_ * value;
    // Whole numbers, such as those of backgrounds, come back from so little noise.
    if (dither_ <= 0.5f && (scaled == zero_ || scaled == one_)) return limited(scaled);
    return limited(scaled + dither_ * (2 * upper_unit(hash_of(x, y, purpose_)) - 1));
  }

private:
  int limited(float v) const {
    // The negated test sends what is not a number to the minimum.
    if (!(v > least_)) return min_;
    if (v >= most_) return max_;
    // std::round, which is a call on processors without SSE 4.1.
    int whole = static_cast<int>(v);
    float rest = v - static_cast<float>(whole);
    return whole + (rest >= 0.5f) - (rest <= -0.5f);
  }

  float zero_, one_, range_, least_, most_;
  int min_, max_;
  float dither_;
  uint64_t purpose_;
};

/// One value.
inline int quantize(float value, const Quantization& q, int x, int y, int channel) {
  return Quantizer(q, channel)(value, x, y);
}

} // namespace render
