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
        most_(static_cast<float>(q.max)), dither_(q.dither), shift_(kBits * (channel % 3)),
        clean_(q.dither <= 0.5f) {}

  /// The channel's bits of the hash of the pixel and the channel's group.
  int32_t bits(uint64_t hash) const { return static_cast<int32_t>(hash >> shift_ & ((1u << kBits) - 1)); }
  /// Without branches, for loops in vectors.
  int operator()(float value, int32_t bits) const {
    const float scaled = zero_ + range_ * value;
    const float noise = static_cast<float>(bits) * (2.0f / (1 << kBits)) - 1;
    // Whole numbers, such as those of backgrounds, come back from so little noise.
    const bool whole = clean_ & ((scaled == zero_) | (scaled == one_));
    return limited(scaled + noise * (whole ? 0 : dither_));
  }

private:
  static constexpr int kBits = 21;

  int limited(float v) const {
    // What is not a number goes to the minimum.
    v = v > least_ ? v : least_;
    v = v < most_ ? v : most_;
    // std::round, which is a call on processors without SSE 4.1.
    const int whole = static_cast<int>(v);
    const float rest = v - static_cast<float>(whole);
    return whole + (rest >= 0.5f) - (rest <= -0.5f);
  }

  float zero_, one_, range_, least_, most_, dither_;
  int shift_;
  bool clean_;
};

/// One value.
inline int quantize(float value, const Quantization& q, int x, int y, int channel) {
  const Quantizer quantizer(q, channel);
  return quantizer(value, quantizer.bits(Quantizer::hash(x, y, Quantizer::group_of(channel))));
}

} // namespace render
