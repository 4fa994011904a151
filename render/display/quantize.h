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
  /// One hash has enough bits for three channels.
  static constexpr int group_of(int channel) { return channel / 3; }
  static constexpr uint64_t hash(int x, int y, int group) {
    return hash_of(x, y, kDither + 16 * static_cast<uint64_t>(group));
  }

  Quantizer(const Quantization& q, int channel)
      : zero_(static_cast<float>(q.zero)), one_(static_cast<float>(q.one)),
        range_(static_cast<float>(q.one - q.zero)), least_(static_cast<float>(q.min)),
        most_(static_cast<float>(q.max)), min_(q.min), max_(q.max), dither_(q.dither),
        shift_(kBits * (channel % 3)) {}

  /// `hash` is that of the pixel and the channel's group.
  int operator()(float value, uint64_t hash) const {
    float scaled = zero_ + range_ * value;
    // Whole numbers, such as those of backgrounds, come back from so little noise.
    if (dither_ <= 0.5f && (scaled == zero_ || scaled == one_)) return limited(scaled);
    const auto bits = static_cast<int32_t>(hash >> shift_ & ((1u << kBits) - 1));
    return limited(scaled + dither_ * (static_cast<float>(bits) * (2.0f / (1 << kBits)) - 1));
  }

private:
  static constexpr int kBits = 21;

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
  int shift_;
};

/// One value.
inline int quantize(float value, const Quantization& q, int x, int y, int channel) {
  return Quantizer(q, channel)(value, Quantizer::hash(x, y, Quantizer::group_of(channel)));
}

} // namespace render
