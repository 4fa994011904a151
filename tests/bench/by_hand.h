// The benchmark shaders as somebody would write them by hand for one renderer: one fused loop over vectors of
// points in Highway, intermediate values in registers, the same formulas and the same noise as the virtual
// machine's.
#pragma once

#include <cstddef>

namespace bench {

/// Planes of floats, aligned to 64 bytes and padded to a multiple of 16 points.
struct Points {
  size_t count = 0;
  const float *p[3], *n[3], *i[3], *s, *t;
  float* ci[3];
};

/// shaders/standard/plastic.sl with its default parameters, lit by a point light and a distant light.
struct Lights {
  float point_from[3], point_intensity;
  float direction[3], distant_intensity; ///< direction: from the light
};

void plastic_by_hand(const Points&, const Lights&);
void fbm_by_hand(const Points&);
void marble_by_hand(const Points&);
void divergent_by_hand(const Points&);

} // namespace bench
