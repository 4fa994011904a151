// Primitives as faces for rays: one lattice of quadrilaterals over the whole parameter square of each.
// Neighbouring patches have lattices as fine as each needs it; along the side they share, points that only
// one of them has are put on the line between those that both have, which are found from the side alone.
//
// How fine: rays see these faces by the way of other surfaces, and the surface itself is evaluated where they
// hit; what matters is that outlines look smooth and that faces are nearer to the surface than the bias of
// rays that start on it. So the measure is the distance between face and surface, not the size of faces: a
// plane takes one of them. Where a displacement shader moves the points, faces are about two micropolygons
// wide.
#pragma once

#include "render/prims/primitive.h"
#include "render/rays/embree_world.h"
#include "render/state/camera.h"

#include <span>

namespace render {

/// Faces along u and along v, powers of two, and the straight pieces that the sides v = 0, v = 1, u = 0 and
/// u = 1 consist of, no more than these.
struct FaceRate {
  int u = 1, v = 1;
  std::array<int, 4> sides{1, 1, 1, 1};
  size_t faces() const { return static_cast<size_t>(u) * static_cast<size_t>(v); }
};

/// Faces of one side of a primitive, at most.
inline constexpr int kMostFacesASide = 512;

/// Moves points as displacement shaders do.
class Displacer {
public:
  virtual ~Displacer() = default;
  /// Whether the primitive has a displacement shader.
  virtual bool displaces(const Primitive&) const = 0;
  /// Camera-space positions of a lattice, u fastest, displaced.
  virtual void positions(const Primitive&, const UvRect&, int nu, int nv, std::vector<Vec3>& P) = 0;
};

/// Whether rays hit the displaced surface.
bool is_displaced_for_rays(const Primitive&, const Displacer*);

/// The rate of a surface among others of its request that it meets, or `alone`.
FaceRate measure_rate(const Primitive&, const Camera&, bool displaced, bool alone = true);
/// Makes the patches of one request coarser where they have too many faces together; sides still meet.
void limit_faces(std::span<FaceRate> rates);
/// How fine the faces in a box of camera space have to be: one over the size of what may be left out there.
float fineness_in(const Box&, const Camera&, const Attributes&);
/// As fine as both.
FaceRate finer_of(const FaceRate&, const FaceRate&);

/// Appends the faces of a primitive as it stands at `times` moments. `to_item` is applied to the points.
void tessellate(const Primitive&, FaceRate, Displacer* displacer, std::span<const float> times,
                const Matrix4* to_item, std::vector<QuadMesh>& parts);

/// All parts in one.
QuadMesh joined(std::span<const QuadMesh> parts, size_t times);

} // namespace render
