#include "render/texture/texture_filter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace render {

namespace {

/// A texel of a level is a box as wide as itself, bilinear interpolation a tent of twice that: together they
/// spread as a box does that is wider by this.
constexpr float kSpread = 1.7320508f;

/// The place of a texel within the image, or -1 for nothing.
int wrapped(int i, int size, TextureWrap wrap) {
  if (i >= 0 && i < size) return i;
  switch (wrap) {
  case TextureWrap::kPeriodic: i %= size; return i < 0 ? i + size : i;
  case TextureWrap::kClamp: return i < 0 ? 0 : size - 1;
  case TextureWrap::kBlack: return -1;
  }
  return -1;
}

/// The texels along one axis that an interpolation looks at.
struct Taps {
  int count = 0;
  int at[4];
  float weight[4];
};

/// `x`: in texels, whose middles are at halves.
template <class Way> Taps taps(Way way, float x, int size, TextureWrap wrap) {
  Taps out;
  // Far beyond the image all places are alike but for those that repeat.
  if (wrap == TextureWrap::kPeriodic)
    x -= std::floor(x / static_cast<float>(size)) * static_cast<float>(size);
  x = std::clamp(x, -8.0f, static_cast<float>(size) + 8.0f);
  auto add = [&](int i, float w) {
    const int at = wrapped(i, size, wrap);
    if (at < 0 || w == 0) return;
    out.at[out.count] = at;
    out.weight[out.count++] = w;
  };
  if (way == Way::kNearest) {
    add(static_cast<int>(std::floor(x)), 1);
    return out;
  }
  const float from = std::floor(x - 0.5f), f = x - 0.5f - from;
  const int i = static_cast<int>(from);
  switch (way) {
  case Way::kBSpline: {
    const float g = 1 - f;
    add(i - 1, g * g * g / 6);
    add(i, (4 - 6 * f * f + 3 * f * f * f) / 6);
    add(i + 1, (4 - 6 * g * g + 3 * g * g * g) / 6);
    add(i + 2, f * f * f / 6);
    break;
  }
  case Way::kCatmullRom:
    add(i - 1, ((2 - f) * f - 1) * f / 2);
    add(i, ((3 * f - 5) * f * f + 2) / 2);
    add(i + 1, ((4 - 3 * f) * f + 1) * f / 2);
    add(i + 2, (f - 1) * f * f / 2);
    break;
  default: add(i, 1 - f); add(i + 1, f);
  }
  return out;
}

} // namespace

TextureFilter::TextureFilter(const TextureImage& image, const slvm::TextureLookup& lookup, TextureWrap swrap,
                             TextureWrap twrap)
    : image_(image), wrap_{swrap, twrap}, first_(lookup.first_channel), channels_(lookup.channels) {
  const TextureHeader& header = image.header();
  const slvm::TextureOptions& o = lookup.options;
  const auto there = static_cast<size_t>(header.channels);
  present_ = first_ < there ? std::min(channels_, there - first_) : 0;
  width_ = static_cast<float>(header.levels[0].width);
  height_ = static_cast<float>(header.levels[0].height);
  fill_ = o.fill;
  ignore_above_ = o.ignore_above;
  between_levels_ = o.between_levels;
  one_sample_ = o.samples == 1;
  constexpr float kMostPlaces = 16;
  most_places_ = o.samples >= 1 ? std::min(std::floor(o.samples), 256.0f) : kMostPlaces;
  gaussian_ = o.filter == "gaussian";
  triangle_ = o.filter == "triangle";
  interpolation_ = gaussian_                   ? Interpolation::kBSpline
                   : o.filter == "catmull-rom" ? Interpolation::kCatmullRom
                                               : Interpolation::kBilinear;
}

TextureFilter::Ellipse TextureFilter::ellipse_of(const TextureRegion& r) const {
  const float ss = (r.s_u * r.s_u + r.s_v * r.s_v + r.sblur * r.sblur) * width_ * width_,
              tt = (r.t_u * r.t_u + r.t_v * r.t_v + r.tblur * r.tblur) * height_ * height_,
              st = (r.s_u * r.t_u + r.s_v * r.t_v) * width_ * height_;
  if (!std::isfinite(ss) || !std::isfinite(tt) || !std::isfinite(st)) return {}; // a point
  const float middle = 0.5f * (ss + tt), off = std::hypot(0.5f * (ss - tt), st);
  Ellipse out;
  out.longest = std::sqrt(middle + off);
  // By the determinant: the difference of large numbers would leave rounding errors.
  if (out.longest > 0) out.shortest = std::sqrt(std::max(0.0f, ss * tt - st * st)) / out.longest;
  float x = ss - tt >= 0 ? 0.5f * (ss - tt) + off : st, y = ss - tt >= 0 ? st : off - 0.5f * (ss - tt);
  const float length = std::hypot(x, y);
  if (length == 0) x = 1, y = 0;
  const float half = 0.5f * out.longest / (length == 0 ? 1 : length);
  out.s = x * half / width_;
  out.t = y * half / height_;
  return out;
}

