// Whether a bound can be seen.
#include "render/state/procedural.h"

namespace render {

std::optional<float> visible_area(const Camera& camera, const Options& options, const Box& box) {
  if (!(box.max.z >= camera.near_plane()) || !(box.min.z <= camera.far_plane())) return {};
  PixelRect crop = camera.crop();
  auto whole = static_cast<float>(crop.width()) * static_cast<float>(crop.height());
  // What reaches behind the near plane has no projection: it may be anywhere.
  if (camera.perspective() && box.min.z < camera.near_plane()) return whole;
  Vec2 low(kInfinity), high(-kInfinity);
  for (int i = 0; i < 8; ++i) {
    Vec2 p = camera.project(box.corner(i));
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  // Filters, lens and shutter make things wider than they are.
  constexpr float kMargin = 16;
  float mx = kMargin + options.filter.xwidth, my = kMargin + options.filter.ywidth;
  bool outside = high.x < static_cast<float>(crop.x0) - mx || low.x > static_cast<float>(crop.x1) + mx ||
                 high.y < static_cast<float>(crop.y0) - my || low.y > static_cast<float>(crop.y1) + my;
  if (outside) return {};
  float area = (high.x - low.x) * (high.y - low.y);
  return area < kInfinity ? area : whole;
}

} // namespace render
