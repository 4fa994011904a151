// Pixel filters of two dimensions: catmull-rom and disk as in RISpec 3.2, appendix E; bessel has its zeros
// where the dark rings of a round lens are.
#include "render/hider/filter.h"

#include <cmath>

namespace render {

namespace {

/// The two-dimensional relative of sinc: 2 J1(pi r) / (pi r).
float jinc(float r) {
  float x = kPi * r;
  return x < 1e-3f ? 1.0f : 2 * static_cast<float>(::j1(static_cast<double>(x))) / x;
}

} // namespace

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