bool TextureFilter::mean(const TextureRegion& region, float* out) const {
  std::fill_n(out, channels_, 0.0f);
  const Ellipse ellipse = ellipse_of(region);
  bool read = true;
  float counted = 0; // weight of the texels that count
  if (one_sample_ && ellipse.longest == 0) {
    read = add_level(region, ellipse, 0, 1, Interpolation::kNearest, out, counted);
  } else {
    const float texel = std::max({ellipse.shortest / kSpread, ellipse.longest / most_places_, 1.0f});
    const float level = std::min(std::log2(texel), static_cast<float>(image_.levels() - 1));
    auto lower = static_cast<size_t>(level);
    float part = level - static_cast<float>(lower);
    if (!between_levels_) {
      lower += part >= 0.5f;
      part = 0;
    }
    if (part < 1) read = add_level(region, ellipse, lower, 1 - part, interpolation_, out, counted);
    if (part > 0 && read) read = add_level(region, ellipse, lower + 1, part, interpolation_, out, counted);
  }
  if (ignore_above_ < std::numeric_limits<float>::infinity())
    for (size_t c = 0; c < present_; ++c)
      out[c] = counted > 0 ? out[c] / counted : 0.0f;
  std::fill(out + present_, out + channels_, fill_);
  return read;
}

/// The mean over the places along the long axis, in one level.
bool TextureFilter::add_level(const TextureRegion& region, const Ellipse& ellipse, size_t index, float weight,
                              Interpolation way, float* out, float& counted) const {
  const TextureImage::Level level = image_.level(index);
  if (!level.texels) return false;
  // So many places, so far apart, that the spread is that of the whole side.
  const float texel = std::ldexp(1.0f, static_cast<int>(index)), longest = ellipse.longest;
  const float rest = std::sqrt(std::max(0.0f, longest * longest - kSpread * kSpread * texel * texel));
  const float places = std::clamp(std::ceil(rest / texel + 0.5f), 1.0f, most_places_);
  const float scale = places > 1 ? rest / (longest * std::sqrt(1 - 1 / (places * places))) : 0;
  auto add = [&](float s, float t, float w) {
    switch (image_.header().type) {
    case TexelType::kByte: add_texels<uint8_t>(level, way, s, t, w, out, counted); break;
    case TexelType::kShort: add_texels<uint16_t>(level, way, s, t, w, out, counted); break;
    case TexelType::kFloat: add_texels<float>(level, way, s, t, w, out, counted); break;
    }
  };
  auto place = [&](float i) { return (2 * i + 1) / places - 1; };
  auto shape = [&](float x) { return gaussian_ ? std::exp(-2 * x * x) : triangle_ ? 1 - std::abs(x) : 1.0f; };
  float sum = 0;
  for (float i = 0; i < places; ++i)
    sum += shape(place(i));
  for (float i = 0; i < places; ++i) {
    const float x = place(i);
    add(region.s + x * scale * ellipse.s, region.t + x * scale * ellipse.t, weight * shape(x) / sum);
  }
  return true;
}

template <class T>
void TextureFilter::add_texels(const TextureImage::Level& level, Interpolation way, float s, float t,
                               float weight, float* out, float& counted) const {
  const float scale = std::is_same_v<T, float> ? 1.0f : 1 / static_cast<float>(std::numeric_limits<T>::max());
  const Taps columns = taps(way, s * static_cast<float>(level.width), level.width, wrap_[0]),
             rows = taps(way, t * static_cast<float>(level.height), level.height, wrap_[1]);
  const auto texel = static_cast<size_t>(image_.header().channels);
  for (int j = 0; j < rows.count; ++j)
    for (int i = 0; i < columns.count; ++i) {
      const size_t at = static_cast<size_t>(rows.at[j]) * static_cast<size_t>(level.width) +
                        static_cast<size_t>(columns.at[i]);
      const std::byte* from = level.texels + (at * texel + first_) * sizeof(T);
      const float w = weight * rows.weight[j] * columns.weight[i];
      float values[slvm::TextureLookup::kMost];
      bool counts = true;
      for (size_t c = 0; c < present_; ++c) {
        T value;
        std::memcpy(&value, from + c * sizeof(T), sizeof(T));
        values[c] = static_cast<float>(value);
        counts = counts && !(values[c] * scale > ignore_above_);
      }
      if (!counts) continue;
      counted += w;
      for (size_t c = 0; c < present_; ++c)
        out[c] += w * scale * values[c];
    }
}

} // namespace render
