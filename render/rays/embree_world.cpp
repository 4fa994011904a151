// Embree: a top-level scene with one user-defined primitive an item. Embree calls back for a ray that reaches
// an item's box; the callback has the item's faces made, if need be, and goes on tracing in their scene. That
// Embree's own instances are not used makes the world lazy: an item no ray comes near is never tessellated,
// and items can be dropped and made again while the world stays as it is.
#include "render/rays/embree_world.h"

#include "render/rays/embree_calls.h"
#include "render/rays/embree_faces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <tuple>

namespace render {

struct RayWorld::Impl {
  Impl(std::vector<WorldItem> i, ItemFaces& f) : items(std::move(i)), source(f), known(items.size()) {}

  std::vector<WorldItem> items;
  ItemFaces& source;
  RTCScene top = nullptr; ///< null: nothing to hit
  /// Faces that were asked for: there are many rays an item.
  mutable std::vector<std::atomic<RTCScene>> known;

  /// Null: the item has none.
  RTCScene faces(uint32_t item) const {
    if (RTCScene scene = known[item].load(std::memory_order_acquire)) return scene;
    const FaceScene* made = source.faces(item);
    if (!made) return nullptr;
    known[item].store(scene_of(made), std::memory_order_release);
    return scene_of(made);
  }
};

namespace {

/// Hits of two faces of a surface that differ by less, relative to the distance, are one at the edge between
/// them.
constexpr float kSamePlace = 2e-6f;

/// One ray on its way. The outer context goes through the top level, the inner one through the faces of an
/// item; both are the beginning of this, so that callbacks find it.
struct Query {
  struct Outer : QueryContext {
    Query* query;
  } outer;
  struct Inner : QueryContext {
    Query* query;
  } inner;
  const RayRule& rule;
  const ItemFaces* faces;
  const slvm::RayCursor* behind = nullptr;
  const uint8_t* solid = nullptr;
  std::vector<RayHit>* list = nullptr;
  size_t most = 0;
  std::vector<RayCrossing>* crossings = nullptr; ///< with a solid, while they are gathered
  uint32_t item = 0;                             ///< being looked at
  uint32_t hit_item = 0;
  bool needs_front = false, needs_back = false, flipped = false; ///< in that item

  Query(const RayRule& r, const ItemFaces& f) : rule(r), faces(&f) {
    init_context(outer);
    init_context(inner);
    outer.query = this;
    inner.query = this;
  }

