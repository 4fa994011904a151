// Levels of detail: several versions of an object, of which the size in the image chooses. RISpec 3.2,
// section 4.2.4.
//
// Between two versions both are drawn, each at a part of the samples of a pixel. Every sample has a number
// from 0 to 1; a version takes an interval of these, and where its range begins that of the next one ends, so
// that every sample sees one of the two.
#pragma once

#include "render/state/math.h"

#include <array>
#include <optional>

namespace render {

class Camera;

/// The samples that see a surface: those whose number is in [from, to).
struct LevelPart {
  float from = 0, to = 1;
  bool empty() const { return from >= to; }
  bool whole() const { return from <= 0 && to >= 1; }
  bool has(float number) const { return number >= from && number < to; }
};

struct LevelOfDetail {
  std::optional<std::array<Vec3, 8>> bound; ///< corners of the box of Detail, camera space
  float size = kInfinity;                   ///< pixels it covers, times RelativeDetail; infinite without one
  /// Of DetailRange: drawn between the first and the last, wholly between the two in the middle.
  std::array<float, 4> range{0, 0, kInfinity, kInfinity};

  LevelPart part() const;
};

/// Area in pixels of the rectangle around a box in the image, whether it is in the picture or not. What
/// reaches behind the eye is infinitely large.
float raster_area(const Camera&, const std::array<Vec3, 8>& corners);

} // namespace render
