// Where what is in a bound can be seen.
#include "render/state/procedural.h"

namespace render {

std::optional<SeenBound> seen_bound(const Procedural& p, const Camera& camera, Vec2 margin) {
  Box box = transform_box(p.object_to_camera, p.bound);
  for (const auto& key : p.motion)
    box.add(transform_box(key.value, p.bound));
  box.grow(p.displacement_bound);
  return seen_bound(box, camera, margin);
}

std::optional<SeenBound> seen_bound(const Box& box, const Camera& camera, Vec2 margin) {
  // A box that is not a number is seen nowhere; the negated tests catch it.
  if (!(box.max.z >= camera.near_plane()) || !(box.min.z <= camera.far_plane())) return {};
  PixelRect crop = camera.crop();
  Vec2 first(static_cast<float>(crop.x0), static_cast<float>(crop.y0)),
      last(static_cast<float>(crop.x1), static_cast<float>(crop.y1));
  float whole = (last.x - first.x) * (last.y - first.y);
  SeenBound seen{first, last, std::max(box.min.z, camera.near_plane()), whole};
  if (camera.perspective() && box.min.z < camera.near_plane()) return seen;
  Vec2 low(kInfinity), high(-kInfinity);
  for (int i = 0; i < 8; ++i) {
    Vec2 corner = camera.project(box.corner(i));
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  seen.area = (high.x - low.x) * (high.y - low.y);
  if (!(seen.area < kInfinity)) seen.area = whole;
  Vec2 blur = camera.blur(seen.zmin, box.max.z);
  seen.raster_min = low - blur;
  seen.raster_max = high + blur;
  Vec2 from = first - margin, to = last + margin;
  if (!(seen.raster_max.x >= from.x) || !(seen.raster_min.x <= to.x) || !(seen.raster_max.y >= from.y) ||
      !(seen.raster_min.y <= to.y))
    return {};
  return seen;
}

} // namespace render
