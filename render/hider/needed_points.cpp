// Corners of what is seen.
#include "render/hider/needed_points.h"

#include <algorithm>

namespace render {

void NeededPoints::find(const ShadedGrid& g, const SamplePattern* samples) {
  const auto nu = static_cast<size_t>(g.nu), nv = static_cast<size_t>(g.nv);
  needed_.assign(g.points(), 0);
  const float *x = g.position.plane(0), *y = g.position.plane(1);
  auto may_be_seen = [&](size_t a, size_t b, size_t c, size_t d) {
    const Vec2 low(std::min({x[a], x[b], x[c], x[d]}), std::min({y[a], y[b], y[c], y[d]})),
        high(std::max({x[a], x[b], x[c], x[d]}), std::max({y[a], y[b], y[c], y[d]}));
    return samples->may_have(low, high);
  };
  for (size_t j = 0, m = 0; j + 1 < nv; ++j)
    for (size_t i = 0; i + 1 < nu; ++i, ++m) {
      const size_t a = j * nu + i, b = a + 1, c = a + nu, d = c + 1;
      if (g.hidden[m] == ShadedGrid::kNotDrawn || (samples && !may_be_seen(a, b, c, d))) continue;
      needed_[a] = 1;
      if (g.smooth) needed_[b] = needed_[c] = needed_[d] = 1;
    }
  points_.clear();
  for (uint32_t k = 0; k < needed_.size(); ++k)
    if (needed_[k]) points_.push_back(k);
}

} // namespace render