  /// False: no face of the item counts.
  bool enter(const WorldItem& it, uint32_t index) {
    if (rule.seen && !rule.seen[index]) return false;
    item = index;
    needs_front = needs_back = false;
    if (it.solid) return true;
    needs_front = it.one_sided || rule.sides == slvm::HitSides::kFront;
    needs_back = rule.sides == slvm::HitSides::kBack;
    flipped = it.flipped;
    return !(needs_front && needs_back);
  }
  bool keeps(const RayCrossing& crossing) {
    if (needs_front || needs_back) {
      bool front = (crossing.along < 0) != flipped;
      if (needs_front ? !front : front) return false;
    }
    if (behind && !is_behind(crossing.hit.distance, crossing.hit.face)) return false;
    if (!list || (solid && solid[item])) return true;
    if (list->size() < most) list->push_back(crossing.hit);
    return list->size() >= most;
  }
  bool is_behind(float distance, uint32_t face) const {
    if (behind->primitive == item && std::abs(distance - behind->distance) <= kSamePlace * distance &&
        (behind->face == face || faces->same_surface(item, face, behind->face)))
      return false;
    return std::tie(distance, item, face) > std::tie(behind->distance, behind->primitive, behind->face);
  }
  bool filters() const { return needs_front || needs_back || behind || list; }
};

Query& query_of(const void* context, bool inner) {
  return inner ? *static_cast<const Query::Inner*>(context)->query
               : *static_cast<const Query::Outer*>(context)->query;
}

RayCrossing crossing_of(const Query& q, const RTCFilterFunctionNArguments* args) {
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  // Embree's normals of quadrilaterals are along (first side) x (last side).
  float along = hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z;
  return {{ray.tfar, q.item, hit.primID, hit.u, hit.v}, along};
}

void filter_hit(const RTCFilterFunctionNArguments* args) {
  if (!args->valid[0]) return;
  Query& q = query_of(args->context, true);
  if (!q.keeps(crossing_of(q, args))) args->valid[0] = 0;
}

void gather_crossing(const RTCFilterFunctionNArguments* args) {
  if (!args->valid[0]) return;
  Query& q = query_of(args->context, true);
  q.crossings->push_back(crossing_of(q, args));
  args->valid[0] = 0;
}

void set_ray(RTCRay& out, const RaySegment& ray) {
  out.org_x = ray.origin.x;
  out.org_y = ray.origin.y;
  out.org_z = ray.origin.z;
  out.dir_x = ray.direction.x;
  out.dir_y = ray.direction.y;
  out.dir_z = ray.direction.z;
  out.tnear = ray.nearest;
  out.tfar = ray.farthest;
  out.time = ray.time;
  out.mask = ~0u;
  out.id = 0;
  out.flags = 0;
}

/// The ray in the space of an item. Its direction is not brought to length 1, so that distances stay.
RTCRay place(const RTCRay& ray, const Matrix4& m) {
  RTCRay out = ray;
  Vec3 o = transform_point(m, Vec3(ray.org_x, ray.org_y, ray.org_z)),
       d = transform_vector(m, Vec3(ray.dir_x, ray.dir_y, ray.dir_z));
  out.org_x = o.x;
  out.org_y = o.y;
  out.org_z = o.z;
  out.dir_x = d.x;
  out.dir_y = d.y;
  out.dir_z = d.z;
  return out;
}

/// What rays of both kinds do at an item: trace(query, is solid, faces, filter) takes the ray in the item's
/// own space.
template <class Arguments, class Trace> void visit_item(const Arguments* args, RTCRay& ray, Trace&& trace) {
  if (!args->valid[0]) return;
  Query& q = query_of(args->context, false);
  const auto& world = *static_cast<const RayWorld::Impl*>(args->geometryUserPtr);
  const WorldItem& item = world.items[args->primID];
  if (!q.enter(item, args->primID)) return;
  const RTCScene faces = world.faces(args->primID);
  if (!faces) return;
  const RTCFilterFunctionN filter = q.filters() ? filter_hit : nullptr;
  if (!item.placed) {
    trace(q, item.solid, faces, filter);
    return;
  }
  const RTCRay whole = ray;
  ray = place(ray, item.to_item);
  trace(q, item.solid, faces, filter);
  const float reached = ray.tfar;
  ray = whole;
  ray.tfar = reached;
}

/// The nearest hit on a solid that counts. Which faces bound it depends on all that the ray crosses from its
/// origin on, however near or far the hits may be that are looked for.
std::optional<RayHit> hit_solid(Query& q, RTCScene faces, const RTCRay& ray) {
  std::vector<RayCrossing> all;
  q.crossings = &all;
  RTCRay whole = ray;
  whole.tnear = 0;
  whole.tfar = kInfinity;
  occluded(faces, q.inner, gather_crossing, whole);
  if (all.empty()) return {};
  for (uint32_t k : q.faces->bounding(q.item, q.rule, {ray.org_x, ray.org_y, ray.org_z}, all))
    if (all[k].hit.distance >= ray.tnear && all[k].hit.distance <= ray.tfar && q.keeps(all[k]))
      return all[k].hit;
  return {};
}

void intersect_item(const RTCIntersectFunctionNArguments* args) {
  auto& ray = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  visit_item(args, ray.ray, [&](Query& q, bool solid, RTCScene faces, RTCFilterFunctionN filter) {
    // A face at the distance of the last hit takes its place, and tfar stays: only geomID tells. Where
    // nothing is hit the rest is not touched.
    const unsigned before = ray.hit.geomID;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    if (!solid)
      intersect(faces, q.inner, filter, ray);
    else if (auto hit = hit_solid(q, faces, ray.ray)) {
      ray.ray.tfar = hit->distance;
      ray.hit.geomID = 0;
      ray.hit.primID = hit->face;
      ray.hit.u = hit->u;
      ray.hit.v = hit->v;
    }
    if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID)
      q.hit_item = args->primID;
    else
      ray.hit.geomID = before;
  });
}

void occlude_item(const RTCOccludedFunctionNArguments* args) {
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  visit_item(args, ray, [&](Query& q, bool solid, RTCScene faces, RTCFilterFunctionN filter) {
    if (!solid)
      occluded(faces, q.inner, filter, ray);
    else if (hit_solid(q, faces, ray))
      ray.tfar = -kInfinity;
  });
}

void bound_item(const RTCBoundsFunctionArguments* args) {
  const Box& box = static_cast<const RayWorld::Impl*>(args->geometryUserPtr)->items[args->primID].bounds;
  RTCBounds& out = *args->bounds_o;
  out.lower_x = box.min.x;
  out.lower_y = box.min.y;
  out.lower_z = box.min.z;
  out.upper_x = box.max.x;
  out.upper_y = box.max.y;
  out.upper_z = box.max.z;
}

/// Rays that are not numbers hit nothing.
bool is_usable(const RaySegment& ray) {
  float sum =
      ray.origin.x + ray.origin.y + ray.origin.z + ray.direction.x + ray.direction.y + ray.direction.z;
  return std::isfinite(sum) && ray.nearest <= ray.farthest && glm::dot(ray.direction, ray.direction) > 0;
}

} // namespace

