// Jittered positions; times and lens points stratified over the samples of a pixel.
#include "render/hider/sample_pattern.h"

#include "render/hider/random.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Keeps areas and neighbourhoods (Shirley and Chiu, 1997): squares about the middle become circles.
Vec2 square_to_disk(Vec2 p) {
  if (p.x == 0 && p.y == 0) return p;
  bool wide = std::abs(p.x) > std::abs(p.y);
  float r = wide ? p.x : p.y;
  float angle = wide ? kPi / 4 * (p.y / p.x) : kPi / 2 - kPi / 4 * (p.x / p.y);
  return {r * std::cos(angle), r * std::sin(angle)};
}

/// A shuffled 0..n-1.
void shuffle(std::vector<int>& order, int64_t x, int64_t y, uint64_t purpose) {
  std::iota(order.begin(), order.end(), 0);
  for (size_t i = order.size(); i > 1; --i) {
    uint64_t h = hash_of(x, y, purpose + 64 * i);
    std::swap(order[i - 1], order[static_cast<size_t>(h % i)]);
  }
}

/// The lens is a square of cells, from -1 to 1, before it becomes a disk.
Vec2 lens_cell_size(const SampleGridSize& size) {
  return {2 / static_cast<float>(size.xsamples), 2 / static_cast<float>(size.ysamples)};
}

} // namespace

JitterTile::JitterTile(const SampleGridSize& size) {
  // Too large for the eye to see it repeat, small enough for a cache.
  constexpr int kPixels = 64, kSamples = 256;
  if (size.jitter)
    for (period = kPixels; period > 1 && period * std::max(size.xsamples, size.ysamples) > kSamples;)
      period /= 2;
  const int columns = period * size.xsamples, rows = period * size.ysamples;
  x.assign(static_cast<size_t>(columns) * static_cast<size_t>(rows), 0.5f);
  y = x;
  for (int j = 0, k = 0; size.jitter && j < rows; ++j)
    for (int i = 0; i < columns; ++i, ++k) {
      const uint64_t h = hash_of(i, j, kJitter);
      x[static_cast<size_t>(k)] = upper_unit(h);
      y[static_cast<size_t>(k)] = lower_unit(h);
    }
}

SamplePattern::SamplePattern(const SampleGridSize& size, bool timed, bool lens,
                             std::shared_ptr<const JitterTile> tile)
    : size_(size), timed_(timed || lens), with_lens_(lens), tile_(std::move(tile)),
      strata_(size.xsamples * size.ysamples) {
  if (!tile_) tile_ = std::make_shared<const JitterTile>(size);
  if (lens) make_lens_boxes();
}

namespace {

/// The remainder that is not negative.
int wrapped(int i, int size) {
  const int rest = i % size;
  return rest < 0 ? rest + size : rest;
}

} // namespace

void SamplePattern::jitter(std::span<float> x, std::span<float> y, int column, int row) const {
  const int columns = period() * size_.xsamples, rows = period() * size_.ysamples;
  const auto first = static_cast<size_t>(wrapped(row, rows) * columns);
  int at = wrapped(column, columns);
  for (size_t k = 0; k < x.size(); ++k) {
    x[k] = tile_->x[first + static_cast<size_t>(at)];
    y[k] = tile_->y[first + static_cast<size_t>(at)];
    at += size_.xsamples;
    if (at >= columns) at -= columns;
  }
}

bool SamplePattern::may_have(Vec2 low, Vec2 high) const {
  constexpr float kSmall = 4, kFar = 1 << 24, kSlack = 1e-3f; // samples, samples, pixels
  const Vec2 density(size_.xsamples, size_.ysamples);
  low = (low - kSlack) * density;
  high = (high + kSlack) * density;
  if (!(high.x - low.x < kSmall && high.y - low.y < kSmall)) return true;
  // What is far outside, as points near the eye are, has no whole numbers.
  if (!(std::min(low.x, low.y) > -kFar && std::max(high.x, high.y) < kFar)) return true;
  // std::floor is a call on processors without SSE 4.1.
  auto floor = [](float v) {
    const int cut = static_cast<int>(v);
    return cut - (v < static_cast<float>(cut));
  };
  const int columns = period() * size_.xsamples, rows = period() * size_.ysamples;
  const int first_i = floor(low.x), first_j = floor(low.y);
  const int first_column = wrapped(first_i, columns), last_i = floor(high.x), last_j = floor(high.y);
  int found = 0; // branches would go one way as often as the other
  for (int j = first_j, row = wrapped(j, rows); j <= last_j; ++j, row = row + 1 < rows ? row + 1 : 0) {
    const auto y0 = static_cast<float>(j);
    for (int i = first_i, column = first_column; i <= last_i;
         ++i, column = column + 1 < columns ? column + 1 : 0) {
      const auto at = static_cast<size_t>(row * columns + column);
      const float x = static_cast<float>(i) + tile_->x[at], y = y0 + tile_->y[at];
      found |= int{x >= low.x} & int{x <= high.x} & int{y >= low.y} & int{y <= high.y};
    }
  }
  return found != 0;
}

