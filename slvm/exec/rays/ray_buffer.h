// Rays as a batch: those of some points, one sample after the other, with the memory for what they bring
// back.
#pragma once

#include "slvm/exec/rays/ray_source.h"

#include <span>

namespace slvm {

class RayBuffer {
public:
  void clear();
  size_t size() const { return place_.size(); }

  /// Adds sample `sample` of those of these points of the source (by their places there) that have so many.
  void add(const RaySource& source, std::span<const uint32_t> places, uint32_t sample);

  RayBatch batch() const;

  /// Of ray r.
  uint32_t point(size_t r) const { return point_[r]; } ///< on the grid
  const uint32_t* points() const { return point_.data(); }
  uint32_t place(size_t r) const { return place_[r]; } ///< in the source
  float origin(size_t component, size_t r) const { return origin_[component][r]; }
  float direction(size_t component, size_t r) const { return direction_[component][r]; }
  float bias(size_t r) const { return bias_.empty() ? -1.0f : bias_[r]; }
  /// What chose the direction in the cone.
  float turn(size_t r) const { return turn_[r]; }
  float radius(size_t r) const { return radius_[r]; }
  /// For directions that come from elsewhere.
  float* directions(size_t component) { return direction_[component].data(); }
  const float* turns() const { return turn_.data(); }
  const float* radii() const { return radius_.data(); }
  /// Leaves out the rays for which keep(r) is false, once their directions are known.
  template <class Keep> void filter(Keep&& keep) {
    std::vector<uint32_t> kept;
    for (uint32_t r = 0; r < size(); ++r)
      if (keep(r)) kept.push_back(r);
    if (kept.size() != size()) retain(kept);
  }

private:
  template <class At> void fill(const RaySource& source, size_t first, uint32_t sample, At at);
  template <class At>
  static void draw(const RaySource& source, const SobolSample& numbers, SampleUse use, float* out,
                   size_t count, At at);
  template <class At> void aim(const RaySource& source, size_t first, size_t count, At at);
  template <class At>
  void spread_origins(const RaySource& source, const SobolSample& numbers, size_t first, size_t count, At at);
  template <class At> void widen(const RaySource& source, size_t first, size_t count, At at);
  void retain(const std::vector<uint32_t>& kept);
  template <class F> void each_array(F&& f);

  std::vector<uint32_t> point_, place_, sample_;
  PointTriples origin_, direction_;
  PointArray turn_, radius_, max_distance_, bias_;
  PointTriples weight_, origin_du_, origin_dv_, direction_du_, direction_dv_;
};

} // namespace slvm
