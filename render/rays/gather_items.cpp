// From the primitives of a scene to the items of its ray geometry.
#include "render/rays/ray_geometry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace render {

namespace {

/// Boxes beyond are of scenes gone wrong; Embree's limit is about 1e18.
constexpr float kFarthest = 1e17f;

bool is_usable(const Box& box) {
  return !box.empty() && glm::all(glm::lessThan(glm::abs(box.min), Vec3(kFarthest))) &&
         glm::all(glm::lessThan(glm::abs(box.max), Vec3(kFarthest)));
}

bool nearly_equal(const Matrix4& a, const Matrix4& b) {
  for (size_t i = 0; i < 16; ++i)
    if (!(std::abs(a.m[i] - b.m[i]) <= 1e-5f * std::max(1.0f, std::abs(a.m[i])))) return false;
  return true;
}

/// Whether two geometries are the same surface, as far as a few points tell.
bool same_geometry(const Geometry& a, const Geometry& b) {
  constexpr float kProbes[] = {0, 0.37f, 0.71f, 1};
  SurfaceLattice x, y;
  a.find_points({kProbes, kProbes}, x);
  b.find_points({kProbes, kProbes}, y);
  return x.P == y.P;
}

} // namespace

/// Fills the items of a RayGeometry.
class RayGeometry::Gatherer {
public:
  Gatherer(RayGeometry& out, const Camera& camera) : out_(out), scene_(out.scene_), camera_(camera) {}

  void run() {
    for (const Primitive& p : scene_.primitives)
      sampled_ = sampled_ || p.attributes().rays.sample_motion;
    find_visible();
    measure();
    gather_copies();
    for (auto& [traits, primitives] : by_traits_) {
      std::erase_if(primitives, [&](uint32_t p) { return taken_[p]; });
      split(traits, primitives.begin(), primitives.end());
    }
    for (auto& [tree, primitives] : solids_)
      add_solid(tree, primitives);
  }

private:
  using List = std::vector<uint32_t>;

  RayTraits traits_of(const Primitive& p);
  void find_visible();
  void measure();
  void gather_copies();
  bool same_as_first(const ObjectCopy& copy, const ObjectCopy& first) const;
  bool can_be_shared(const ObjectCopy& copy) const;
  void split(const RayTraits& traits, List::iterator begin, List::iterator end);
  void add_solid(const std::shared_ptr<const SolidTree>& tree, const List& primitives);
  Item& add(const RayTraits& traits, const List& primitives);

  RayGeometry& out_;
  const Scene& scene_;
  const Camera& camera_;
  bool sampled_ = false; ///< some rays see motion
  std::map<RayTraits, List> by_traits_;
  struct ByNumber {
    bool operator()(const auto& a, const auto& b) const { return a->number() < b->number(); }
  };
  std::map<std::shared_ptr<const SolidTree>, List, ByNumber> solids_;
  std::vector<Box> bounds_;     ///< by primitive; empty: rays do not see it
  std::vector<FaceRate> rates_; ///< by primitive
  std::vector<uint8_t> taken_;  ///< is part of an instance
  std::unordered_map<std::string, uint32_t> group_numbers_;
};

RayTraits RayGeometry::Gatherer::traits_of(const Primitive& p) {
  const Attributes& a = p.attributes();
  RayTraits t;
  t.specular = out_.is_specular(a.rays);
  t.diffuse = a.rays.diffuse;
  t.shadow = a.rays.shadow();
  t.one_sided = a.sides == 1;
  t.flipped = a.flips_normals(p.state->mirrored);
  t.moving = sampled_ && (!p.state->motion.empty() || !p.deformation.empty());
  auto [it, is_new] = group_numbers_.try_emplace(a.rays.groups, static_cast<uint32_t>(out_.groups_.size()));
  if (is_new) out_.groups_.push_back(a.rays.groups);
  t.groups = it->second;
  return t;
}

void RayGeometry::Gatherer::find_visible() {
  bounds_.resize(scene_.primitives.size());
  taken_.resize(scene_.primitives.size());
  for (uint32_t i = 0; i < scene_.primitives.size(); ++i) {
    const Primitive& p = scene_.primitives[i];
    // Of the two versions of an object between two levels of detail, rays see the one that most samples do.
    // What is cut out of a solid is so whether rays see it or not.
    const bool solid = p.state->solid != nullptr;
    if (!(solid || out_.is_seen_at_all(p.attributes().rays)) || !p.state->level.has(0.5f)) continue;
    Box box = p.camera_bound({});
    if (!is_usable(box)) continue;
    bounds_[i] = box;
    (solid ? solids_[p.state->solid] : by_traits_[traits_of(p)]).push_back(i);
  }
}