RayWorld::RayWorld(const RayDevice& device, std::vector<WorldItem> items, ItemFaces& faces)
    : impl_(std::make_unique<Impl>(std::move(items), faces)) {
  RTCDevice d = impl_->items.empty() ? nullptr : device.impl().get();
  if (!d) return;
  impl_->top = embree().rtcNewScene(d);
  embree().rtcSetSceneFlags(impl_->top, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry g = embree().rtcNewGeometry(d, RTC_GEOMETRY_TYPE_USER);
  embree().rtcSetGeometryUserPrimitiveCount(g, static_cast<unsigned>(impl_->items.size()));
  embree().rtcSetGeometryUserData(g, impl_.get());
  embree().rtcSetGeometryBoundsFunction(g, bound_item, nullptr);
  embree().rtcSetGeometryIntersectFunction(g, intersect_item);
  embree().rtcSetGeometryOccludedFunction(g, occlude_item);
  embree().rtcCommitGeometry(g);
  embree().rtcAttachGeometry(impl_->top, g);
  embree().rtcReleaseGeometry(g);
  commit_scene(impl_->top);
}

RayWorld::~RayWorld() {
  if (impl_->top) embree().rtcReleaseScene(impl_->top);
}

void RayWorld::forget_faces() {
  for (auto& scene : impl_->known)
    scene.store(nullptr, std::memory_order_relaxed);
}

namespace {

/// Of several surfaces in the same place the one that comes first in order, or a cursor would pass others by.
void take_first(RTCScene top, const RayRule& rule, const ItemFaces& faces, RaySegment segment,
                const slvm::RayCursor* behind, RayHit& hit) {
  std::vector<RayHit> same;
  Query q(rule, faces);
  q.behind = behind;
  q.list = &same;
  q.most = 64;
  segment.nearest = hit.distance * (1 - kSamePlace);
  segment.farthest = hit.distance * (1 + kSamePlace);
  RTCRay ray{};
  set_ray(ray, segment);
  occluded(top, q.outer, nullptr, ray);
  for (const RayHit& h : same)
    if (std::tie(h.distance, h.item, h.face) < std::tie(hit.distance, hit.item, hit.face)) hit = h;
}

} // namespace

bool RayWorld::nearest(const RayRule& rule, const RaySegment& segment, const slvm::RayCursor* behind,
                       RayHit& hit) const {
  if (!impl_->top || !is_usable(segment)) return false;
  Query q(rule, impl_->source);
  q.behind = behind && behind->distance > -kInfinity ? behind : nullptr;
  RTCRayHit ray{};
  set_ray(ray.ray, segment);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(impl_->top, q.outer, nullptr, ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit = {ray.ray.tfar, q.hit_item, ray.hit.primID, ray.hit.u, ray.hit.v};
  if (behind) take_first(impl_->top, rule, impl_->source, segment, q.behind, hit);
  return true;
}

bool RayWorld::any(const RayRule& rule, const RaySegment& segment) const {
  if (!impl_->top || !is_usable(segment)) return false;
  Query q(rule, impl_->source);
  RTCRay ray{};
  set_ray(ray, segment);
  occluded(impl_->top, q.outer, nullptr, ray);
  return ray.tfar < 0;
}

bool RayWorld::all(const RayRule& rule, const RaySegment& segment, const uint8_t* solid, size_t most,
                   std::vector<RayHit>& hits) const {
  hits.clear();
  if (!impl_->top || !is_usable(segment)) return false;
  Query q(rule, impl_->source);
  q.solid = solid;
  q.list = &hits;
  q.most = most;
  RTCRay ray{};
  set_ray(ray, segment);
  occluded(impl_->top, q.outer, nullptr, ray);
  return ray.tfar < 0 && hits.size() < most;
}

} // namespace render
