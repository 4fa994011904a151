// Filter formulas: box, triangle, gaussian, catmull-rom and sinc as in RISpec 3.2, appendix E; b-spline and
// mitchell (Mitchell and Netravali, 1988, B = C = 1/3) are separable cubics scaled to the filter's width.
#include "render/hider/filter.h"

#include <cmath>

namespace render {

namespace {

float catmull_rom(float r) {
  if (r >= 2) return 0;
  if (r < 1) return (1.5f * r - 2.5f) * r * r + 1;
  return ((-0.5f * r + 2.5f) * r - 4) * r + 2;
}

float sinc(float x) {
  return std::abs(x) < 1e-3f ? 1.0f : std::sin(x) / x;
}

/// The family of cubics of Mitchell and Netravali, for |x| up to 2.
float cubic(float x, float b, float c) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x < 1) return (((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b)) / 6;
  return (((-b - 6 * c) * x + (6 * b + 30 * c)) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

} // namespace

float filter_weight(const PixelFilter& filter, float x, float y) {
  // Fractions of the half width.
  float fx = std::abs(2 * x / filter.xwidth), fy = std::abs(2 * y / filter.ywidth);
  if (fx > 1 || fy > 1) return 0;
  switch (filter.kind) {
  case FilterKind::kBox: return 1;
  case FilterKind::kTriangle: return (1 - fx) * (1 - fy);
  case FilterKind::kGaussian: return std::exp(-2 * (fx * fx + fy * fy));
  case FilterKind::kCatmullRom: return catmull_rom(std::sqrt(x * x + y * y));
  case FilterKind::kBSpline: return cubic(2 * fx, 1, 0) * cubic(2 * fy, 1, 0);
  case FilterKind::kSinc: return sinc(x) * sinc(y);
  case FilterKind::kMitchell: return cubic(2 * fx, 1.0f / 3, 1.0f / 3) * cubic(2 * fy, 1.0f / 3, 1.0f / 3);
  }
  return 0;
}

} // namespace render
