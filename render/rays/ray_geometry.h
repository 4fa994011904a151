// All that rays can hit in a scene, made on demand.
//
// Primitives that rays treat alike are gathered into items of neighbours, up to a few hundred thousand faces
// each; the world (embree_world.h) knows their boxes. An item's faces are made when the first ray reaches its
// box, by the thread of that ray, and dropped again, the longest unused first, when all faces together take
// more memory than allowed. Faces depend on the scene only, never on which ray asked, so that nothing else
// depends on when they were made. Objects and meshes that are instanced share the faces of their first
// instance.
#pragma once

#include "render/rays/ray_usage.h"
#include "render/rays/tessellate.h"
#include "render/state/scene.h"

#include <atomic>
#include <map>
#include <mutex>
#include <shared_mutex>

namespace render {

/// What decides which rays see an item, and how.
struct RayTraits {
  bool specular = false, diffuse = false;
  RayOpacity shadow = RayOpacity::kTransparent;
  bool one_sided = false, flipped = false, moving = false;
  uint32_t groups = 0; ///< number of the set of groups it is in
  auto operator<=>(const RayTraits&) const = default;
};

struct RayGeometrySettings {
  size_t most_bytes = size_t{1} << 30; ///< of faces and hierarchies
  /// Gathered in one item, about. Rays are fastest where one item has all; they come to many items late, or
  /// never.
  size_t item_faces = size_t{1} << 20;
  bool alone = false;   ///< one thread does all (RayDevice)
  bool photons = false; ///< specular rays are photons: they see what Attribute "visibility" shows to these
};

/// A solid that the primitives of an item bound.
struct RaySolid {
  std::shared_ptr<const SolidTree> tree;
  std::vector<SolidTree::NodeIndex> node; ///< of each primitive of the item
  std::vector<Box> bounds;                ///< of each node of the tree that is a primitive
};

/// A hit on its primitive.
struct SurfacePlace {
  uint32_t primitive = 0; ///< of the scene
  float u = 0, v = 0;     ///< in its parameter square
  bool displaced = false; ///< the faces hit were those of the displaced surface
};

/// One of the primitives of an item, and where its faces are.
struct ItemPart {
  uint32_t primitive = 0; ///< of the scene, counted from Item::first_primitive on
  uint32_t first_face = 0;
  uint8_t log_u = 0, log_v = 0; ///< 2 to the power of these: faces along u and v
  bool displaced = false;       ///< its faces are those of the displaced surface
};

/// Finds the part of an item that a face is of: looks only among those that begin in the face's block.
class PartIndex {
public:
  void build(std::span<const ItemPart> parts, uint32_t faces);
  size_t find(std::span<const ItemPart> parts, uint32_t face) const;

private:
  int shift_ = 0;               ///< a block is 2 to the power of this
  std::vector<uint32_t> first_; ///< part of the first face of each block, and the last part
};

/// What an item consists of; instances have it in common.
struct ItemParts {
  std::vector<ItemPart> list;
  std::vector<FaceRate> rates; ///< of each part
  uint32_t faces = 0;          ///< of all parts
  PartIndex index;

  size_t find(uint32_t face) const { return list.size() == 1 ? 0 : index.find(list, face); }
};

class RayGeometry final : public ItemFaces {
public:
  /// All arguments must outlive this. `displacer` may be null.
  RayGeometry(const Scene& scene, const Camera& camera, Displacer* displacer,
              RayGeometrySettings settings = {});
  ~RayGeometry() override;

  const RayWorld& world() const { return *world_; }
  /// Why rays hit nothing that should be hit; empty: they do.
  const std::string& problem() const { return device_.problem(); }
  const RayTraits& traits(uint32_t item) const { return items_[item]->traits; }
  size_t items() const { return items_.size(); }
  /// The primitive that a hit is on.
  uint32_t primitive(const RayHit& hit) const;
  /// To be called while `tracing`.
  SurfacePlace place(const RayHit& hit);
  bool same_surface(uint32_t item, uint32_t face, uint32_t other) const override;
  std::vector<uint32_t> bounding(uint32_t item, const RayRule&, Vec3 origin,
                                 std::span<const RayCrossing> crossings) const override;
  /// What shadows of a surface are like.
  RayOpacity shadow(const RayHit& hit) const;

  /// Which hits count for rays of a kind that see only `subset` (RayOptions). Valid as long as this.
  RayRule rule(slvm::RayKind kind, std::string_view subset, slvm::HitSides sides);
  /// One an item: whether it lets no light through to transmission rays.
  const uint8_t* solid() const { return solid_.data(); }

  /// To be held while rays are traced.
  std::shared_lock<std::shared_mutex> tracing() { return std::shared_lock(gate_); }
  /// To be called now and then, not while `tracing`: drops faces while there are too many.
  void trim();

  RayGeometryUsage usage() const;

private:
  struct Item {
    RayTraits traits;
    std::shared_ptr<const ItemParts> parts;
    uint32_t first_primitive = 0;
    Box bounds;
    std::unique_ptr<const RaySolid> solid; ///< that the primitives bound; null: none
    uint32_t model = 0;                    ///< the item whose faces these are: itself, or the first instance
    Matrix4 to_camera, to_object;          ///< of instances
    bool placed = false;
    std::mutex making;
    std::unique_ptr<const FaceScene> faces;
    std::atomic<const FaceScene*> ready{nullptr};
    std::atomic<bool> made{false};
    std::atomic<uint64_t> used{0};
  };
  class Gatherer;
  /// Number of the primitive of a face, in the scene.
  static uint32_t primitive_of(const Item& item, uint32_t face) {
    return item.first_primitive + item.parts->list[item.parts->find(face)].primitive;
  }
  const PrimitiveState& state_of(const Item& item, uint32_t face) const {
    return scene_.primitives.state(primitive_of(item, face));
  }

  const FaceScene* faces(uint32_t item) override;
  void make(Item& item);
  bool is_seen(const Item&, const RayRule&, const RayCrossing&) const;
  bool is_specular(const RayAttributes& a) const { return settings_.photons ? a.photon : a.specular; }
  bool is_seen_at_all(const RayAttributes& a) const {
    return a.seen_by_rays() || (settings_.photons && a.photon);
  }
  struct Seen {
    std::vector<uint8_t> items;
    std::vector<uint8_t> surfaces; ///< by run of the scene's primitives; only those of solids are told
  };
  void find_seen(slvm::RayKind kind, std::string_view subset, Seen& out) const;

  const Scene& scene_;
  Displacer* displacer_;
  RayGeometrySettings settings_;
  RayDevice device_;
  std::vector<std::unique_ptr<Item>> items_;
  std::vector<std::string> groups_;
  std::vector<uint8_t> solid_;
  std::unique_ptr<RayWorld> world_;
  std::shared_mutex gate_;
  std::mutex seen_mutex_;
  std::map<std::pair<slvm::RayKind, std::string>, Seen, std::less<>> seen_;
  std::atomic<uint64_t> clock_{1};
  std::atomic<size_t> made_{0}, dropped_{0}, faces_{0};
};

} // namespace render
