// The nearest pixel with a depth by the lower envelope of parabolas, first in columns, then in rows
// (Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, Theory of Computing 8, 2012).
#include "render/texture/dilate.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace render {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// For each place of a line the place p with the least cost[p] + (p - q)^2; -1 where all costs are infinite.
class LowerEnvelope {
public:
  explicit LowerEnvelope(size_t n) : places_(n), starts_(n) {}

  void find(const std::vector<double>& cost, std::vector<int>& nearest) {
    int parabolas = 0, n = static_cast<int>(cost.size());
    for (int p = 0; p < n; ++p) {
      if (cost[static_cast<size_t>(p)] == kFar) continue;
      double start = -kFar;
      for (; parabolas > 0; --parabolas) {
        int last = places_[static_cast<size_t>(parabolas - 1)];
        start = (value(cost, p) - value(cost, last)) / (2.0 * (p - last));
        if (start > starts_[static_cast<size_t>(parabolas - 1)]) break;
        start = -kFar;
      }
      places_[static_cast<size_t>(parabolas)] = p;
      starts_[static_cast<size_t>(parabolas++)] = start;
    }
    for (int q = 0, k = 0; q < n; ++q) {
      while (k + 1 < parabolas && starts_[static_cast<size_t>(k + 1)] < q)
        ++k;
      nearest[static_cast<size_t>(q)] = parabolas ? places_[static_cast<size_t>(k)] : -1;
    }
  }

private:
  static double value(const std::vector<double>& cost, int p) {
    return cost[static_cast<size_t>(p)] + static_cast<double>(p) * p;
  }
  std::vector<int> places_;
  std::vector<double> starts_; ///< where each parabola becomes the lowest
};

} // namespace

void dilate_depths(int width, int height, float radius, std::vector<float>& depths) {
  auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  std::vector<int> row_of(w * h); // the nearest pixel with a depth in the same column
  {
    LowerEnvelope envelope(h);
    std::vector<double> cost(h);
    std::vector<int> nearest(h);
    for (size_t x = 0; x < w; ++x) {
      for (size_t y = 0; y < h; ++y)
        cost[y] = std::isfinite(depths[y * w + x]) ? 0 : kFar;
      envelope.find(cost, nearest);
      for (size_t y = 0; y < h; ++y)
        row_of[y * w + x] = nearest[y];
    }
  }
  LowerEnvelope envelope(w);
  std::vector<double> cost(w);
  std::vector<int> nearest(w);
  std::vector<float> out(depths);
  const double most = static_cast<double>(radius) * radius;
  for (size_t y = 0; y < h; ++y) {
    for (size_t x = 0; x < w; ++x) {
      double d = row_of[y * w + x] - static_cast<double>(y);
      cost[x] = row_of[y * w + x] < 0 ? kFar : d * d;
    }
    envelope.find(cost, nearest);
    for (size_t x = 0; x < w; ++x) {
      if (nearest[x] < 0 || std::isfinite(depths[y * w + x])) continue;
      auto from = static_cast<size_t>(nearest[x]);
      double d = static_cast<double>(from) - static_cast<double>(x);
      if (cost[from] + d * d <= most)
        out[y * w + x] = depths[static_cast<size_t>(row_of[y * w + from]) * w + from];
    }
  }
  depths = std::move(out);
}

} // namespace render