void RayGeometry::Gatherer::measure() {
  rates_.resize(scene_.primitives.size());
  size_t end = 0;
  for (size_t first = 0; first < scene_.primitives.size(); first = end) {
    const auto& request = scene_.primitives[first].state;
    for (end = first + 1; end < scene_.primitives.size() && scene_.primitives[end].state == request;)
      ++end;
    for (size_t i = first; i < end; ++i) {
      const Primitive& p = scene_.primitives[i];
      if (!bounds_[i].empty())
        rates_[i] = measure_rate(p, camera_, is_displaced_for_rays(p, out_.displacer_), end - first == 1);
    }
    limit_faces(std::span(rates_).subspan(first, end - first));
  }
}

bool RayGeometry::Gatherer::can_be_shared(const ObjectCopy& copy) const {
  if (copy.count == 0 || copy.first + copy.count > scene_.primitives.size()) return false;
  const Primitive& first = scene_.primitives[copy.first];
  for (size_t i = copy.first; i < copy.first + copy.count; ++i) {
    const Primitive& p = scene_.primitives[i];
    bool moves = sampled_ && (!p.state->motion.empty() || !p.deformation.empty());
    if (bounds_[i].empty() || moves || p.state->solid || is_displaced_for_rays(p, out_.displacer_) ||
        p.state->attributes != first.state->attributes || p.state->mirrored != first.state->mirrored)
      return false;
  }
  return true;
}

/// The same surfaces in the same place of the object.
bool RayGeometry::Gatherer::same_as_first(const ObjectCopy& copy, const ObjectCopy& first) const {
  if (copy.count != first.count) return false;
  Matrix4 a = inverse_or_identity(copy.to_camera), b = inverse_or_identity(first.to_camera);
  for (size_t i = 0; i < copy.count; ++i) {
    const Primitive &p = scene_.primitives[copy.first + i], &q = scene_.primitives[first.first + i];
    if (!nearly_equal(p.state->object_to_camera * a, q.state->object_to_camera * b) ||
        !same_geometry(*p.geometry, *q.geometry))
      return false;
  }
  return true;
}

/// Instances with enough faces to be worth a transformation of each ray that comes to them.
void RayGeometry::Gatherer::gather_copies() {
  constexpr size_t kFewest = 64;
  std::map<const void*, std::vector<const ObjectCopy*>> objects;
  for (const ObjectCopy& copy : scene_.copies)
    if (can_be_shared(copy)) objects[copy.object].push_back(&copy);
  std::vector<std::vector<const ObjectCopy*>> in_order;
  for (auto& [object, copies] : objects) {
    std::erase_if(copies, [&](const ObjectCopy* c) { return !same_as_first(*c, *copies.front()); });
    if (copies.size() > 1) in_order.push_back(copies);
  }
  std::sort(in_order.begin(), in_order.end(), [](auto& a, auto& b) { return a[0]->first < b[0]->first; });
  for (const auto& copies : in_order) {
    // As finely as the finest needs it.
    size_t faces = 0;
    for (size_t i = 0; i < copies[0]->count; ++i) {
      FaceRate rate;
      for (const ObjectCopy* c : copies)
        rate = finer_of(rate, rates_[c->first + i]);
      for (const ObjectCopy* c : copies)
        rates_[c->first + i] = rate;
      faces += rate.faces();
    }
    if (faces < kFewest) continue;
    auto model = static_cast<uint32_t>(out_.items_.size());
    for (const ObjectCopy* c : copies) {
      List list(c->count);
      std::iota(list.begin(), list.end(), static_cast<uint32_t>(c->first));
      for (uint32_t p : list)
        taken_[p] = 1;
      Item& item = add(traits_of(scene_.primitives[c->first]), list);
      item.model = model;
      item.placed = true;
      item.to_camera = c->to_camera;
      item.to_object = inverse_or_identity(c->to_camera);
    }
  }
}

