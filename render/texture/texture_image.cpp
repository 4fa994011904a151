#include "render/texture/texture_image.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace render {

namespace {

TextureHeader::Size half_of(TextureHeader::Size s) {
  return {std::max(1, s.width / 2), std::max(1, s.height / 2)};
}

TextureWrap wrap_of(const std::string& name) {
  return name == "periodic" ? TextureWrap::kPeriodic
         : name == "clamp"  ? TextureWrap::kClamp
                            : TextureWrap::kBlack;
}

/// The texels of a side that one of a shorter side covers, the first and the last of them in parts.
struct Cover {
  int first = 0;
  std::vector<float> weights; ///< sum 1
};

std::vector<Cover> covers(int from, int to) {
  std::vector<Cover> out(static_cast<size_t>(to));
  const double size = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Cover& c = out[static_cast<size_t>(i)];
    const double begin = i * size, end = std::min(begin + size, static_cast<double>(from));
    c.first = static_cast<int>(begin);
    for (int k = c.first; k < end && k < from; ++k)
      c.weights.push_back(
          static_cast<float>((std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k))) / size));
  }
  return out;
}

template <class T> T rounded(float x) {
  if constexpr (std::is_same_v<T, float>)
    return x;
  else
    return static_cast<T>(x + 0.5f);
}

/// Means over the areas that the texels of `to` cover.
template <class T>
void shrink(TextureHeader::Size from, const std::byte* texels, TextureHeader::Size to, size_t channels,
            std::byte* out) {
  const std::vector<Cover> columns = covers(from.width, to.width), rows = covers(from.height, to.height);
  std::vector<float> sum(channels);
  auto value = [&](int x, int y, size_t c) {
    T v;
    const size_t at =
        (static_cast<size_t>(y) * static_cast<size_t>(from.width) + static_cast<size_t>(x)) * channels + c;
    std::memcpy(&v, texels + at * sizeof(T), sizeof(T));
    return static_cast<float>(v);
  };
  for (const Cover& row : rows)
    for (const Cover& column : columns) {
      std::fill(sum.begin(), sum.end(), 0.0f);
      for (size_t j = 0; j < row.weights.size(); ++j)
        for (size_t i = 0; i < column.weights.size(); ++i)
          for (size_t c = 0; c < channels; ++c)
            sum[c] += row.weights[j] * column.weights[i] *
                      value(column.first + static_cast<int>(i), row.first + static_cast<int>(j), c);
      for (float s : sum) {
        const T v = rounded<T>(s);
        std::memcpy(out, &v, sizeof(T));
        out += sizeof(T);
      }
    }
}

/// Colours times alpha, the last channel.
template <class T> void associate(std::vector<std::byte>& texels, size_t channels) {
  constexpr float kOne = std::is_same_v<T, float> ? 1.0f : static_cast<float>(std::numeric_limits<T>::max());
  std::vector<T> values(channels);
  for (size_t at = 0; at + channels * sizeof(T) <= texels.size(); at += channels * sizeof(T)) {
    std::memcpy(values.data(), &texels[at], channels * sizeof(T));
    const float alpha = static_cast<float>(values.back()) / kOne;
    for (size_t c = 0; c + 1 < channels; ++c)
      values[c] = rounded<T>(static_cast<float>(values[c]) * alpha);
    std::memcpy(&texels[at], values.data(), channels * sizeof(T));
  }
}

/// Calls f with a value of the texels' type.
template <class F> void with_type(TexelType type, F&& f) {
  switch (type) {
  case TexelType::kByte: f(uint8_t{}); break;
  case TexelType::kShort: f(uint16_t{}); break;
  case TexelType::kFloat: f(float{}); break;
  }
}

} // namespace

void set_wraps(const std::string& modes, TextureHeader& header) {
  const size_t comma = modes.find(',');
  header.swrap = wrap_of(modes.substr(0, comma));
  header.twrap = comma == modes.npos ? header.swrap : wrap_of(modes.substr(comma + 1));
}

bool halves(TextureHeader::Size a, TextureHeader::Size b) {
  return (a.width > 1 || a.height > 1) && b == half_of(a);
}

TextureImage::TextureImage(std::unique_ptr<TextureReader> reader, std::atomic<long long>& memory)
    : header_(reader->header()), memory_(memory), reader_(std::move(reader)) {
  std::vector<TextureHeader::Size> sizes = header_.levels;
  while (sizes.back().width > 1 || sizes.back().height > 1)
    sizes.push_back(half_of(sizes.back()));
  levels_ = std::vector<Stored>(sizes.size());
  for (size_t i = 0; i < sizes.size(); ++i)
    levels_[i].size = sizes[i];
}

TextureImage::~TextureImage() {
  for (const Stored& l : levels_)
    memory_ -= static_cast<long long>(l.texels.size());
}

std::string TextureImage::problem() const {
  std::lock_guard lock(mutex_);
  return problem_;
}

TextureImage::Level TextureImage::level(size_t i) const {
  const Stored& l = levels_[i];
  if (!l.ready.load(std::memory_order_acquire)) {
    std::lock_guard lock(mutex_);
    load(i);
  }
  return {l.size.width, l.size.height, l.ready.load(std::memory_order_acquire)};
}

/// Called with the lock.
void TextureImage::load(size_t i) const {
  Stored& l = levels_[i];
  if (l.ready || !problem_.empty()) return;
  const auto channels = static_cast<size_t>(header_.channels);
  std::vector<std::byte> texels(static_cast<size_t>(l.size.width) * static_cast<size_t>(l.size.height) *
                                channels * texel_bytes(header_.type));
  if (i < header_.levels.size()) {
    problem_ = reader_->read(i, texels);
    if (!problem_.empty()) return;
    if (header_.straight_alpha)
      with_type(header_.type, [&](auto t) { associate<decltype(t)>(texels, channels); });
  } else {
    load(i - 1);
    const Stored& larger = levels_[i - 1];
    if (!larger.ready) return;
    with_type(header_.type, [&](auto t) {
      shrink<decltype(t)>(larger.size, larger.texels.data(), l.size, channels, texels.data());
    });
  }
  memory_ += static_cast<long long>(texels.size());
  l.texels = std::move(texels);
  l.ready.store(l.texels.data(), std::memory_order_release);
}

} // namespace render
