// Which samples a micropolygon covers, as many at a time as the processor has lanes.
#pragma once

#include "render/hider/sample_window.h"
#include "render/state/math.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace render {

/// A micropolygon with corners a, b, c, d, u fastest, is two triangles with the side a-d in common.
enum class QuadPart : uint8_t { kFirst /* a b d */, kSecond /* a d c */ };

/// A sample in a micropolygon.
struct QuadHit {
  uint32_t sample;
  QuadPart part;
  float weights[3]; ///< barycentric, of the corners of that triangle in the order above
  float z;
};

/// All samples, in rows. The arrays are kPadding longer than there are samples.
struct SampleField {
  static constexpr size_t kPadding = 16;
  const float *x = nullptr, *y = nullptr; ///< raster
  const float* limit = nullptr;           ///< only what is nearer is a hit; null: everything is
  size_t width = 0;                       ///< samples in a row
  const float* time = nullptr;            ///< part of the shutter time; only where things move
  /// Shift on the raster of what has a defocus of 1; null: no lens.
  const float *lens_x = nullptr, *lens_y = nullptr;
  float focus = 0; ///< 1 / focal distance
};

/// Those of a stratum, one of each pixel: a row of samples for a row of pixels. The limits are those of all
/// samples.
struct StratumField : SampleField {
  const uint32_t* numbers = nullptr; ///< of the samples
};

/// Raster x and y, camera z of the corners at two parts of the shutter time; in a straight line between.
struct MovingQuad {
  Vec3 from[4], to[4];
  float t0, t1;
  Vec2 low, high; ///< around all of it, lens included

  bool still() const { return std::equal(from, from + 4, to); }
};

/// `both`: of a folded micropolygon that covers a sample twice both triangles count, else the first. Writes
/// to `hits`, which has room for two hits a sample looked at and SampleField::kPadding more, in the order of
/// the samples, and returns their number.
size_t quad_hits(const Vec3 (&p)[4], bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits);

/// The same of samples from [t0, t1) in a stratum. The window is one of pixels.
size_t moving_hits(const MovingQuad& quad, bool both, const StratumField& field, const SampleWindow& window,
                   QuadHit* hits);

/// The same of all samples of a window, of what moves so little that most of them may see it.
size_t slow_hits(const MovingQuad& quad, bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits);

} // namespace render