/// Halves a list in space until the parts are small enough.
void RayGeometry::Gatherer::split(const RayTraits& traits, List::iterator begin, List::iterator end) {
  if (begin == end) return;
  size_t faces = 0;
  Box centres;
  auto centre = [&](uint32_t p) { return (bounds_[p].min + bounds_[p].max) * 0.5f; };
  for (auto it = begin; it != end; ++it) {
    faces += rates_[*it].faces();
    centres.add(centre(*it));
  }
  if (faces <= out_.settings_.item_faces || end - begin == 1) {
    List list(begin, end);
    std::sort(list.begin(), list.end());
    add(traits, list);
    return;
  }
  Vec3 size = centres.max - centres.min;
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  auto middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](uint32_t a, uint32_t b) {
    float x = centre(a)[axis], y = centre(b)[axis];
    return x != y ? x < y : a < b;
  });
  split(traits, begin, middle);
  split(traits, middle, end);
}

RayGeometry::Item& RayGeometry::Gatherer::add(const RayTraits& traits, const List& primitives) {
  auto item = std::make_unique<Item>();
  item->traits = traits;
  item->model = static_cast<uint32_t>(out_.items_.size());
  uint32_t faces = 0;
  auto log = [](int n) { return static_cast<uint8_t>(std::countr_zero(static_cast<unsigned>(n))); };
  for (uint32_t p : primitives) {
    const FaceRate& rate = rates_[p];
    item->parts.push_back(
        {p, faces, log(rate.u), log(rate.v), is_displaced_for_rays(scene_.primitives[p], out_.displacer_)});
    item->rates.push_back(rate);
    item->bounds.add(bounds_[p]);
    faces += static_cast<uint32_t>(rate.faces());
  }
  item->faces_all = faces;
  item->part_index.build(item->parts, faces);
  return *out_.items_.emplace_back(std::move(item));
}

/// A solid is one item. Surfaces that no ray sees bound it, too.
void RayGeometry::Gatherer::add_solid(const std::shared_ptr<const SolidTree>& tree, const List& primitives) {
  auto solid = std::make_unique<RaySolid>();
  solid->tree = tree;
  solid->bounds.resize(tree->size());
  std::optional<RayTraits> traits;
  bool opaque = true;
  for (uint32_t p : primitives) {
    const PrimitiveState& state = *scene_.primitives[p].state;
    solid->node.push_back(state.solid_primitive);
    solid->bounds[state.solid_primitive].add(bounds_[p]);
    RayTraits own = traits_of(scene_.primitives[p]);
    opaque = opaque && own.shadow == RayOpacity::kOpaque;
    if (!out_.is_seen_at_all(state.attributes->rays)) continue;
    if (!traits) traits = own;
    traits->specular = traits->specular || own.specular;
    traits->diffuse = traits->diffuse || own.diffuse;
    traits->moving = traits->moving || own.moving;
    traits->shadow = std::max(traits->shadow, own.shadow);
  }
  if (!traits) return;
  if (!opaque && traits->shadow == RayOpacity::kOpaque) traits->shadow = RayOpacity::kShader;
  add(*traits, primitives).solid = std::move(solid);
}

RayGeometry::RayGeometry(const Scene& scene, const Camera& camera, Displacer* displacer,
                         RayGeometrySettings settings)
    : scene_(scene), displacer_(displacer), settings_(settings) {
  Gatherer(*this, camera).run();
  std::vector<WorldItem> world;
  for (const auto& item : items_) {
    WorldItem w;
    w.bounds = item->bounds;
    // The faces bulge out of a surface's bound by rounding only.
    Vec3 size = w.bounds.max - w.bounds.min;
    w.bounds.grow(1e-5f *
                  std::max({size.x, size.y, size.z, glm::length(w.bounds.min), glm::length(w.bounds.max)}));
    w.one_sided = item->traits.one_sided;
    w.solid = item->solid != nullptr;
    w.placed = item->placed;
    w.to_item = item->to_object;
    // Normals turn round where the space of the faces is a mirror image.
    w.flipped = item->traits.flipped != (item->placed && slvm::determinant3(item->to_object) < 0);
    world.push_back(w);
    solid_.push_back(item->traits.shadow == RayOpacity::kOpaque);
  }
  solid_.push_back(0); // never without data
  ItemFaces& source = *this;
  world_ = std::make_unique<RayWorld>(device_, std::move(world), source);
}

} // namespace render
