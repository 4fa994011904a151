// Primitives as faces for rays: one lattice of quadrilaterals over the whole parameter square of each.
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

/// Faces along u and along v.
struct FaceRate {
  int u = 1, v = 1;
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

FaceRate measure_rate(const Primitive&, const Camera&, bool displaced);
/// Makes the rates of the patches of one request the same, so that their edges meet.
void even_out(std::span<FaceRate> rates);

/// Appends the faces of a primitive as it stands at `times` moments. `to_item` is applied to the points.
void tessellate(const Primitive&, FaceRate, Displacer* displacer, std::span<const float> times,
                const Matrix4* to_item, std::vector<QuadMesh>& parts);

/// All parts in one.
QuadMesh joined(std::span<const QuadMesh> parts, size_t times);

} // namespace render