void SamplePattern::cover(PixelRect area) {
  columns_ = area.width();
  width_ = area.width() * size_.xsamples;
  height_ = area.height() * size_.ysamples;
  count_ = static_cast<size_t>(width_) * static_cast<size_t>(height_);
  x_.resize(count_ + kPadding);
  y_.resize(count_ + kPadding);
  auto xs = static_cast<float>(size_.xsamples), ys = static_cast<float>(size_.ysamples);
  const int columns = period() * size_.xsamples, rows = period() * size_.ysamples;
  const int x0 = area.x0 * size_.xsamples, y0 = area.y0 * size_.ysamples;
  float *to_x = x_.data(), *to_y = y_.data();
  for (int j = 0; j < height_; ++j) {
    const auto row = static_cast<size_t>(wrapped(y0 + j, rows) * columns);
    const auto y = static_cast<float>(y0 + j);
    for (int i = 0; i < width_;) {
      // As far as the tile goes on without a break.
      const int first = wrapped(x0 + i, columns), count = std::min(columns - first, width_ - i);
      const float *dx = tile_->x.data() + row + first, *dy = tile_->y.data() + row + first;
      for (int k = 0; k < count; ++k) {
        to_x[k] = (static_cast<float>(x0 + i + k) + dx[k]) / xs;
        to_y[k] = (y + dy[k]) / ys;
      }
      i += count;
      to_x += count;
      to_y += count;
    }
  }
  if (timed_) add_strata(area);
  if (size_.levels) add_levels(area);
}

namespace {

/// Part `within`, [0, 1), of one of n strata of [0, 1): never that of the next one, by rounding.
float in_stratum(size_t stratum, float within, size_t n) {
  const auto first = static_cast<float>(stratum), all = static_cast<float>(n);
  const float at = (first + within) / all, end = (first + 1) / all;
  return at < end ? at : std::nextafter(end, 0.0f);
}

} // namespace

void SamplePattern::add_levels(PixelRect area) {
  level_.resize(count_);
  std::vector<int> order(static_cast<size_t>(strata_));
  for (int row = 0; row < area.height(); ++row)
    for (int column = 0; column < area.width(); ++column) {
      int x = area.x0 + column, y = area.y0 + row;
      shuffle(order, x, y, kLevelStrata);
      for (int s = 0; s < strata_; ++s) {
        int cell = order[static_cast<size_t>(s)];
        int i = column * size_.xsamples + cell % size_.xsamples,
            j = row * size_.ysamples + cell / size_.xsamples;
        const float within = upper_unit(hash_of(x, y, kLevel + 64 * static_cast<uint64_t>(s)));
        level_[static_cast<size_t>(j) * static_cast<size_t>(width_) + static_cast<size_t>(i)] =
            in_stratum(static_cast<size_t>(s), within, order.size());
      }
    }
}

Vec2 SamplePattern::lens_corner(size_t stratum) const {
  const int cell = lens_cells_[stratum], column = cell % size_.xsamples, row = cell / size_.xsamples;
  return Vec2(static_cast<float>(column), static_cast<float>(row)) * lens_cell_size(size_) - Vec2(1.0f);
}

void SamplePattern::make_lens_boxes() {
  auto n = static_cast<size_t>(strata_);
  lens_cells_.resize(n);
  shuffle(lens_cells_, 0, 0, kLensCells);
  for (size_t s = 0; s < n; ++s) {
    // The extremes are at corners of the cell, or where it crosses an axis.
    constexpr float kSlack = 1e-4f;
    Vec2 low = lens_corner(s), high = low + lens_cell_size(size_);
    LensBox box{Vec2(kInfinity), Vec2(-kInfinity)};
    auto add = [&](Vec2 p) {
      Vec2 q = square_to_disk(p);
      box.min = glm::min(box.min, q - kSlack);
      box.max = glm::max(box.max, q + kSlack);
    };
    for (float x : {low.x, high.x})
      for (float y : {low.y, high.y})
        add({x, y});
    if (low.x < 0 && high.x > 0) add({0, low.y}), add({0, high.y});
    if (low.y < 0 && high.y > 0) add({low.x, 0}), add({high.x, 0});
    lens_boxes_.push_back(box);
  }
}

void SamplePattern::add_strata(PixelRect area) {
  auto n = static_cast<size_t>(strata_);
  time_.resize(count_ + kPadding);
  if (with_lens_) lens_.resize(count_);
  of_stratum_.resize(count_ + kPadding);
  std::vector<int> order(n);
  Vec2 cell_size = lens_cell_size(size_);
  auto width = static_cast<size_t>(width_);
  for (int row = 0; row < area.height(); ++row)
    for (int column = 0; column < area.width(); ++column) {
      int x = area.x0 + column, y = area.y0 + row;
      shuffle(order, x, y, kStrata);
      for (size_t s = 0; s < n; ++s) {
        int i = column * size_.xsamples + order[s] % size_.xsamples;
        int j = row * size_.ysamples + order[s] / size_.xsamples;
        size_t k = static_cast<size_t>(j) * width + static_cast<size_t>(i);
        size_t pixel = static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
        of_stratum_[s * pixels() + pixel] = static_cast<uint32_t>(k);
        uint64_t h = hash_of(x, y, kTime + 64 * s);
        time_[k] = in_stratum(s, upper_unit(h), n);
        if (!with_lens_) continue;
        uint64_t g = hash_of(x, y, kLens + 64 * s);
        lens_[k] = square_to_disk(lens_corner(s) + cell_size * Vec2(upper_unit(g), lower_unit(g)));
      }
    }
}

} // namespace render
