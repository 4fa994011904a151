// Embree: a top-level scene with one user-defined primitive an item. Embree calls back for a ray that reaches
// an item's box; the callback has the item's faces made, if need be, and goes on tracing in their scene. That
// Embree's own instances are not used makes the world lazy: an item no ray comes near is never tessellated,
// and items can be dropped and made again while the world stays as it is.
#include "render/rays/embree_world.h"

#include "render/rays/embree_library.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <tuple>

namespace render {

namespace {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
void init_context(QueryContext& c) {
  rtcInitRayQueryContext(&c);
}
constexpr RTCSceneFlags kFilterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
void allow_filter(RTCGeometry g) {
  embree().rtcSetGeometryEnableFilterFunctionFromArguments(g, true);
}
void intersect(RTCScene scene, QueryContext& c, RTCFilterFunctionN filter, RTCRayHit& ray) {
  RTCIntersectArguments a;
  rtcInitIntersectArguments(&a);
  a.context = &c;
  a.filter = filter;
  embree().rtcIntersect1(scene, &ray, &a);
}
void occluded(RTCScene scene, QueryContext& c, RTCFilterFunctionN filter, RTCRay& ray) {
  RTCOccludedArguments a;
  rtcInitOccludedArguments(&a);
  a.context = &c;
  a.filter = filter;
  embree().rtcOccluded1(scene, &ray, &a);
}
#else
using QueryContext = RTCIntersectContext;
void init_context(QueryContext& c) {
  rtcInitIntersectContext(&c);
}
constexpr RTCSceneFlags kFilterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
void allow_filter(RTCGeometry) {}
void intersect(RTCScene scene, QueryContext& c, RTCFilterFunctionN filter, RTCRayHit& ray) {
  c.filter = filter;
  embree().rtcIntersect1(scene, &c, &ray);
}
void occluded(RTCScene scene, QueryContext& c, RTCFilterFunctionN filter, RTCRay& ray) {
  c.filter = filter;
  embree().rtcOccluded1(scene, &c, &ray);
}
#endif

/// How far the third corner of a face is from where a parallelogram would have it, in its first and last
/// sides. Two bytes, for these are read at random; where they are not enough there are none.
class Skew {
public:
  Skew(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const Vec3 x = b - a, y = d - a, off = c - b - y;
    const float xx = glm::dot(x, x), xy = glm::dot(x, y), yy = glm::dot(y, y);
    const float dx = glm::dot(off, x), dy = glm::dot(off, y), determinant = xx * yy - xy * xy;
    const float s = (dx * yy - dy * xy) / determinant * kSteps,
                t = (dy * xx - dx * xy) / determinant * kSteps;
    if (!(std::abs(s) < 127 && std::abs(t) < 127)) return;
    along_first_ = static_cast<int8_t>(std::lround(s));
    along_last_ = static_cast<int8_t>(std::lround(t));
  }
  float along_first() const { return along_first_ / kSteps; }
  float along_last() const { return along_last_ / kSteps; }

private:
  static constexpr float kSteps = 64;
  int8_t along_first_ = 0, along_last_ = 0;
};

class EmbreeFaces final : public FaceScene {
public:
  EmbreeFaces(RTCScene s, const QuadMesh& mesh) : scene(s) {
    skews_.reserve(mesh.faces.size());
    for (const auto& [a, b, c, d] : mesh.faces)
      skews_.emplace_back(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
  }
  ~EmbreeFaces() override { embree().rtcReleaseScene(scene); }
  RTCScene scene;

  /// One step of Newton's method.
  Vec2 on_patch(const RayHit& hit) const override {
    const float s = skews_[hit.face].along_first(), t = skews_[hit.face].along_last();
    // u v in the triangle at the first corner, (1 - u) (1 - v) in the other one, where u + v > 1.
    const float off = hit.u * hit.v - std::max(hit.u + hit.v - 1, 0.0f);
    // Of triangles it is exact as far as to the corner their last side is.
    const float least = s == -1 && t == 0 ? 1e-6f : 0.1f;
    const float by = off / std::max(1 + hit.v * s + hit.u * t, least);
    return {hit.u - by * s, hit.v - by * t};
  }

private:
  std::vector<Skew> skews_;
};

RTCScene faces_of(const FaceScene* faces) {
  return static_cast<const EmbreeFaces*>(faces)->scene;
}

/// Builds run on all processors; while this thread waits for them it must not take up other work of the
/// renderer, which could wait for what is being built here.
void commit(RTCScene scene) {
  tbb::this_task_arena::isolate([&] { embree().rtcCommitScene(scene); });
}

/// Hits of two faces of a surface that differ by less, relative to the distance, are one at the edge between
/// them.
constexpr float kSamePlace = 2e-6f;

} // namespace

struct RayDevice::Impl {
  ~Impl() {
    if (device) embree().rtcReleaseDevice(device);
  }
  /// Made at the first call: it takes a thirtieth of the time of a small picture, even when there is nothing
  /// for rays in it. Null: there is a problem.
  RTCDevice get() {
    std::call_once(made, [this] {
      problem = embree().problem;
      if (!problem.empty()) return;
      device = embree().rtcNewDevice(nullptr);
      auto count = [](void* user, ssize_t size, bool) {
        static_cast<Impl*>(user)->bytes.fetch_add(size, std::memory_order_relaxed);
        return true;
      };
      embree().rtcSetDeviceMemoryMonitorFunction(device, count, this);
    });
    return device;
  }

  std::once_flag made;
  RTCDevice device = nullptr;
  std::string problem;
  std::atomic<int64_t> bytes{0};
};

RayDevice::RayDevice() : impl_(std::make_unique<Impl>()) {}
RayDevice::~RayDevice() = default;
const std::string& RayDevice::problem() const {
  return impl_->problem;
}
size_t RayDevice::bytes() const {
  return static_cast<size_t>(std::max<int64_t>(impl_->bytes, 0));
}

std::unique_ptr<const FaceScene> RayDevice::build(const QuadMesh& mesh) const {
  RTCDevice device = mesh.faces.empty() ? nullptr : impl_->get();
  if (!device) return nullptr;
  RTCScene scene = embree().rtcNewScene(device);
  embree().rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | kFilterFlag));
  RTCGeometry g = embree().rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  allow_filter(g);
  size_t points = mesh.points.size() / mesh.times;
  embree().rtcSetGeometryTimeStepCount(g, static_cast<unsigned>(mesh.times));
  for (size_t t = 0; t < mesh.times; ++t) {
    auto* to = static_cast<float*>(embree().rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(t), RTC_FORMAT_FLOAT3, 3 * sizeof(float), points));
    for (size_t i = 0; i < points; ++i)
      for (int c = 0; c < 3; ++c)
        *to++ = mesh.points[t * points + i][c];
  }
  auto* index = static_cast<uint32_t*>(embree().rtcSetNewGeometryBuffer(
      g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(uint32_t), mesh.faces.size()));
  for (const auto& face : mesh.faces)
    index = std::copy(face.begin(), face.end(), index);
  embree().rtcCommitGeometry(g);
  embree().rtcAttachGeometry(scene, g);
  embree().rtcReleaseGeometry(g);
  commit(scene);
  return std::make_unique<EmbreeFaces>(scene, mesh);
}

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
    known[item].store(faces_of(made), std::memory_order_release);
    return faces_of(made);
  }
};

namespace {

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
  commit(impl_->top);
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
