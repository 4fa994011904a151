// The filters are those of RISpec 3.2, appendix E. Flat images: rows first, then columns. On the sphere
// weights depend on both latitudes and the difference of the longitudes only, so that those of a row serve
// all its pixels.
#include "render/texture/blur.h"

#include "render/texture/shrink.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace render {

namespace {

/// Of a pixel so many pixels away: of a box as much of it as is covered.
float weight_at(FilterKind filter, float distance, float width) {
  if (filter != FilterKind::kBox) return axis_weight(filter, distance, width);
  return std::clamp(width / 2 - std::abs(distance) + 0.5f, 0.0f, 1.0f);
}

/// One row or column: `count` pixels, `step` floats apart.
void blur_line(float* line, int count, size_t step, size_t channels, std::span<const float> weights,
               TextureWrap wrap) {
  const int reach = static_cast<int>(weights.size()) / 2;
  std::vector<float> before(static_cast<size_t>(count) * channels);
  for (size_t i = 0; i < static_cast<size_t>(count); ++i)
    std::copy_n(line + i * step, channels, before.begin() + static_cast<std::ptrdiff_t>(i * channels));
  std::vector<double> sum(channels);
  for (int i = 0; i < count; ++i) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (int k = -reach; k <= reach; ++k) {
      const int from = wrapped(i + k, count, wrap);
      const auto w = static_cast<double>(weights[static_cast<size_t>(k + reach)]);
      for (size_t c = 0; from >= 0 && c < channels; ++c)
        sum[c] += w * static_cast<double>(before[static_cast<size_t>(from) * channels + c]);
    }
    for (size_t c = 0; c < channels; ++c)
      line[static_cast<size_t>(i) * step + c] = static_cast<float>(sum[c]);
  }
}

/// Of the pixels about one, with the sum 1.
std::vector<float> weights_about(FilterKind filter, float width) {
  const int reach = static_cast<int>(std::ceil(width / 2 - 0.5f));
  std::vector<float> out;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    out.push_back(weight_at(filter, static_cast<float>(k), width));
    sum += static_cast<double>(out.back());
  }
  for (float& w : out)
    w = static_cast<float>(static_cast<double>(w) / sum);
  return out;
}

/// Halves an image while its pixels stay so many times finer than the filter.
void reduce(FloatImage& image, MakeSettings& settings) {
  constexpr float kPixelsOfFilter = 16;
  while (std::min(settings.swidth, settings.twidth) >= 2 * kPixelsOfFilter && image.width % 2 == 0 &&
         image.height % 2 == 0) {
    image = half_of(image, {});
    settings.swidth /= 2;
    settings.twidth /= 2;
  }
}

/// A pixel that has a part in others of one row: those `across` pixels to the left.
struct SphereTap {
  int row = 0;
  size_t across = 0;
  float weight = 0;
};

std::vector<SphereTap> taps_of_row(int row, int width, int height, const MakeSettings& s) {
  const double pixel = std::numbers::pi / height; // as an angle; so it is along the equator
  auto latitude = [&](int y) { return std::numbers::pi / 2 - (y + 0.5) * pixel; };
  const double here = latitude(row),
               reach = (std::max(s.swidth, s.twidth) / 2 + 0.5) * std::numbers::sqrt2 * pixel;
  std::vector<SphereTap> taps;
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    const double there = latitude(y);
    if (std::abs(there - here) > reach) continue;
    for (int x = 0; x < width; ++x) {
      const double longitude = 2 * std::numbers::pi * x / width;
      // The other pixel as seen from this one: to the east, to the north, and how far.
      const double east = std::cos(there) * std::sin(longitude),
                   north = std::sin(there) * std::cos(here) -
                           std::cos(there) * std::sin(here) * std::cos(longitude),
                   up = std::sin(there) * std::sin(here) +
                        std::cos(there) * std::cos(here) * std::cos(longitude),
                   across = std::hypot(east, north), far = std::atan2(across, up);
      if (far > reach) continue;
      const double scale = across > 0 ? far / across / pixel : 0;
      const float weight = weight_at(s.filter, static_cast<float>(east * scale), s.swidth) *
                           weight_at(s.filter, static_cast<float>(north * scale), s.twidth) *
                           static_cast<float>(std::cos(there));
      if (!(weight > 0)) continue;
      taps.push_back({y, static_cast<size_t>(x), weight});
      sum += static_cast<double>(weight);
    }
  }
  for (SphereTap& tap : taps)
    tap.weight /= static_cast<float>(sum);
  return taps;
}

} // namespace

void blur(FloatImage& image, const MakeSettings& s) {
  const size_t row = image.row_size();
  if (widens(s.filter, s.swidth)) {
    const std::vector<float> weights = weights_about(s.filter, s.swidth);
    for (int y = 0; y < image.height; ++y)
      blur_line(image.row(y), image.width, image.channels, image.channels, weights, s.swrap);
  }
  if (widens(s.filter, s.twidth)) {
    const std::vector<float> weights = weights_about(s.filter, s.twidth);
    for (size_t x = 0; x < row; x += image.channels)
      blur_line(image.row(0) + x, image.height, row, image.channels, weights, s.twrap);
  }
}

void blur_sphere(FloatImage& image, MakeSettings s) {
  if (!widens(s.filter, s.swidth) && !widens(s.filter, s.twidth)) return;
  reduce(image, s);
  const size_t row = image.row_size();
  const FloatImage before = image;
  for (int y = 0; y < image.height; ++y) {
    float* out = image.row(y);
    std::fill_n(out, row, 0.0f);
    for (const SphereTap& tap : taps_of_row(y, image.width, image.height, s)) {
      // Round the globe: the row begins again where it ends.
      const size_t first = tap.across * image.channels;
      const float* from = before.row(tap.row);
      add_scaled(from + first, tap.weight, row - first, out);
      add_scaled(from, tap.weight, first, out + (row - first));
    }
  }
}

} // namespace render
