// The filters are those of RISpec 3.2, appendix E. Flat images: rows first, then columns. On the sphere
// weights depend on both latitudes and the difference of the longitudes only, so that those of a row serve
// all its pixels.
#include "render/oiio/blur.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace render::oiio {

namespace {

/// Of a pixel so many pixels away: of a box as much of it as is covered.
float weight_at(const std::string& filter, float distance, float width) {
  const float x = std::abs(distance), part = 2 * x / width;
  if (filter == "triangle") return std::max(1 - part, 0.0f);
  if (filter == "gaussian") return part <= 1 ? std::exp(-2 * part * part) : 0.0f;
  return std::clamp(width / 2 - x + 0.5f, 0.0f, 1.0f);
}

/// The pixel that stands at a place beyond the sides; -1: nothing is there.
int wrapped(int at, int size, const std::string& wrap) {
  if (at >= 0 && at < size) return at;
  if (wrap == "periodic") return (at % size + size) % size;
  return wrap == "clamp" ? std::clamp(at, 0, size - 1) : -1;
}

/// One row or column: `count` pixels, `step` floats apart.
void blur_line(float* line, int count, size_t step, size_t channels, const std::string& filter, float width,
               const std::string& wrap) {
  const int reach = static_cast<int>(std::ceil(width / 2 - 0.5f));
  std::vector<float> before(static_cast<size_t>(count) * channels);
  for (size_t i = 0; i < static_cast<size_t>(count); ++i)
    std::copy_n(line + i * step, channels, before.begin() + static_cast<std::ptrdiff_t>(i * channels));
  std::vector<double> sum(channels);
  for (int i = 0; i < count; ++i) {
    std::fill(sum.begin(), sum.end(), 0.0);
    double weights = 0;
    for (int k = -reach; k <= reach; ++k) {
      const auto w = static_cast<double>(weight_at(filter, static_cast<float>(k), width));
      weights += w;
      const int from = wrapped(i + k, count, wrap);
      for (size_t c = 0; from >= 0 && c < channels; ++c)
        sum[c] += w * static_cast<double>(before[static_cast<size_t>(from) * channels + c]);
    }
    for (size_t c = 0; c < channels; ++c)
      line[static_cast<size_t>(i) * step + c] = static_cast<float>(sum[c] / weights);
  }
}

/// Halves an image by means of four while its pixels stay so many times finer than the filter.
void reduce(OIIO::ImageBuf& image, MakeSettings& settings) {
  constexpr float kPixelsOfFilter = 16;
  while (std::min(settings.swidth, settings.twidth) >= 2 * kPixelsOfFilter && image.spec().width % 2 == 0 &&
         image.spec().height % 2 == 0) {
    OIIO::ImageSpec spec = image.spec();
    spec.full_width = spec.width /= 2;
    spec.full_height = spec.height /= 2;
    OIIO::ImageBuf half(spec);
    const auto channels = static_cast<size_t>(spec.nchannels),
               row = 2 * static_cast<size_t>(spec.width) * channels;
    const auto* from = static_cast<const float*>(image.localpixels());
    auto* to = static_cast<float*>(half.localpixels());
    for (size_t y = 0; y < static_cast<size_t>(spec.height); ++y)
      for (size_t x = 0; x < static_cast<size_t>(spec.width); ++x)
        for (size_t c = 0; c < channels; ++c) {
          const float* p = from + 2 * y * row + 2 * x * channels + c;
          *to++ = (p[0] + p[channels] + p[row] + p[row + channels]) / 4;
        }
    image = std::move(half);
    settings.swidth /= 2;
    settings.twidth /= 2;
  }
}

/// A pixel that has a part in others of one row: those `across` pixels to the left.
struct SphereTap {
  size_t row = 0, across = 0;
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
      taps.push_back({static_cast<size_t>(y), static_cast<size_t>(x), weight});
      sum += static_cast<double>(weight);
    }
  }
  for (SphereTap& tap : taps)
    tap.weight /= static_cast<float>(sum);
  return taps;
}

} // namespace

void blur(OIIO::ImageBuf& image, const MakeSettings& s) {
  const int width = image.spec().width, height = image.spec().height;
  const auto channels = static_cast<size_t>(image.nchannels()), row = static_cast<size_t>(width) * channels;
  auto* pixels = static_cast<float*>(image.localpixels());
  for (size_t y = 0; widens(s.filter, s.swidth) && y < static_cast<size_t>(height); ++y)
    blur_line(pixels + y * row, width, channels, channels, s.filter, s.swidth, s.swrap);
  for (size_t x = 0; widens(s.filter, s.twidth) && x < static_cast<size_t>(width); ++x)
    blur_line(pixels + x * channels, height, row, channels, s.filter, s.twidth, s.twrap);
}

void blur_sphere(OIIO::ImageBuf& image, MakeSettings s) {
  if (!widens(s.filter, s.swidth) && !widens(s.filter, s.twidth)) return;
  reduce(image, s);
  const int width = image.spec().width, height = image.spec().height;
  const auto channels = static_cast<size_t>(image.nchannels()), columns = static_cast<size_t>(width),
             row = columns * channels;
  auto* pixels = static_cast<float*>(image.localpixels());
  const std::vector<float> before(pixels, pixels + static_cast<size_t>(height) * row);
  for (int y = 0; y < height; ++y) {
    float* out = pixels + static_cast<size_t>(y) * row;
    std::fill_n(out, row, 0.0f);
    for (const SphereTap& tap : taps_of_row(y, width, height, s))
      for (size_t x = 0; x < columns; ++x) {
        const float* from = before.data() + tap.row * row + (x + tap.across) % columns * channels;
        for (size_t c = 0; c < channels; ++c)
          out[x * channels + c] += tap.weight * from[c];
      }
  }
}

} // namespace render::oiio
