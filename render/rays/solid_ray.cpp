// Constructed solids along a ray.
#include "render/hider/solid_hits.h"
#include "render/rays/ray_geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Two faces of a primitive crossed in the same sense nearer than this part of the distance are one at the
/// edge between them.
constexpr float kSamePlace = 2e-6f;

bool contains(const Box& box, Vec3 p) {
  return glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max));
}

} // namespace

/// As the hider does it (hider/solid_hits.h): a primitive that is crossed an odd number of times has the
/// ray's origin in it, if that is possible; else it is not closed.
std::vector<uint32_t> RayGeometry::bounding(uint32_t index, Vec3 origin,
                                            std::span<const RayCrossing> crossings) const {
  const Item& item = *items_[index];
  const RaySolid& solid = *item.solid;
  std::vector<uint32_t> order(crossings.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const RayHit &x = crossings[a].hit, &y = crossings[b].hit;
    return x.distance != y.distance ? x.distance < y.distance : x.face < y.face;
  });
  auto node_of = [&](uint32_t k) { return solid.node[part_of(item, crossings[k].hit.face)]; };
  SolidHits hits;
  std::vector<uint32_t> numbers; // of what is in `hits`
  for (uint32_t k : order) {
    const RayCrossing& c = crossings[k];
    SolidTree::NodeIndex node = node_of(k);
    bool again = false;
    for (size_t i = numbers.size(); i-- > 0 && !again;) {
      const RayCrossing& before = crossings[numbers[i]];
      if (c.hit.distance - before.hit.distance > kSamePlace * c.hit.distance) break;
      again = before.forth == c.forth && node_of(numbers[i]) == node;
    }
    if (again) continue;
    SolidHit hit{};
    hit.z = c.hit.distance;
    hit.primitive = node;
    hit.cut_near = contains(solid.bounds[node], origin);
    hits.add(hit);
    numbers.push_back(k);
  }
  std::vector<uint32_t> out;
  hits.resolve(*solid.tree, [&](size_t i, const SolidHit&) { out.push_back(numbers[i]); });
  return out;
}

} // namespace render
