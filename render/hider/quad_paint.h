// Opaque micropolygons that stand still, drawn straight into planes of samples: what most pictures are made
// of.
#pragma once

#include "render/hider/shaded_grid.h"
#include "render/state/camera.h"

#include <cstddef>
#include <span>
#include <vector>

namespace render {

/// Values of points, and the plane that gets them: that of point k is values[step * k].
struct PaintedValues {
  const float* values;
  size_t step;
  float* plane;
};

/// Samples in rows; all planes are SampleField::kPadding longer than there are samples.
struct SampleCanvas {
  PixelRect covered;  ///< the pixels whose samples these are
  int width, height;  ///< in samples
  Vec2 density;       ///< samples a pixel
  const float *x, *y; ///< raster
  float* z;           ///< of the nearest surface; infinite: none
  float near_plane, far_plane;
};

/// The surfaces of the grid that are nearer than what was there give the samples their depths and values,
/// those of the nearest first corner without smooth shading. Of a folded micropolygon that covers a sample
/// twice the first triangle counts (QuadPart). Micropolygons that are not opaque are left out; to `rest` go
/// the first corners of those with anything to be seen. Returns how many samples had no surface before.
size_t paint(const ShadedGrid& grid, std::span<const PaintedValues> values, const SampleCanvas& canvas,
             std::vector<size_t>& rest);

} // namespace render
