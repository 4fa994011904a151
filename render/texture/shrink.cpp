// Columns first: their sums run along whole rows, in vectors.
#include "render/texture/shrink.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace render {

namespace {

/// The pixels of a longer side that have a part in one of a shorter one.
struct Taps {
  std::vector<int> at;
  std::vector<float> weight; ///< sum 1
};

/// Those of its area, the first and the last of them in parts.
void cover(double begin, double end, Taps& out) {
  for (int k = static_cast<int>(begin); k < end; ++k) {
    out.at.push_back(k);
    out.weight.push_back(
        static_cast<float>(std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k))));
  }
}

/// Filters as wide as is usual between levels, in pixels of the smaller image.
struct Shape {
  FilterKind kind;
  float width, scale;

  explicit Shape(FilterKind k) : kind(k), width(4), scale(1) {
    if (k == FilterKind::kTriangle) width = 2;
    if (k == FilterKind::kGaussian || k == FilterKind::kBlackmanHarris) width = 3;
    if (k == FilterKind::kCatmullRom) kind = FilterKind::kSeparableCatmullRom;
    if (k == FilterKind::kSinc) scale = std::numbers::pi_v<float>; // its zeros at whole pixels
  }
  float weight(double distance) const {
    return axis_weight(kind, scale * static_cast<float>(distance), scale * width);
  }
};

void add_filter(FilterKind kind, double middle, double size, int from, TextureWrap wrap, Taps& out) {
  const Shape shape(kind);
  const double reach = static_cast<double>(shape.width) / 2 * size;
  for (int k = static_cast<int>(std::floor(middle - reach)); k < middle + reach; ++k) {
    const float w = shape.weight((k + 0.5 - middle) / size);
    if (w == 0) continue;
    out.at.push_back(wrapped(k, from, wrap == TextureWrap::kBlack ? TextureWrap::kClamp : wrap));
    out.weight.push_back(w);
  }
}

std::vector<Taps> taps(int from, int to, const LevelFilter& filter, TextureWrap wrap, bool latitudes) {
  std::vector<Taps> out(static_cast<size_t>(to));
  const double size = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Taps& t = out[static_cast<size_t>(i)];
    if (filter.kind == FilterKind::kBox || filter.kind == FilterKind::kDisk)
      cover(i * size, std::min((i + 1) * size, static_cast<double>(from)), t);
    else
      add_filter(filter.kind, (i + 0.5) * size, size, from, wrap, t);
    float sum = 0;
    for (size_t k = 0; k < t.at.size(); ++k) {
      if (latitudes)
        t.weight[k] *= std::sin(std::numbers::pi_v<float> * (static_cast<float>(t.at[k]) + 0.5f) /
                                static_cast<float>(from));
      sum += t.weight[k];
    }
    for (float& w : t.weight)
      w /= sum;
  }
  return out;
}

} // namespace

void add_scaled(const float* __restrict from, float weight, size_t count, float* __restrict sum) {
  for (size_t i = 0; i < count; ++i)
    sum[i] += weight * from[i];
}

ImageSize half_of(ImageSize s) {
  return {std::max(1, s.width / 2), std::max(1, s.height / 2)};
}

void shrink(ImageSize from, const ReadRow& read, ImageSize to, const WriteRow& write, size_t channels,
            const LevelFilter& filter) {
  const std::vector<Taps> columns = taps(from.width, to.width, filter, filter.swrap, false),
                          rows = taps(from.height, to.height, filter, filter.twrap, filter.sphere);
  const size_t row_size = static_cast<size_t>(from.width) * channels;
  std::vector<float> scratch(row_size), sum(row_size), out(static_cast<size_t>(to.width) * channels);
  for (int y = 0; y < to.height; ++y) {
    const Taps& row = rows[static_cast<size_t>(y)];
    std::fill(sum.begin(), sum.end(), 0.0f);
    for (size_t k = 0; k < row.at.size(); ++k)
      add_scaled(read(row.at[k], scratch.data()), row.weight[k], row_size, sum.data());
    std::fill(out.begin(), out.end(), 0.0f);
    float* pixel = out.data();
    for (const Taps& column : columns) {
      for (size_t k = 0; k < column.at.size(); ++k) {
        const float* p = sum.data() + static_cast<size_t>(column.at[k]) * channels;
        for (size_t c = 0; c < channels; ++c)
          pixel[c] += column.weight[k] * p[c];
      }
      pixel += channels;
    }
    write(y, out.data());
  }
}

FloatImage half_of(const FloatImage& image, const LevelFilter& filter) {
  const ImageSize from{image.width, image.height}, to = half_of(from);
  FloatImage out(to.width, to.height, image.channels);
  shrink(
      from, [&](int y, float*) { return image.row(y); }, to,
      [&](int y, const float* row) { std::copy_n(row, out.row_size(), out.row(y)); }, image.channels, filter);
  return out;
}

} // namespace render
