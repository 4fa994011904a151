// Meshes of bilinear and bicubic patches; a single patch is a mesh of one. The patches of a mesh share one
// (u,v) square. Steps, wraps and class sizes: RISpec 3.2, section 5.3.
#pragma once

#include "render/prims/primitive_list.h"
#include "render/state/declaration.h"

#include <span>

namespace render {

/// One direction of a mesh.
struct MeshDirection {
  int points = 4; ///< at least order()
  bool periodic = false;
  bool cubic = true;
  CubicBasis basis = bezier_basis();

  int order() const { return cubic ? 4 : 2; }
  /// Control points from one patch to the next; at least 1.
  int step() const { return cubic ? std::max(basis.step, 1) : 1; }
  int patches() const { return periodic ? points / step() : (points - order()) / step() + 1; }
  /// Varying values.
  int corners() const { return periodic ? patches() : patches() + 1; }
  /// Whether all points belong to a patch.
  bool even() const { return (periodic ? points : points - order()) % step() == 0; }
};

/// Appends the patches. With `weights`, one for each point, they are rational: `P` holds the points after
/// division. `P` and vertex variables are points x points, varying and facevarying ones corners x corners,
/// uniform ones patches x patches, all u fastest.
void add_patch_mesh(const MeshDirection& u, const MeshDirection& v, std::span<const Vec3> P,
                    std::span<const TypedParam> vars, const std::shared_ptr<const PrimitiveState>& state,
                    PrimitiveList& out, std::span<const float> weights = {});

} // namespace render
