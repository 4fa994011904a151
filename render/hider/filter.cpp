// Filter formulas: box, triangle, gaussian, catmull-rom and sinc as in RISpec 3.2, appendix E; b-spline and
// mitchell (Mitchell and Netravali, 1988, B = C = 1/3) are separable cubics scaled to the filter's width, and
// blackman-harris (Harris, 1978, four terms) fills it. lanczos and bessel have their zeros at whole pixels.
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

float blackman_harris(float fraction) {
  float t = kPi * (1 + fraction);
  return 0.35875f - 0.48829f * std::cos(t) + 0.14128f * std::cos(2 * t) - 0.01168f * std::cos(3 * t);
}

/// The two-dimensional relative of sinc: 2 J1(pi r) / (pi r).
float jinc(float r) {
  float x = kPi * r;
  return x < 1e-3f ? 1.0f : 2 * static_cast<float>(::j1(static_cast<double>(x))) / x;
}

/// The family of cubics of Mitchell and Netravali, for |x| up to 2.
float cubic(float x, float b, float c) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x < 1) return (((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b)) / 6;
  return (((-b - 6 * c) * x + (6 * b + 30 * c)) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

} // namespace

bool is_separable(FilterKind kind) {
  return kind != FilterKind::kCatmullRom && kind != FilterKind::kDisk && kind != FilterKind::kBessel &&
         kind != FilterKind::kFunction;
}

float axis_weight(FilterKind kind, float x, float width) {
  float part = std::abs(2 * x / width); // of the half width
  if (part > 1) return 0;
  switch (kind) {
  case FilterKind::kTriangle: return 1 - part;
  case FilterKind::kGaussian: return std::exp(-2 * part * part);
  case FilterKind::kSeparableCatmullRom: return catmull_rom(std::abs(x));
  case FilterKind::kBSpline: return cubic(2 * part, 1, 0);
  case FilterKind::kMitchell: return cubic(2 * part, 1.0f / 3, 1.0f / 3);
  case FilterKind::kSinc: return sinc(x);
  case FilterKind::kBlackmanHarris: return blackman_harris(part);
  case FilterKind::kLanczos: return sinc(kPi * x) * sinc(kPi * part);
  default: return 1;
  }
}

float filter_weight(const PixelFilter& filter, float x, float y) {
  if (is_separable(filter.kind))
    return axis_weight(filter.kind, x, filter.xwidth) * axis_weight(filter.kind, y, filter.ywidth);
  float fx = 2 * x / filter.xwidth, fy = 2 * y / filter.ywidth;
  if (std::abs(fx) > 1 || std::abs(fy) > 1) return 0;
  if (filter.kind == FilterKind::kFunction)
    return filter.function ? filter.function(x, y, filter.xwidth, filter.ywidth) : 1.0f;
  float r = std::sqrt(x * x + y * y);
  if (filter.kind == FilterKind::kCatmullRom) return catmull_rom(r);
  if (fx * fx + fy * fy > 1) return 0;
  return filter.kind == FilterKind::kBessel ? jinc(r) : 1.0f;
}

} // namespace render
