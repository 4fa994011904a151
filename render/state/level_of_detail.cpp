// Sizes and shares of levels of detail.
#include "render/state/level_of_detail.h"

#include "render/state/camera.h"

namespace render {

LevelPart LevelOfDetail::part() const {
  auto [offlow, onlow, onhigh, offhigh] = range;
  if (size < offlow || size > offhigh) return {0, 0};
  LevelPart out;
  // The same quotient at the end of one range and at the beginning of the next.
  if (size < onlow) out.to = (size - offlow) / (onlow - offlow);
  if (size > onhigh && offhigh < kInfinity) out.from = (size - onhigh) / (offhigh - onhigh);
  return out;
}

float raster_area(const Camera& camera, const std::array<Vec3, 8>& corners) {
  Vec2 low(kInfinity), high(-kInfinity);
  for (Vec3 p : corners) {
    if (camera.perspective() && !(p.z >= camera.near_plane())) return kInfinity;
    Vec2 r = camera.project(p);
    low = glm::min(low, r);
    high = glm::max(high, r);
  }
  return (high.x - low.x) * (high.y - low.y);
}

} // namespace render
