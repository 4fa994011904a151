// What the renderer wants of a ray tracer, and the only door to Embree: quadrilaterals in scenes of their
// own, and a world of items, each of which is such a scene that is asked for when a ray first reaches the
// item's box. Works with Embree 3 and 4. Read next: ray_geometry.h, which makes the items.
#pragma once

#include "render/state/math.h"
#include "slvm/rays.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace render {

/// Faces by their four corners; a triangle has its last two equal. The points are given once for each of
/// `times` moments from the opening of the shutter to its closing, evenly apart.
struct QuadMesh {
  size_t times = 1;
  std::vector<Vec3> points; ///< those of the first moment, then those of the next
  std::vector<std::array<uint32_t, 4>> faces;
};

/// Faces that rays can be traced against. Immutable.
class FaceScene {
public:
  virtual ~FaceScene() = default;
  /// A face is two triangles to rays, and u and v of a hit are linear in each: here as they are on the
  /// bilinear patch through the four corners, about; they may be a little outside it.
  virtual Vec2 on_patch(const struct RayHit& hit) const = 0;
};

class RayDevice {
public:
  /// `alone`: builds run on the thread that wants them only, else on as many as the program may use.
  explicit RayDevice(bool alone = false);
  ~RayDevice();
  RayDevice(const RayDevice&) = delete;
  RayDevice& operator=(const RayDevice&) = delete;

  /// Why rays hit nothing that should be hit; empty: they do.
  const std::string& problem() const;
  std::unique_ptr<const FaceScene> build(const QuadMesh& mesh) const;
  /// Memory of all scenes that are alive, hierarchies included.
  size_t bytes() const;

  struct Impl;
  Impl& impl() const { return *impl_; }

private:
  std::unique_ptr<Impl> impl_;
};

/// A part of the world whose faces are all treated alike.
struct WorldItem {
  Box bounds;             ///< finite, in the space of the rays
  bool one_sided = false; ///< seen from its front only; of solids each surface has its own sides
  bool flipped = false;   ///< the front of its faces is the other side than (first side) x (last side)
  bool solid = false;     ///< a constructed solid: only hits that bound it count (ItemFaces::bounding)
  bool placed = false;    ///< the faces are in a space of their own:
  Matrix4 to_item;        ///< from that of the rays to it
};

struct RaySegment {
  Vec3 origin, direction;
  float nearest = 0, farthest = kInfinity, time = 0; ///< time: part of the shutter's
};

struct RayHit {
  float distance = kInfinity;
  uint32_t item = 0, face = 0;
  float u = 0, v = 0; ///< on the face: along its first side and along its last one
};

/// A face that a line goes through.
struct RayCrossing {
  RayHit hit;
  float along = 0; ///< the ray's direction along (first side) x (last side), which is as long as the area
};

/// Gives the faces of items when they are wanted; called from many threads.
class ItemFaces {
public:
  virtual ~ItemFaces() = default;
  /// Null: there are none. What it gives stays until the world has been told to forget it, and no query is
  /// running. Asked again only then.
  virtual const FaceScene* faces(uint32_t item) = 0;
  /// Whether two faces of an item belong to one surface: a ray through the edge between them meets it once.
  virtual bool same_surface(uint32_t item, uint32_t face, uint32_t other) const = 0;
  /// Of all crossings of a ray from `origin` on with a solid the numbers of those that bound it and that the
  /// ray sees, nearest first.
  virtual std::vector<uint32_t> bounding(uint32_t item, const struct RayRule&, Vec3 origin,
                                         std::span<const RayCrossing> crossings) const = 0;
};

/// Which hits count, for the rays of a batch.
struct RayRule {
  const uint8_t* seen = nullptr; ///< one an item: 0 where rays go through
  /// For ItemFaces: the same for surfaces that bound solids.
  const uint8_t* seen_surfaces = nullptr;
  slvm::HitSides sides = slvm::HitSides::kBoth;
};

class RayWorld {
public:
  /// `faces` must outlive the world.
  RayWorld(const RayDevice& device, std::vector<WorldItem> items, ItemFaces& faces);
  ~RayWorld();

  /// Asks the source for faces anew.
  void forget_faces();

  /// The nearest hit; with a cursor, behind it. False: none.
  bool nearest(const RayRule&, const RaySegment&, const slvm::RayCursor* behind, RayHit& hit) const;
  /// Whether there is any.
  bool any(const RayRule&, const RaySegment&) const;
  /// All hits on items that are not `solid` (one an item), in no order, at most `most`; true: something solid
  /// is in the way, and the list is of no use.
  bool all(const RayRule&, const RaySegment&, const uint8_t* solid, size_t most,
           std::vector<RayHit>& hits) const;

  struct Impl;

private:
  std::unique_ptr<Impl> impl_;
};

} // namespace render
