// Constructed solids along a ray.
#include "render/hider/solid_hits.h"
#include "render/rays/ray_geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace render {

namespace {

/// Faces of a primitive crossed nearer to each other than this part of the distance are crossed at the edge
/// or corner between them.
constexpr float kSamePlace = 2e-6f;
/// Faces so much smaller than others there are what rounding left of collapsed ones.
constexpr float kSliver = 1e-3f;

bool contains(const Box& box, Vec3 p) {
  return glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max));
}

} // namespace

/// As the hider does it (hider/solid_hits.h): a primitive that is crossed an odd number of times has the
/// ray's origin in it, if that is possible; else it is not closed.
std::vector<uint32_t> RayGeometry::bounding(uint32_t index, const RayRule& rule, Vec3 origin,
                                            std::span<const RayCrossing> crossings) const {
  const Item& item = *items_[index];
  const RaySolid& solid = *item.solid;
  std::vector<uint32_t> order(crossings.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const RayHit &x = crossings[a].hit, &y = crossings[b].hit;
    return x.distance != y.distance ? x.distance < y.distance : x.face < y.face;
  });
  auto node_of = [&](uint32_t k) { return solid.node[item.parts->find(crossings[k].hit.face)]; };
  SolidHits hits;
  std::vector<uint32_t> numbers; // of what is in `hits`
  std::vector<uint8_t> done(order.size());
  for (size_t first = 0; first < order.size(); ++first) {
    if (done[first]) continue;
    const float distance = crossings[order[first]].hit.distance;
    const SolidTree::NodeIndex node = node_of(order[first]);
    float forth = 0, back = 0;
    uint32_t largest = order[first];
    for (size_t i = first; i < order.size(); ++i) {
      const RayCrossing& c = crossings[order[i]];
      if (c.hit.distance - distance > kSamePlace * distance) break;
      if (node_of(order[i]) != node) continue;
      done[i] = 1;
      (c.along >= 0 ? forth : back) += std::abs(c.along);
      if (std::abs(c.along) > std::abs(crossings[largest].along)) largest = order[i];
    }
    if (std::min(forth, back) > kSliver * std::max(forth, back)) continue; // the ray only touches it there
    SolidHit hit{};
    hit.z = crossings[largest].hit.distance;
    hit.primitive = node;
    hit.cut_near = contains(solid.bounds[node], origin);
    hits.add(hit);
    numbers.push_back(largest);
  }
  std::vector<uint32_t> out;
  hits.resolve(*solid.tree, [&](size_t i, const SolidHit&) { out.push_back(numbers[i]); });
  std::erase_if(out, [&](uint32_t k) { return !is_seen(item, rule, crossings[k]); });
  return out;
}

/// Every surface of a solid has its own visibility, groups and sides; all of them bound it.
bool RayGeometry::is_seen(const Item& item, const RayRule& rule, const RayCrossing& crossing) const {
  const size_t number = scene_.primitives.run_number(primitive_of(item, crossing.hit.face));
  if (rule.seen_surfaces && !rule.seen_surfaces[number]) return false;
  const PrimitiveList::Run& run = scene_.primitives.runs()[number];
  const bool front = (crossing.along < 0) != run.attributes().flips_normals(run.state->mirrored);
  if (run.attributes().sides == 1 && !front) return false;
  return rule.sides == slvm::HitSides::kBoth || front == (rule.sides == slvm::HitSides::kFront);
}

} // namespace render
