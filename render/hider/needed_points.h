// Which points of a grid have to be shaded, where shaders treat each by itself: the corners of micropolygons
// that are drawn and that samples may see. Of a mesh of faces smaller than pixels, of hair, of the far side
// of a ball that is most of the work saved.
#pragma once

#include "render/hider/sample_pattern.h"
#include "render/hider/shaded_grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace render {

class NeededPoints {
public:
  /// Finds them among those of a grid that nothing blurs. Without smooth shading a micropolygon has the looks
  /// of its own corner; smooth ones need all four. Null: all micropolygons that are drawn have samples.
  void find(const ShadedGrid& geometry, const SamplePattern* samples);
  bool empty() const { return points_.empty(); }
  /// Whether there are so few of all `points` that it is worth while to shade them alone.
  bool few(size_t points) const { return points_.size() * 5 < points * 4; }
  std::span<const uint32_t> points() const { return points_; } ///< ascending

private:
  std::vector<uint32_t> points_;
  std::vector<uint8_t> needed_;
};

} // namespace render
