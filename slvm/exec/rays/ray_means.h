// Going through all rays of a source in batches of bounded size, and means over the rays of each point.
#pragma once

#include "slvm/exec/rays/ray_buffer.h"

#include <algorithm>
#include <numeric>

namespace slvm {

/// Calls f(rays) for batches that hold samples [first, last) of these points.
template <class F>
void for_each_batch(const RaySource& source, std::span<const uint32_t> places, uint32_t first, uint32_t last,
                    F&& f) {
  constexpr size_t kMostRays = 1 << 14; // stay in the cache
  const auto at_once =
      static_cast<uint32_t>(std::max<size_t>(kMostRays / std::max<size_t>(places.size(), 1), 1));
  RayBuffer rays;
  for (uint32_t sample = first; sample < last; sample += at_once) {
    rays.clear();
    for (uint32_t k = sample; k < last && k - sample < at_once; ++k)
      rays.add(source, places, k);
    f(static_cast<const RayBuffer&>(rays));
  }
}

/// All of them.
template <class F> void for_each_batch(const RaySource& source, F&& f) {
  std::vector<uint32_t> places(source.size());
  std::iota(places.begin(), places.end(), 0u);
  for_each_batch(source, places, 0, source.most_samples(), f);
}

/// Sums for each point of a source.
class RayMeans {
public:
  RayMeans(const RaySource& source, size_t components)
      : source_(source), sums_(components, std::vector<double>(source.size())) {}

  void add(size_t place, size_t component, float value) {
    sums_[component][place] += static_cast<double>(value);
  }
  double sum(size_t place, size_t component) const { return sums_[component][place]; }
  /// Over all samples of the point.
  float mean(size_t place, size_t component) const {
    return static_cast<float>(sum(place, component) / source_.samples[place]);
  }

private:
  const RaySource& source_;
  std::vector<std::vector<double>> sums_;
};

/// The middle of four directions at a point, to mean[0], mean[pitch] and mean[2 pitch]; returns the greatest
/// angle between it and them.
float cone_of_corners(std::span<const GridOperand> corners, size_t point, float* mean, size_t pitch);
/// environment("raytrace") and shadow("raytrace"): operands as of these functions.
void trace_environment(const GridCall& call);
void trace_shadow(const GridCall& call);

} // namespace slvm
